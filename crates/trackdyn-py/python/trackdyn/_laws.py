"""Laws of a user: effects beside the catalogue, as functions."""

from __future__ import annotations

import inspect
import pickle
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, Union

import numpy as np
from numpy.typing import NDArray

from . import _trackdyn, _values
from ._errors import EffectError, SettingError
from ._shipping import bytes_of, digest, function_of, has_cloudpickle, imported, is_importable
from ._trace import Taped, stand_in, traced

#: An array of what a law sees, one number for each state.
Column = NDArray[np.float64]

#: What a law of each kind may return: least and most rows, and what they are.
_ADDS = {
    "force": (2, 3, "force forward and to the left (N), and a moment (N m) where there is one"),
    "friction": (1, 2, "a factor on friction, or one along and one across the track"),
}

#: All laws, by their ids: the last one that was defined under each.
_LAWS: dict[str, Law] = {}


@dataclass(frozen=True)
class Parameter:
    """A parameter of a law.

    Parameters
    ----------
    unit : str
        Its unit, ``"1"`` for pure numbers.
    typical : float
        Typical value: the default. A diagnosis begins here and expects a few times it.
    low, high : float
        Smallest and largest physical value.
    role : str
        ``"size"``: the law does nothing at its `neutral` value. ``"shape"``: another number of the
        law. ``"direction"``: in the world, degrees. ``"x"``, ``"y"``: a place in the world, m.
        ``"time"``: since the start of the recording, s.
    neutral : float
        The value of a size at which the law does nothing.
    meaning : str
        What reports say of it.
    """

    unit: str
    typical: float
    low: float = -np.inf
    high: float = np.inf
    role: Literal["size", "shape", "direction", "x", "y", "time"] = "size"
    neutral: float = 0.0
    meaning: str = ""


class Seen:
    """What a law sees: arrays of one length, with a number for each state.

    Axes are those of REP-103, x forward and y left. Every law sees the motion, the place, the
    heading and the time. One that acts as a force sees the loads too, one that acts on friction the
    slip, the pressure and the place of the point.
    """

    __slots__ = ("_acts", "_columns", "_of_acts", "_read")
    _places: dict[str, dict[str, int]] = {
        acts: {name: place for place, name in enumerate(_trackdyn.law_arguments(acts))}
        for acts in _ADDS
    }

    def __init__(self, acts: str, columns: Any) -> None:
        self._acts = acts
        self._columns = columns
        self._of_acts = self._places[acts]
        #: Columns that were read, a bit each.
        self._read = 0

    def __len__(self) -> int:
        return len(self._columns[0])

    def _of(self, name: str) -> Column:
        place = self._of_acts.get(name)
        if place is None:
            names = ", ".join(self._places[self._acts])
            found = f"{name}: a law that acts as {self._acts} does not see it"
            raise EffectError(f"{found}: expected {names}")
        self._read |= 1 << place
        column: Column = self._columns[place]
        return column

    @property
    def v_forward(self) -> Column:
        """Speed of the centre of gravity forward, m/s."""
        return self._of("v_forward")

    @property
    def v_lateral(self) -> Column:
        """Speed of the centre of gravity to the left, m/s."""
        return self._of("v_lateral")

    @property
    def yaw_rate(self) -> Column:
        """Yaw rate, rad/s, counter-clockwise."""
        return self._of("yaw_rate")

    @property
    def v_left(self) -> Column:
        """Speed of the left belt over the hull, m/s."""
        return self._of("v_left")

    @property
    def v_right(self) -> Column:
        """Speed of the right belt over the hull, m/s."""
        return self._of("v_right")

    @property
    def x(self) -> Column:
        """Place of the robot in the world, m."""
        return self._of("x")

    @property
    def y(self) -> Column:
        """Place of the robot in the world, m."""
        return self._of("y")

    @property
    def heading(self) -> Column:
        """Heading, rad, counter-clockwise from the world's x axis."""
        return self._of("heading")

    @property
    def time(self) -> Column:
        """Time since the start of the recording, s."""
        return self._of("time")

    @property
    def load_left(self) -> Column:
        """Weight on the left side, N. For forces."""
        return self._of("load_left")

    @property
    def load_right(self) -> Column:
        """Weight on the right side, N. For forces."""
        return self._of("load_right")

    @property
    def slip_forward(self) -> Column:
        """Slip velocity of the belt over the ground forward, m/s. For friction."""
        return self._of("slip_forward")

    @property
    def slip_lateral(self) -> Column:
        """Slip velocity of the belt over the ground to the left, m/s. For friction."""
        return self._of("slip_lateral")

    @property
    def slip_speed(self) -> Column:
        """Size of the slip velocity, m/s. For friction."""
        return self._of("slip_speed")

    @property
    def pressure(self) -> Column:
        """Normal pressure, Pa. For friction."""
        return self._of("pressure")

    @property
    def belt_speed(self) -> Column:
        """Speed of the belt over the hull, m/s. For friction."""
        return self._of("belt_speed")

    @property
    def point_forward(self) -> Column:
        """Place of the point, m forward of the middle of the contact area. For friction."""
        return self._of("point_forward")

    @property
    def point_lateral(self) -> Column:
        """Place of the point, m to the left of the middle of the contact area. For friction."""
        return self._of("point_lateral")

    @property
    def point_x(self) -> Column:
        """Place of the point in the world, m. For friction."""
        return self._of("point_x")

    @property
    def point_y(self) -> Column:
        """Place of the point in the world, m. For friction."""
        return self._of("point_y")


