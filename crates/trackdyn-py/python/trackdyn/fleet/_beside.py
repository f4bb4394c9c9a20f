"""Robots against their siblings: by their drifts, and by their levels."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ._judged import MIN_LOGS, NORMAL, Finding, answered, has_slope, judged
from ._lines import Line, Series
from ._siblings import MIN_ROBOTS, siblings

#: Scatters of siblings within which one is as they are.
_ALIKE = 2.0


@dataclass(frozen=True)
class Common:
    """The slope that siblings have in common, per day, with its standard error."""

    slope: float = 0.0
    slope_se: float = 0.0


def drifts_beside(
    several: Sequence[Series], lines: Sequence[Line], matters: float, rate: float
) -> tuple[list[Finding], Common]:
    """The change of each robot over its own time, less that of its siblings; and their slope."""
    known = [place for place, fit in enumerate(lines) if has_slope(several[place], fit)]
    findings = [Finding(reason=f"fewer than {MIN_LOGS} logs") for _ in lines]
    if len(known) < MIN_ROBOTS:
        return [_too_few(len(known)) for _ in lines], Common()
    slopes = np.array([lines[place].shared_slope for place in known])
    errors = np.array([lines[place].shared_slope_se for place in known])
    against = siblings(slopes, errors)
    for place, slope, error, p in zip(known, slopes, errors, against.p):
        span = several[place].span
        away = (slope - against.centre) * span
        half = NORMAL * math.hypot(error, against.centre_se) * span
        bound = max(matters * lines[place].level, _ALIKE * against.scatter * span)
        findings[place] = answered(Finding(away, away - half, away + half, float(p)), bound)
    return judged(findings, rate), Common(against.centre, against.centre_se)


def differences(
    several: Sequence[Series], lines: Sequence[Line], common: Common, matters: float, rate: float
) -> list[Finding]:
    """The level of each robot less that of its siblings.

    Robots that were driven at other times are compared along the slope that all have in common.
    """
    if len(lines) < MIN_ROBOTS:
        return [_too_few(len(lines)) for _ in lines]
    middles = np.array([of.t.mean() for of in several])
    away = middles - np.median(middles)
    levels = np.array([fit.level for fit in lines]) - common.slope * away
    errors = np.hypot([fit.level_se for fit in lines], common.slope_se * away)
    against = siblings(levels, errors)
    bounds = [max(matters * fit.level, _ALIKE * against.scatter) for fit in lines]
    halves = NORMAL * np.hypot(errors, against.centre_se)
    found = [
        Finding(float(value), float(value - half), float(value + half), float(p))
        for value, half, p in zip(levels - against.centre, halves, against.p)
    ]
    return judged([answered(one, bound) for one, bound in zip(found, bounds)], rate)


def _too_few(robots: int) -> Finding:
    return Finding(reason=f"robots to compare: {robots}, expected {MIN_ROBOTS}")
