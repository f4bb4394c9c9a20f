"""Logs of a fleet: one row a log, and which robots drift or differ from the others.

>>> import trackdyn as td
>>> outcome = td.fleet.run("logs/**/*.mcap", "fleet.toml", "results.parquet")  # doctest: +SKIP
>>> td.fleet.trends("results.parquet").plot()  # doctest: +SKIP

As a program: ``python -m trackdyn.fleet "logs/**/*.mcap" --vehicle fleet.toml``.
Needs ``pip install trackdyn[fleet]``.
"""

from ._judged import Finding
from ._outcome import Outcome
from ._run import run
from ._trends import ClaimTrend, RobotTrend, Trends, trends
from ._trial import TrialOutcome, run_trial

__all__ = [
    "ClaimTrend",
    "Finding",
    "Outcome",
    "RobotTrend",
    "Trends",
    "TrialOutcome",
    "run",
    "run_trial",
    "trends",
]