class Law:
    """A law of a user, as :func:`law` makes it of a function.

    Attributes
    ----------
    id : str
        Its name in files.
    acts : str
        ``"force"`` or ``"friction"``.
    summary : str
        What reports say of it.
    parameters : dict of Parameter
        Its parameters by their names.
    function : callable
        The function.
    fingerprint : str
        Fingerprint of its code, of the values around it, and of its parameters.
    breaks : str
        Letters of the symmetries of the ICRs that it breaks at typical values, see docs/effects.md.
    is_compiled : bool
        Whether what the function does was noted, so that no interpreter is needed: tens of times
        faster. It takes arithmetic, masks, ``if``, loops over elements, functions of numpy, math
        and ``scipy.special`` element by element, and splines of ``scipy.interpolate``.
    """

    def __init__(
        self,
        function: Callable[..., Any],
        id: str,
        acts: Literal["force", "friction"],
        parameters: Mapping[str, Parameter],
        summary: str,
    ) -> None:
        self.id = id
        self.acts = acts
        self.summary = summary
        self.parameters = dict(parameters)
        self.function = function
        self.__name__ = function.__name__
        self.__qualname__ = function.__qualname__
        self.__module__ = function.__module__
        self.__doc__ = function.__doc__
        #: The function as bytes, where it was sent to another process or came from one.
        self._sent: bytes | None = None
        self._check()
        counts = len(Seen._places[acts]), len(self.parameters), 3 if acts == "force" else 2
        samples = _samples(counts[0], self.parameters.values())
        function = stand_in(self.function)
        def adds_of(columns: Sequence[Any], values: Sequence[Any]) -> list[Any]:
            """What the function returns for what stands for arrays."""
            return self._adds(Seen(self.acts, columns), values, function)

        tape = traced(adds_of, self._evaluated, counts, samples)

        def trace(values: Sequence[float]) -> Taped | None:
            """What the function does at these values, where that depends on them."""
            at_values = [(columns, values) for columns, _ in samples]
            adds = lambda columns, _: adds_of(columns, values)  # noqa: E731
            return traced(adds, self._evaluated, counts, at_values)

        can_trace = tape is None and all(trace(values) for _, values in samples)
        self.is_compiled = tape is not None or can_trace
        declared = [{"key": key, **vars(one)} for key, one in self.parameters.items()]
        retrace = trace if can_trace else None
        self.breaks = _trackdyn.register_law(
            id, summary, acts, declared, self._called, tape, retrace
        )
        _LAWS[id] = self

    def _check(self) -> None:
        """Whether the function takes what the law sees and the parameters."""
        expected = f"expected (at, {', '.join(self.parameters)})"
        try:
            inspect.signature(self.function).bind(None, **dict.fromkeys(self.parameters))
        except TypeError as error:
            raise SettingError(f"law {self.id!r}: its function: {error}: {expected}") from None

    def _adds(
        self, seen: Seen, values: Sequence[Any], function: Callable[..., Any]
    ) -> list[Any]:
        """What the function returns, as a list with all that a law of this kind adds."""
        found = function(seen, **dict(zip(self.parameters, values)))
        least, most, expected = _ADDS[self.acts]
        is_list = isinstance(found, (tuple, list)) or getattr(found, "ndim", 1) > 1
        adds = list(found) if is_list else [found]
        if not least <= len(adds) <= most:
            raise self._refused(f"{len(adds)} results", expected)
        if self.acts == "friction":
            return [adds[0], adds[-1]]
        return [*adds, 0.0] if len(adds) == least else adds

    def _evaluated(self, columns: Any, values: Sequence[float]) -> NDArray[np.float64]:
        """What the law adds, rows of all that a law of this kind adds."""
        return self._called(columns, values)[0]

    def _called(
        self, columns: Any, values: Sequence[float]
    ) -> tuple[NDArray[np.float64], int]:
        """What the law adds, and the columns that the function read, a bit each."""
        seen = Seen(self.acts, columns)
        adds = self._adds(seen, values, self.function)
        shape = columns.shape[1:]
        rows = np.empty((len(adds), *shape))
        for place, result in enumerate(adds):
            kind = type(result)
            # what nearly all functions return, without further questions
            is_row = kind is np.ndarray and result.shape == shape and result.dtype.char == "d"
            rows[place] = result if is_row or kind is float else self._row(result, shape)
        return rows, seen._read

    def _row(self, result: Any, shape: tuple[int, ...]) -> NDArray[np.float64]:
        """A result as numbers, one for each state or one for all."""
        array = _values.floats(result)
        if array is None or array.shape not in ((), (1,), shape):
            found = f"a {type(result).__name__}" if array is None else f"shape {array.shape}"
            raise self._refused(found, f"numbers of shape {shape}, as in what it sees")
        return array

    def _refused(self, found: str, expected: str) -> EffectError:
        names = ", ".join(self.parameters)
        found = f"law {self.id!r} ({names}): its function returned {found}"
        return EffectError(f"{found}: expected {expected}")

    def with_values(self, **parameters: float) -> str:
        """The law as an effect of a vehicle.

        Parameters
        ----------
        **parameters : float
            Values of its parameters; others have their typical ones.

        Returns
        -------
        str
            ``"id:parameter=value,..."``.
        """
        unknown = [key for key in parameters if key not in self.parameters]
        if unknown:
            names = ", ".join(self.parameters)
            raise EffectError(f"law {self.id!r}, parameter {unknown[0]}: expected one of {names}")
        numbers = {key: _values.number(key, value) for key, value in parameters.items()}
        settings = ",".join(f"{key}={value!r}" for key, value in numbers.items())
        return f"{self.id}:{settings}" if settings else self.id

    def __call__(self, at: Any, *args: Any, **parameters: Any) -> Any:
        """Call the function."""
        return self.function(at, *args, **parameters)

    @property
    def fingerprint(self) -> str:
        """Fingerprint of its code, of the values around it, and of its parameters."""
        return digest(self.function, (self.id, self.acts, self.parameters))

    def __reduce__(self) -> str | tuple[Any, ...]:
        has_name = is_importable(self)
        if has_name and not has_cloudpickle():
            return self.__qualname__
        return _received, self._parts((self.__module__, self.__qualname__) if has_name else None)

    def _parts(self, name: tuple[str, str] | None) -> tuple[Any, ...]:
        """What another process makes it from."""
        if self._sent is None:
            self._sent = bytes_of(self.function, self.id)
        return name, self._sent, self.id, self.acts, self.parameters, self.summary

    def __copy__(self) -> Law:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Law:
        return self

    def __repr__(self) -> str:
        how = "compiled" if self.is_compiled else "called in the interpreter"
        return f"<Law {self.id}({', '.join(self.parameters)}), acts as {self.acts}, {how}>"


