"""The catalogue of effects."""

from __future__ import annotations

from dataclasses import dataclass

from . import _trackdyn


@dataclass(frozen=True)
class EffectParameter:
    """A parameter of an effect: its key in files, unit, meaning, role, range and typical value."""

    key: str
    symbol: str
    unit: str
    meaning: str
    role: str
    range: tuple[float, float]
    typical: float


@dataclass(frozen=True)
class Effect:
    """Physics beyond the base model, which a vehicle may have.

    `resembles` is what is not in the catalogue and acts alike. `breaks` are letters of the
    symmetries of the ICRs that it breaks, see docs/effects.md.
    """

    id: str
    title: str
    law: str
    assumes: str
    shows: str
    resembles: str
    breaks: str
    sources: tuple[str, ...]
    parameters: tuple[EffectParameter, ...]


def effects() -> list[Effect]:
    """The catalogue: physics that a vehicle can have beyond the base model.

    Returns
    -------
    list of Effect
        In the order of docs/effects.md. Laws of a user are not among them.
    """
    return [
        Effect(
            **{
                **card,
                "sources": tuple(card["sources"]),
                "parameters": tuple(EffectParameter(**one) for one in card["parameters"]),
            }
        )
        for card in _trackdyn.effects()
    ]
