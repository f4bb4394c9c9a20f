"""Which robots of a fleet drift away from their own past, and which from the others."""

from __future__ import annotations

import os
from dataclasses import dataclass
from datetime import datetime, timezone
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import _values
from .._errors import InputError, SettingError
from ._appear import Appearance, appearances
from ._beside import differences, drifts_beside
from ._judged import Finding, drift, judged, order
from ._lines import Line, Series, excess, line
from ._rows import left_out, name_of, rows_of

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

_DAY_NS = 86_400 * 10**9


@dataclass(frozen=True)
class RobotTrend:
    """What the logs of a robot say.

    Attributes
    ----------
    robot : str
        Its name.
    t, chi, chi_se : ndarray
        Its logs by time: days since the first log of the fleet, steering efficiencies and their
        standard errors.
    line : Line
        The line through them; its slope is per day.
    drift : Finding
        Change of its steering efficiency from its first to its last log.
    drift_beside : Finding
        That, less the change that its siblings have in the time.
    difference : Finding
        Its steering efficiency less that of its siblings, at one time.
    """

    robot: str
    t: NDArray[np.float64]
    chi: NDArray[np.float64]
    chi_se: NDArray[np.float64]
    line: Line
    drift: Finding
    drift_beside: Finding
    difference: Finding


@dataclass(frozen=True)
class ClaimTrend:
    """An effect that the diagnoses of a robot claim.

    Attributes
    ----------
    robot : str
        The robot.
    effect : str
        The effect, or several that were only claimed together.
    logs, claimed : int
        Logs that were diagnosed, and those that may have it.
    first : datetime
        Begin of the first log that has it.
    appeared : Finding
        Whether its later logs have it and its earlier ones do not. Value: share of pairs of a log
        with it and one without of which the one with it is later; 0.5 is no order.
    """

    robot: str
    effect: str
    logs: int
    claimed: int
    first: datetime
    appeared: Finding


@dataclass(frozen=True)
class Trends:
    """Which robots drift away from their own past, and which from their siblings.

    Attributes
    ----------
    robots : tuple of RobotTrend
        The robots, by name.
    claims : tuple of ClaimTrend
        What their diagnoses claim, by robot.
    epoch : datetime or None
        The first log.
    rate, matters : float
        As asked for.
    notes : tuple of str
        What was left out, and why.
    """

    robots: tuple[RobotTrend, ...]
    claims: tuple[ClaimTrend, ...]
    epoch: datetime | None
    rate: float
    matters: float
    notes: tuple[str, ...]

    def to_frame(self) -> pandas.DataFrame:
        """A row for each robot, as a frame of pandas, which has to be installed."""
        import pandas

        rows = []
        for of in self.robots:
            row = {"robot": of.robot, "logs": len(of.t), "chi": of.line.level}
            row |= {"chi_se": of.line.level_se, "scatter": of.line.tau, "per_day": of.line.slope}
            for name in ("drift", "drift_beside", "difference"):
                finding: Finding = getattr(of, name)
                row |= {name: finding.verdict, f"{name}_value": finding.value}
                row |= {f"{name}_low95": finding.low, f"{name}_high95": finding.high}
                row |= {f"{name}_q": finding.q}
            rows.append(row)
        return pandas.DataFrame(rows)

    def plot(self, figure: Figure | None = None) -> Figure:
        """Draw steering efficiencies over time, and the drift of each robot with its interval.

        Parameters
        ----------
        figure : matplotlib figure, optional
            Default: a new one.

        Returns
        -------
        matplotlib figure
            The one that was drawn on.
        """
        from ._drawing import draw

        return draw(self, figure)

    def __str__(self) -> str:
        from ._words import said

        return said(self)

    def _repr_html_(self) -> str:
        from html import escape

        return f"<pre>{escape(str(self))}</pre>"


def trends(
    table: str | os.PathLike[str] | pandas.DataFrame, *, rate: float = 0.05, matters: float = 0.05
) -> Trends:
    """Say which robots drift away from their own past and from their siblings.

    Three questions are asked of each robot, by its steering efficiency chi: does it change along a
    straight line over time; does it change otherwise than those of its siblings; does it differ
    from theirs. Of each effect that diagnoses claim: do later logs have it and earlier ones not.

    Parameters
    ----------
    table : path or frame of pandas
        The table of :func:`trackdyn.fleet.run`. Of a frame, robots and times may have been changed.
    rate : float
        Largest share of wrong answers among the robots that are named for one question, on average
        (false discovery rate, Benjamini and Hochberg).
    matters : float
        Change that matters, as a share of chi: "no" is said only where a larger one is excluded.

    Returns
    -------
    Trends
        The answers are "yes", "no" and "cannot tell", with reasons.

    Notes
    -----
    The noise of a chi is that of its log (``chi_se``); what chis of a robot scatter beyond it, by
    ground and load, is estimated and counts as noise too. A step looks like a drift, and so does
    ground that changes for one robot: whatever all robots see is told by `drift_beside`.
    """
    for name, value in (("rate", rate), ("matters", matters)):
        if not 0.0 < _values.number(name, value) < 1.0:
            raise SettingError(f"{name} {value}: expected a number between 0 and 1", name)
    rows = rows_of(table)
    notes = left_out(rows)
    used = rows[rows["chi_se"].gt(0.0) & rows["time"].notna()].sort_values(["robot", "time", "log"])
    if used.empty:
        raise InputError(f"{name_of(table)}: no log with ICRs and a time: {'; '.join(notes)}")
    begin = int(used["ns"].min())
    by_robot = {
        str(robot): Series(
            (of["ns"].to_numpy() - begin) / _DAY_NS, of["chi"].to_numpy(), of["chi_se"].to_numpy()
        )
        for robot, of in used.groupby("robot")
    }
    common = excess(list(by_robot.values()))
    lines = {robot: line(of, common) for robot, of in by_robot.items()}
    several, those = list(by_robot.values()), list(lines.values())
    own = judged([drift(of, fit, matters) for of, fit in zip(several, those)], rate)
    slopes, shared = drifts_beside(several, those, matters, rate)
    levels = differences(several, those, shared, matters, rate)
    robots = tuple(
        RobotTrend(robot, of.t, of.y, of.s, lines[robot], *findings)
        for (robot, of), *findings in zip(by_robot.items(), own, slopes, levels)
    )
    claims = _claims(rows, rate)
    return Trends(robots, claims, _time(begin), rate, matters, tuple(notes))


def _claims(rows: Any, rate: float) -> tuple[ClaimTrend, ...]:
    diagnosed = rows[rows["diagnosis"].notna() & rows["time"].notna()]
    found: list[tuple[str, Appearance]] = []
    for robot, of in diagnosed.groupby("robot"):
        some = appearances(of["ns"].tolist(), of["claims"].tolist(), rate)
        found.extend((str(robot), one) for one in some)
    findings = judged([order(one) for _, one in found], rate)
    return tuple(
        ClaimTrend(robot, one.effect, one.logs, one.claimed, _time(one.first_ns), finding)
        for (robot, one), finding in zip(found, findings)
    )


def _time(ns: int) -> datetime:
    return datetime.fromtimestamp(ns / 1e9, tz=timezone.utc)
