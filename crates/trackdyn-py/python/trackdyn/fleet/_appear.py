"""Claims that appear: effects that the later logs of a robot show and the earlier ones do not."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Logs up to which the test counts all orders.
_MAX_EXACT = 200


@dataclass(frozen=True)
class Appearance:
    """An effect in the logs of a robot, by time.

    Attributes
    ----------
    effect : str
        The effect, or several that were only claimed together.
    logs, claimed : int
        Logs that were diagnosed, and those whose diagnosis may mean it.
    first_ns : int
        Begin of the first log that has it, Unix time.
    later, later_se : float
        Share of pairs of a log with it and one without of which the one with it is later: 0.5 where
        there is no order, 1 where it appeared and stayed. With its standard error.
    p : float
        Probability that logs in an order of chance have it so late.
    can_tell : bool
        Whether any order of the logs could show it at `rate`.
    """

    effect: str
    logs: int
    claimed: int
    first_ns: int
    later: float
    later_se: float
    p: float
    can_tell: bool


def appearances(
    times_ns: Sequence[int], claims: Sequence[Sequence[Any]], rate: float
) -> Iterator[Appearance]:
    """Each effect that a log of a robot may have, with the test of whether it came later.

    Parameters
    ----------
    times_ns : sequence of int
        Begin of each log.
    claims : sequence of sequence of mapping
        Its claims, as in the table.
    rate : float
        Probability below which an order counts.
    """
    times = np.asarray(times_ns)
    per_log = [{effect for claim in of for effect in claim["one_of"]} for of in claims]
    together: dict[tuple[bool, ...], list[str]] = {}
    for effect in sorted(set().union(*per_log)):
        together.setdefault(tuple(effect in of for of in per_log), []).append(effect)
    for pattern, effects in together.items():
        has = np.asarray(pattern)
        later, p = _order(times, has)
        yield Appearance(
            effect=" or ".join(effects),
            logs=len(has),
            claimed=int(has.sum()),
            first_ns=int(times[has].min()),
            later=later,
            later_se=_later_se(later, has),
            p=p,
            can_tell=_order(np.arange(len(has)), np.sort(has))[1] <= rate,
        )


def _order(times: NDArray[Any], has: NDArray[np.bool_]) -> tuple[float, float]:
    """Mann and Whitney: the share of pairs in this order, and whether it is more than chance."""
    from scipy.stats import mannwhitneyu

    if has.all():
        return math.nan, 1.0
    # ranks: floats have no place for ns
    ranks = np.unique(times, return_inverse=True)[1]
    is_exact = len(np.unique(times)) == len(times) <= _MAX_EXACT
    method = "exact" if is_exact else "asymptotic"
    found = mannwhitneyu(ranks[has], ranks[~has], alternative="greater", method=method)
    return float(found.statistic) / (int(has.sum()) * int((~has).sum())), float(found.pvalue)


def _later_se(later: float, has: NDArray[np.bool_]) -> float:
    """Standard error of that share: Hanley and McNeil, Radiology 143 (1982) 29.

    σ² = (A (1 - A) + (n - 1) (A/(2 - A) - A²) + (m - 1) (2 A²/(1 + A) - A²))/(n m)
    """
    with_it, without = int(has.sum()), int((~has).sum())
    if not without:
        return math.nan
    # a share of 1 would have no error
    a = min(later, 1.0 - 0.5 / (with_it * without))
    spread = (with_it - 1) * (a / (2.0 - a) - a**2)
    spread += (without - 1) * (2.0 * a**2 / (1.0 + a) - a**2)
    return math.sqrt((a * (1.0 - a) + spread) / (with_it * without))
