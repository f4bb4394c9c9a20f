"""Lines through numbers with known noise and scatter beyond it.

# Law
y_j = a + b (t_j - t̄) + u_j + ε_j, with ε_j ~ N(0, s_j²) known and u_j ~ N(0, τ²): what differs from
log to log and is no error of the fit, such as ground, load and belts.

# Sources
τ² by restricted maximum likelihood; intervals by Knapp and Hartung, Statistics in Medicine 22
(2003) 2693, with Student's distribution and no factor below 1: without that, simulated logs of
unequal noise were named in 8 instead of 5 of 100 cases.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]


@dataclass(frozen=True)
class Series:
    """The numbers of a robot: times (days), values, and standard errors of the values."""

    t: _Array
    y: _Array
    s: _Array

    @property
    def span(self) -> float:
        """Time from the first to the last, days."""
        return float(np.ptp(self.t)) if len(self.t) else 0.0

    @cached_property
    def design(self) -> _Array:
        """A level at the mean time and, where there are three times or more, a slope."""
        level = np.ones_like(self.t)
        if len(np.unique(self.t)) < 3:
            return level[:, None]
        return np.column_stack([level, self.t - self.t.mean()])


@dataclass(frozen=True)
class Line:
    """A level at the mean time and, of three logs or more, a slope per day.

    Attributes
    ----------
    level, level_se : float
        The level and its standard error, with the scatter `tau`.
    tau : float
        Scatter beyond the noise: its own, or what all robots have where that is more.
    slope, slope_se, freedom : float, float, int
        The slope by this series alone, its standard error by Knapp and Hartung, and the degrees of
        freedom of that.
    shared_slope, shared_slope_se : float
        The slope with the scatter `tau`: what is compared between robots, since the error of few
        logs alone is known too badly for the farthest of many robots.
    """

    level: float
    level_se: float
    tau: float
    slope: float = float("nan")
    slope_se: float = float("nan")
    freedom: int = 0
    shared_slope: float = float("nan")
    shared_slope_se: float = float("nan")

    @property
    def p(self) -> float:
        """Probability of such a slope by chance."""
        from scipy.stats import t as student

        # logs on a line to the last digit have no error
        return float(2.0 * student.sf(abs(self.slope) / max(self.slope_se, 1e-300), self.freedom))

    @property
    def half_width(self) -> float:
        """Half the 95 % interval of the slope."""
        from scipy.stats import t as student

        return float(student.ppf(0.975, self.freedom) * self.slope_se)


def excess(several: Sequence[Series]) -> float:
    """Scatter τ beyond the noise that several series have in common, each with its own line."""
    from scipy.optimize import minimize_scalar

    fitted = [one for one in several if len(one.t) > one.design.shape[1]]
    if not fitted:
        return 0.0
    largest = max(float(np.ptp(one.y)) for one in fitted)
    if largest == 0.0:
        return 0.0

    # -2 ln L_R = Σ ln(s² + τ²) + ln |Xᵀ W X| + rᵀ W r,  W = diag 1/(s² + τ²)
    def objective(tau: float) -> float:
        total = 0.0
        for one in fitted:
            variance = one.s**2 + tau**2
            normal, r = _solved(one, variance)[1:]
            total += float(np.sum(np.log(variance)) + np.linalg.slogdet(normal)[1])
            total += float(np.sum(r**2 / variance))
        return total

    found = minimize_scalar(
        objective, bounds=(0.0, 2.0 * largest), method="bounded", options={"xatol": 1e-4 * largest}
    )
    return 0.0 if objective(0.0) <= found.fun else float(found.x)


def line(of: Series, least_tau: float) -> Line:
    """The line through a series.

    Parameters
    ----------
    of : Series
        One value or more.
    least_tau : float
        What the level scatters from log to log at least: few logs of their own show it badly.
    """
    own = excess([of])
    tau = max(own, least_tau)
    beta, normal, _ = _solved(of, of.s**2 + tau**2)
    errors = np.sqrt(np.diag(np.linalg.inv(normal)))
    level, level_se = float(beta[0]), float(errors[0])
    freedom = len(of.t) - of.design.shape[1]
    if of.design.shape[1] < 2 or freedom < 1:
        return Line(level, level_se, tau)
    shared = float(beta[1]), float(errors[1])
    variance = of.s**2 + own**2
    beta, normal, r = _solved(of, variance)
    # var b = q (Xᵀ W X)⁻¹,  q = max(1, rᵀ W r/(n - 2))
    q = max(1.0, float(np.sum(r**2 / variance)) / freedom)
    slope_se = float(np.sqrt(q * np.linalg.inv(normal)[1, 1]))
    return Line(level, level_se, tau, float(beta[1]), slope_se, freedom, *shared)


def _solved(of: Series, variance: _Array) -> tuple[_Array, _Array, _Array]:
    """Weighted least squares: parameters, normal matrix, residuals."""
    x = of.design
    weighted = x / variance[:, None]
    normal: _Array = x.T @ weighted
    beta: _Array = np.asarray(np.linalg.solve(normal, weighted.T @ of.y), dtype=np.float64)
    return beta, normal, of.y - x @ beta
