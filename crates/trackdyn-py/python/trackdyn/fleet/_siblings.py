"""Which of several robots differs from the others.

# Law
v_i ~ N(c, σ² + s_i²): siblings differ by σ, and each value is known to s_i. Centre and scatter are
robust, so that one that differs, or several, does not hide itself: c is a weighted τ-estimate of
location, and σ the scatter with which the τ-scale of (v_i - c)/√(σ² + s_i²) is 1, or 0.

# Sources
τ-estimates: Maronna and Zamar, Technometrics 44 (2002) 307. The equation for σ is that of Paule and
Mandel with their sum of squares replaced. Probabilities are those of simulated siblings that differ
by chance alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]

#: Robots below which none can differ from the rest.
MIN_ROBOTS = 4

#: Simulated fleets at least, so that the rarest of many robots can be told from chance.
_ROUNDS = 40

#: Simulated values, of all robots together.
_DRAWS = 20_000

#: Scatters that are tried beside the one that was found, in units of it and of the median error:
#: few robots show theirs badly, and the largest probability counts.
_SCATTERS = np.array([1.0, 1.5, 2.5, 4.0, 8.0])

#: Probability of a scatter as small as the one found, below which a larger one is not believed.
_LEAST_PLAUSIBLE = 0.02

#: Where the τ-estimates cut off: weights of location, and squares of the scale.
_CUT_LOCATION, _CUT_SCALE = 4.5, 3.0

#: Halvings of the interval that has σ.
_HALVINGS = 12

#: Median of |z| of a standard normal variable.
_MEDIAN_DEVIATION = 0.6745

#: E[min(z², 9)] of a standard normal variable.
_MEAN_CUT_SQUARE = 0.9950


@dataclass(frozen=True)
class Siblings:
    """Several values against each other.

    Attributes
    ----------
    centre, centre_se, scatter : float
        What they have in common, its standard error, and by how much they differ.
    p : ndarray
        Probability that chance puts a sibling as far from the others, of each.
    """

    centre: float
    centre_se: float
    scatter: float
    p: _Array


def siblings(values: _Array, errors: _Array, seed: int = 1) -> Siblings:
    """Compare values with known standard errors, of `MIN_ROBOTS` robots or more."""
    count = len(values)
    unit = float(np.median(errors)) or 1.0
    v, s = values[None, :] / unit, errors[None, :] / unit
    centre, scatter = _fitted(v, s)
    distance = _distance(v, s, centre, scatter)[0]
    normal = np.random.default_rng(seed).standard_normal((max(_DRAWS // count, _ROUNDS), count))
    p = np.zeros(count)
    for sigma in sorted({scatter[0], *_SCATTERS * scatter[0], *_SCATTERS}):
        if sigma >= scatter[0]:
            by_chance, is_plausible = _by_chance(normal, s, float(sigma), float(scatter[0]))
            if is_plausible or sigma == scatter[0]:
                farther = by_chance.size - np.searchsorted(by_chance, distance, side="left")
                p = np.maximum(p, (1.0 + farther) / (1.0 + by_chance.size))
    weights = 1.0 / (scatter[0] ** 2 + s[0] ** 2)
    return Siblings(
        centre=float(centre[0]) * unit,
        centre_se=float(1.0 / np.sqrt(weights.sum())) * unit,
        scatter=float(scatter[0]) * unit,
        p=p,
    )


def _by_chance(normal: _Array, s: _Array, sigma: float, found: float) -> tuple[_Array, bool]:
    """Distances of siblings that differ by `sigma`, sorted; and whether they may seem as alike as
    by `found`."""
    drawn = normal * np.sqrt(sigma**2 + s**2)
    centre, scatter = _fitted(drawn, s)
    is_plausible = bool(np.mean(scatter <= found) >= _LEAST_PLAUSIBLE)
    return np.sort(_distance(drawn, s, centre, scatter).ravel()), is_plausible


def _distance(v: _Array, s: _Array, centre: _Array, scatter: _Array) -> _Array:
    result: _Array = np.abs(v - centre[:, None]) / np.sqrt(scatter[:, None] ** 2 + s**2)
    return result


def _fitted(v: _Array, s: _Array) -> tuple[_Array, _Array]:
    """Centre and scatter of each row."""
    middle_of = _median(v)
    low = np.zeros(len(v))
    high = 2.0 * _median(np.abs(v - middle_of[:, None])) / _MEDIAN_DEVIATION + 1e-12
    for _ in range(_HALVINGS):
        middle = (low + high) / 2.0
        is_narrow = _scale(v, s, middle)[1] > 1.0
        low, high = np.where(is_narrow, middle, low), np.where(is_narrow, high, middle)
    # no scatter where the errors alone explain all
    scatter = np.where(_scale(v, s, np.zeros(len(v)))[1] <= 1.0, 0.0, high)
    return _scale(v, s, scatter)[0], scatter


def _scale(v: _Array, s: _Array, scatter: _Array) -> tuple[_Array, _Array]:
    """Centre of each row, and the τ-scale of its values in units of their standard deviations."""
    deviation = np.sqrt(scatter[:, None] ** 2 + s**2)
    z = (v - _median(v)[:, None]) / deviation
    rough = _median(np.abs(z))[:, None] / _MEDIAN_DEVIATION + 1e-12
    # bisquare weights
    weights = np.clip(1.0 - (z / rough / _CUT_LOCATION) ** 2, 0.0, None) ** 2 / deviation**2
    centre = (weights * v).sum(axis=1) / weights.sum(axis=1)
    z = (v - centre[:, None]) / deviation
    cut = np.minimum((z / rough) ** 2, _CUT_SCALE**2)
    scale = rough[:, 0] * np.sqrt(cut.mean(axis=1) / _MEAN_CUT_SQUARE)
    return centre, scale


def _median(v: _Array) -> _Array:
    """Median of each row: short rows are sorted faster than NumPy finds their medians."""
    ordered = np.sort(v, axis=1)
    half = v.shape[1] // 2
    result: _Array = (ordered[:, half] + ordered[:, -half - 1]) / 2.0
    return result
