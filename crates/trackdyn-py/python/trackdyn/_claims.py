"""What a diagnosis claims, and what it refuses to claim."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Size:
    """A parameter of a claimed effect, with its 95 % interval, in `unit`."""

    name: str
    value: float
    low: float
    high: float
    unit: str


@dataclass(frozen=True)
class Claim:
    """Something that the model of a vehicle lacks.

    Attributes
    ----------
    effect : str
        The effect that was fitted, by its id in the catalogue.
    one_of : tuple of str
        All effects that explain the recordings alike, the fitted one among them.
    kind : {"physics", "instrument", "constant"}
        What kind of thing it is.
    sizes : tuple of Size
        Parameters of the fitted effect; empty where it stands for a class of constants.
    p : float
        Probability of such evidence by chance, over all effects that were tried.
    ln_bayes_factor : float
        Logarithm of the Bayes factor against the best alternative.
    held_out_gain : float
        Gain of log-likelihood on blocks left out of the fit.
    separate_by : str or None
        How to decide between several; None where one is named.
    """

    effect: str
    one_of: tuple[str, ...]
    kind: str
    sizes: tuple[Size, ...]
    p: float
    ln_bayes_factor: float
    held_out_gain: float
    separate_by: str | None


@dataclass(frozen=True)
class Refusal:
    """Effects of the best hypothesis that are not claimed, and why."""

    one_of: tuple[str, ...]
    reason: str


def claim_of(of: Mapping[str, Any], kind: str) -> Claim:
    """The claim of a table of a diagnosis file."""
    sizes = (
        Size(one["name"], one["value"], one["low95"], one["high95"], one["unit"])
        for one in of["parameters"]
    )
    evidence = of["evidence"]
    return Claim(
        effect=of["effect"],
        one_of=tuple(of["one_of"]),
        kind=kind,
        sizes=tuple(sizes),
        p=evidence["p"],
        ln_bayes_factor=evidence["ln_bayes_factor"],
        held_out_gain=evidence["held_out_gain"],
        separate_by=of.get("separate_by"),
    )
