"""Answers to one question about all robots: yes, no, or cannot tell."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ._appear import Appearance
from ._lines import Line, Series
from ._siblings import MIN_ROBOTS, Siblings, siblings

#: Logs below which no line has an honest interval.
MIN_LOGS = 4

#: Scatters of siblings within which one is as they are.
_ALIKE = 2.0

#: Share of pairs of logs in order that is half-way from no order to sure order.
_LATER = 0.75

#: Standard deviations of the 95 % interval.
_NORMAL = 1.96

#: Why neither is said of an interval.
_WIDE = "the interval holds both none and one that matters"


@dataclass(frozen=True)
class Finding:
    """An answer with its evidence.

    Attributes
    ----------
    value, low, high : float
        The difference or change in question, with its 95 % interval; NaN: not known.
    p : float
        Probability of such evidence by chance; NaN: not tested.
    q : float
        Smallest rate of false alarms at which it is named.
    verdict : {"yes", "no", "cannot tell"}
        "no": a difference that matters is excluded. "cannot tell": neither is shown.
    reason : str
        Why it cannot be told.
    """

    value: float = math.nan
    low: float = math.nan
    high: float = math.nan
    p: float = math.nan
    q: float = math.nan
    verdict: str = "cannot tell"
    reason: str = ""


def judged(findings: Sequence[Finding], rate: float) -> list[Finding]:
    """Findings with q, by Benjamini and Hochberg, and "yes" where that is at most `rate`."""
    tested = [place for place, one in enumerate(findings) if math.isfinite(one.p)]
    judged = list(findings)
    if tested:
        from scipy.stats import false_discovery_control

        adjusted = false_discovery_control([findings[place].p for place in tested])
        for place, q in zip(tested, adjusted):
            one = replace(findings[place], q=float(q))
            judged[place] = replace(one, verdict="yes", reason="") if q <= rate else one
    return judged


def drift(of: Series, fit: Line, matters: float) -> Finding:
    """Change along the line of a robot, before it is judged."""
    if len(of.t) < MIN_LOGS or fit.freedom < 1:
        return Finding(reason=f"{len(of.t)} logs: expected {MIN_LOGS}, of three times")
    value, half = fit.slope * of.span, fit.half_width * of.span
    found = Finding(value, value - half, value + half, fit.p)
    return _answered(found, matters * fit.level)


def judged_beside(
    several: Sequence[Series],
    lines: Sequence[Line],
    what: Literal["slope", "level"],
    matters: float,
    rate: float,
) -> list[Finding]:
    """Each robot against its siblings, by slope (as the change over its own time) or by level."""
    known = [
        place
        for place, fit in enumerate(lines)
        if what == "level" or _has_slope(several, place, fit)
    ]
    if len(known) < MIN_ROBOTS:
        reason = f"{len(known)} robots to compare: expected {MIN_ROBOTS}"
        return [Finding(reason=reason) for _ in lines]
    values = np.array([getattr(lines[place], what) for place in known])
    errors = np.array([_error(several[place], lines[place], what) for place in known])
    against = siblings(values, errors)
    findings = [Finding(reason=f"fewer than {MIN_LOGS} logs") for _ in lines]
    for place, value, error, p in zip(known, values, errors, against.p):
        of, fit = several[place], lines[place]
        scale = of.span if what == "slope" else 1.0
        findings[place] = _beside(value, error, float(p), against, scale, matters * fit.level)
    return judged(findings, rate)


def order(of: Appearance) -> Finding:
    """Whether an effect came later, before it is judged."""
    half = _NORMAL * of.later_se
    found = Finding(of.later, max(of.later - half, 0.0), min(of.later + half, 1.0), of.p)
    if not of.can_tell:
        reason = f"{of.claimed} of {of.logs} logs have it: too few with or without"
        return replace(found, reason=reason)
    if found.high < _LATER:
        return replace(found, verdict="no")
    return replace(found, reason="the interval holds both no order and a clear one")


def _has_slope(several: Sequence[Series], place: int, fit: Line) -> bool:
    return fit.freedom > 0 and len(several[place].t) >= MIN_LOGS


def _error(of: Series, fit: Line, what: str) -> float:
    if what == "level":
        return fit.level_se
    # few logs know their own scatter badly: as wide as Student's interval of them
    return fit.half_width / _NORMAL


def _beside(
    value: float, error: float, p: float, against: Siblings, scale: float, bound: float
) -> Finding:
    away = (value - against.centre) * scale
    half = _NORMAL * math.hypot(error, against.centre_se) * scale
    found = Finding(away, away - half, away + half, p)
    bound = max(bound, _ALIKE * against.scatter * scale)
    return _answered(found, bound)


def _answered(found: Finding, bound: float) -> Finding:
    if -bound < found.low and found.high < bound:
        return replace(found, verdict="no")
    return replace(found, reason=_WIDE)