def _received(
    name: tuple[str, str] | None,
    sent: bytes,
    id: str,
    acts: Literal["force", "friction"],
    parameters: dict[str, Parameter],
    summary: str,
) -> Law:
    """The law that another process sent: by its name, else by its function.

    An error here would not reach the user of a cluster, who would wait for a worker for ever.
    """
    found = None if name is None else imported(*name)
    if isinstance(found, Law):
        return found
    here = _LAWS.get(id)
    if here is not None and here._sent == sent and here.parameters == parameters:
        return here
    made = Law(function_of(sent, id), id, acts, parameters, summary)
    made._sent = sent
    return made


def carried(law: Law) -> bytes:
    """A law as bytes: what it does now, whatever module of its name another process has."""
    return pickle.dumps(law._parts(None) if has_cloudpickle() else law)


def received(sent: bytes) -> Law:
    """The law of such bytes."""
    parts = pickle.loads(sent)
    return parts if isinstance(parts, Law) else _received(*parts)


#: A law, or the id of one that was defined.
LawLike = Union[Law, str]


def law(
    id: str,
    *,
    parameters: Mapping[str, Parameter],
    acts: Literal["force", "friction"] = "force",
    summary: str = "",
) -> Callable[[Callable[..., Any]], Law]:
    """Make a law of a function: an effect beside the catalogue.

    It is used like one: in a vehicle by :meth:`Vehicle.with_effect`, as a suspect by
    :func:`diagnose`. The function is called with what the law sees and the parameters by name.
    What the law sees are arrays, for many states at once and their neighbours: derivatives are
    differences. Where a value is to depend on another, use ``np.where``.

    Parameters
    ----------
    id : str
        Its name in files: small letters and digits joined by hyphens. Defined again, new vehicles
        get the new one.
    parameters : mapping of Parameter
        Its parameters by the names that the function takes. One of them is a size.
    acts : {"force", "friction"}
        ``"force"``: it returns a force at the centre of gravity, forward and to the left (N), and,
        where there is one, a moment (N m, counter-clockwise). ``"friction"``: it returns a factor
        on the friction at a point of the contact, or one along and one across the track.
    summary : str
        What reports say of it. Default: the first line of the docstring.

    Returns
    -------
    callable
        A decorator, which makes a :class:`Law` of a function.

    Raises
    ------
    EffectError
        For an id, a parameter or a result that no law can have.
    SettingError
        For a function that does not take the parameters.

    Examples
    --------
    >>> import numpy as np
    >>> import trackdyn as td
    >>> @td.law("water-drag", parameters={"strength": td.Parameter("N s2/m2", 20.0, low=0.0)})
    ... def water_drag(at, strength):
    ...     speed = np.hypot(at.v_forward, at.v_lateral)
    ...     return -strength * speed * at.v_forward, -strength * speed * at.v_lateral
    >>> water_drag.is_compiled
    True
    >>> td.Vehicle("auriga-alpha").with_effect(water_drag, strength=30.0).effects
    ['water-drag:strength=30']
    """
    id = _values.text("id", id)
    if _values.text("acts", acts) not in _ADDS:
        raise _values.refused("acts", acts, "'force' or 'friction'")
    expected = "a td.Parameter for each name, such as {'strength': td.Parameter('N', 20.0)}"
    declared = {
        _values.text("parameters", key): _parameter(key, one, expected)
        for key, one in _values.mapping("parameters", parameters, expected).items()
    }
    summary = _values.text("summary", summary)

    def made(function: Callable[..., Any]) -> Law:
        first = (inspect.getdoc(function) or id).splitlines()[0]
        return Law(function, id, acts, declared, summary or first)

    return made


