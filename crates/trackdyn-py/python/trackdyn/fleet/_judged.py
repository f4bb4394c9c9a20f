"""Answers to one question about all robots: yes, no, or cannot tell."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from ._appear import Appearance
from ._lines import Line, Series

#: Logs below which no line has an honest interval.
MIN_LOGS = 4

#: Share of pairs of logs in order that is half-way from no order to sure order.
_LATER = 0.75

#: Standard deviations of half a 95 % interval.
NORMAL = 1.96

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


def has_slope(of: Series, fit: Line) -> bool:
    """Whether there are logs enough for a slope with an honest interval."""
    return len(of.t) >= MIN_LOGS and fit.freedom > 0


def drift(of: Series, fit: Line, matters: float) -> Finding:
    """Change along the line of a robot, before it is judged."""
    if not has_slope(of, fit):
        return Finding(reason=f"logs: {len(of.t)}, expected {MIN_LOGS} at three times or more")
    value, half = fit.slope * of.span, fit.half_width * of.span
    found = Finding(value, value - half, value + half, fit.p)
    return answered(found, matters * fit.level)


def order(of: Appearance) -> Finding:
    """Whether an effect came later, before it is judged."""
    half = NORMAL * of.later_se
    found = Finding(of.later, max(of.later - half, 0.0), min(of.later + half, 1.0), of.p)
    if not of.can_tell:
        reason = f"{of.claimed} of {of.logs} logs have it: too few with or without"
        return replace(found, reason=reason)
    if found.high < _LATER:
        return replace(found, verdict="no")
    return replace(found, reason="the interval holds both no order and a clear one")


def answered(found: Finding, bound: float) -> Finding:
    """A finding with "no" where its interval lies within a bound; else with the reason."""
    if -bound < found.low and found.high < bound:
        return replace(found, verdict="no")
    return replace(found, reason=_WIDE)
