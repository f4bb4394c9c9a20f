"""Vehicles."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Union

from . import _trackdyn, _values
from ._arguments import plain
from ._document import Document
from ._errors import SettingError, VehicleError
from ._laws import Law, LawLike, of_ids


class Vehicle(Document):
    """A vehicle, and the physics that its model has beyond the base model.

    Parameters
    ----------
    source : str, path or mapping, optional
        The path of a vehicle file (schema ``trackdyn.vehicle/1``), the name of a vehicle that needs
        no file (:meth:`names`), or what such a file says as a dict. In its place the numbers may be
        given as keywords.
    name : str
        What outputs call it.
    gauge : float
        Distance between the centre-lines of the two sides, m.
    mass : float
        Mass with all that it carries, kg.
    contact_length : float
        Length of the contact of a belt, or of one tyre, m.
    width : float
        Width of a belt or a tyre, m.
    axles : sequence of float, optional
        Places of the axles, m forward of the middle. None: tracks.
    cog : pair of float, optional
        Centre of gravity, m right and forward of the centre of the contact area.
    friction : pair of float, optional
        Friction coefficients across and along. Default: a guess, 0.8 and 0.8.
    effects : iterable of str
        Effects such as ``"load-transfer:cog_height_m=0.15"``, see :func:`trackdyn.effects`.

    Examples
    --------
    >>> import trackdyn as td
    >>> td.Vehicle("husky-a200").gauge
    0.555
    >>> robot = td.Vehicle(gauge=0.42, mass=258.0, contact_length=0.7, width=0.15)
    >>> robot.with_effect("centripetal").effects
    ['centripetal:strength=1']
    """

    __slots__ = ("_inner",)
    _inner: _trackdyn.Vehicle

    def __init__(
        self,
        source: str | os.PathLike[str] | Mapping[str, Any] | None = None,
        *,
        name: str = "vehicle",
        gauge: float | None = None,
        mass: float | None = None,
        contact_length: float | None = None,
        width: float | None = None,
        axles: Sequence[float] | None = None,
        cog: Sequence[float] | None = None,
        friction: Sequence[float] | None = None,
        effects: Iterable[str] = (),
    ) -> None:
        numbers = {"gauge": gauge, "mass": mass, "contact_length": contact_length, "width": width}
        others = {"axles": axles, "cog": cog, "friction": friction}
        given = [key for key, one in {**numbers, **others}.items() if one is not None]
        if source is not None and given:
            raise VehicleError(f"{', '.join(given)}: {source!s} says it: expected one of both")
        if isinstance(source, Mapping):
            text = _trackdyn.to_toml(plain({"schema": "trackdyn.vehicle/1", **source}))
            inner = _trackdyn.Vehicle.from_toml("vehicle", text)
        elif source is not None:
            expected = "the path of a file, the name of a preset, or a dict"
            if not isinstance(source, (str, os.PathLike)):
                raise _values.refused("vehicle", source, expected)
            inner = _trackdyn.Vehicle.choose(source)
        else:
            if gauge is None or mass is None or contact_length is None or width is None:
                missing = ", ".join(key for key, one in numbers.items() if one is None)
                expected = "expected a file, a name, a dict, or numbers"
                raise VehicleError(f"{missing}: not given: {expected}")
            inner = _trackdyn.Vehicle.of_numbers(
                _values.text("name", name),
                _values.number("gauge", gauge),
                _values.number("mass", mass),
                _values.number("contact_length", contact_length),
                _values.number("width", width),
                _values.maybe(_axles, "axles", axles),
                _values.maybe(_pair, "cog", cog),
                _values.maybe(_pair, "friction", friction),
            )
        for effect in _values.texts("effects", effects):
            inner = inner.with_effect(effect)
        self._inner = inner

    @classmethod
    def _of(cls, inner: _trackdyn.Vehicle) -> Vehicle:
        self = object.__new__(cls)
        self._inner = inner
        return self

    @classmethod
    def from_toml(cls, text: str, name: str = "vehicle") -> Vehicle:
        """The vehicle of the text of a vehicle file.

        Parameters
        ----------
        text : str
            The text.
        name : str
            What errors call it.

        Returns
        -------
        Vehicle
        """
        name, text = _values.text("name", name), _values.text("text", text)
        return cls._of(_trackdyn.Vehicle.from_toml(name, text))

    @staticmethod
    def names() -> list[str]:
        """The names of the vehicles that need no file."""
        return _trackdyn.Vehicle.names()

    @property
    def name(self) -> str:
        """What outputs call it."""
        return self._inner.name

    @property
    def gauge(self) -> float:
        """Distance between the centre-lines of the two sides, m."""
        return self._inner.gauge

    @property
    def effects(self) -> list[str]:
        """The effects that its model has, with their parameters."""
        return self._inner.effects

    def __eq__(self, other: object) -> bool:
        """Whether both are the same, wherever their numbers come from."""
        if not isinstance(other, Vehicle):
            return NotImplemented
        return self.fingerprint == other.fingerprint

    def __hash__(self) -> int:
        return hash(self.fingerprint)

    @property
    def fingerprint(self) -> str:
        """Fingerprint of the text of its file: equal vehicles have equal ones."""
        return self._inner.fingerprint

    def with_effect(self, effect: LawLike, **parameters: float) -> Vehicle:
        """The vehicle with an effect in place of the one of this kind that it may have.

        Parameters
        ----------
        effect : str or Law
            ``"id"`` or ``"id:parameter=value,..."``, or a law as :func:`law` makes it.
        **parameters : float
            Parameters of the effect by their keys, in the unit that the key ends in.

        Returns
        -------
        Vehicle
        """
        if isinstance(effect, Law):
            return self._of(self._inner.with_effect(effect.with_values(**parameters)))
        effect = _values.text("effect", effect)
        if parameters:
            numbers = {key: _values.number(key, value) for key, value in parameters.items()}
            settings = ",".join(f"{key}={value!r}" for key, value in numbers.items())
            effect = f"{effect}{',' if ':' in effect else ':'}{settings}"
        return self._of(self._inner.with_effect(effect))

    def with_cog(self, right: float, forward: float) -> Vehicle:
        """The vehicle with another centre of gravity.

        Parameters
        ----------
        right, forward : float
            Its place, m right and forward of the centre of the contact area.

        Returns
        -------
        Vehicle
        """
        cog = _values.number("right", right), _values.number("forward", forward)
        return self._of(self._inner.with_cog(cog))

    def with_inertia(self, inertia: bool = True) -> Vehicle:
        """The vehicle with its inertia in the model, or without.

        Parameters
        ----------
        inertia : bool
            Whether it has inertia.

        Returns
        -------
        Vehicle
        """
        return self._of(self._inner.with_inertia(_values.flag("inertia", inertia)))

    def with_values(self, values: Mapping[str, Any]) -> Vehicle:
        """The vehicle with other values in its file.

        Parameters
        ----------
        values : mapping
            Values by their place in the file, such as ``{"mass_kg": 80.0, "friction.mu_x": 0.7,
            "effect.load-transfer.cog_height_m": 0.3}``.

        Returns
        -------
        Vehicle
        """
        tables = self.to_dict()
        expected = "values by their place in the file, such as {'mass_kg': 80.0}"
        for place, value in _values.mapping("values", values, expected).items():
            *path, key = _values.text("values", place).split(".")
            table = tables
            for step in path:
                table = table.setdefault(step, {})
                if not isinstance(table, dict):
                    raise SettingError(f"values {place}: {step} is no table: expected a key", "values")
            table[key] = value
        return Vehicle(tables)

    def __reduce__(self) -> tuple[Any, ...]:
        # reading the laws imports the modules that define them
        laws = of_ids(self._inner.laws)
        return _restored, (self._inner.toml, *laws)

    def __repr__(self) -> str:
        effects = "".join(f", {effect}" for effect in self.effects)
        return f"<Vehicle {self.name}, gauge {self.gauge} m{effects}>"


def _restored(text: str, *_: Law) -> Vehicle:
    """A vehicle from a pickle, with laws that are defined by now."""
    return Vehicle.from_toml(text)


#: A vehicle, or what makes one: the path of a file, the name of a preset, or a dict.
VehicleLike = Union[Vehicle, str, "os.PathLike[str]", Mapping[str, Any]]


def _axles(name: str, axles: Any) -> list[float]:
    return _values.numbers(name, axles, "places in m forward of the middle")


def _pair(name: str, pair: Any) -> tuple[float, float]:
    one, other = _values.numbers(name, pair, "two numbers", 2)
    return one, other