def _parameter(key: str, one: Any, expected: str) -> Parameter:
    if not isinstance(one, Parameter):
        raise _values.refused(f"parameters {key}", one, expected)
    numbers = {
        name: _values.number(f"parameters {key}.{name}", getattr(one, name))
        for name in ("typical", "low", "high", "neutral")
    }
    texts = {
        name: _values.text(f"parameters {key}.{name}", getattr(one, name))
        for name in ("unit", "role", "meaning")
    }
    made: Any = {**numbers, **texts}
    return Parameter(**made)


def _samples(
    columns: int, parameters: Iterable[Parameter]
) -> list[tuple[NDArray[np.float64], list[float]]]:
    """States and parameters at which steps and function are compared."""
    random = np.random.default_rng(1)
    declared = list(parameters)
    samples = []
    for scale in (0.01, 1.0, 30.0):
        rows = scale * random.standard_normal((columns, 40))
        rows[:, 0] = 0.0
        values = [
            float(np.clip(one.typical * random.uniform(0.3, 2.0), one.low, one.high))
            for one in declared
        ]
        samples.append((rows, values))
    return samples


def ids_of(laws: LawLike | Iterable[LawLike] | None, name: str = "laws") -> list[str]:
    """Ids of laws that were defined."""
    return [law.id for law in several_of(laws, name)]


def several_of(laws: LawLike | Iterable[LawLike] | None, name: str = "laws") -> list[Law]:
    """Laws that were defined."""
    several: Any = laws
    if laws is None:
        several = []
    elif isinstance(laws, (Law, str)):
        several = [laws]
    if not isinstance(several, Iterable):
        raise _values.refused(name, laws, "a law, as @td.law makes it, or several")
    return [_known(one, name) for one in several]


def _known(one: Any, name: str) -> Law:
    if isinstance(one, Law):
        return one
    if isinstance(one, str) and one in _LAWS:
        return _LAWS[one]
    known = ", ".join(sorted(_LAWS)) or "none yet"
    raise _values.refused(name, one, f"a law, as @td.law makes it, or the id of one ({known})")


def of_ids(ids: Iterable[str]) -> tuple[Law, ...]:
    """The laws of these ids, for pickles: reading one defines it in the process that reads."""
    return tuple(_LAWS[one] for one in ids if one in _LAWS)
