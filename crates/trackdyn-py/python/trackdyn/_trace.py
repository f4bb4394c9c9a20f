"""What a function does with its arrays, as steps that need no interpreter.

A function of a law is called once with objects that stand for arrays and note what is done with
them. What cannot be noted so, such as a loop over elements, leaves the function to the interpreter.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Union

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from . import _trackdyn

#: A number, or the name of a function of numpy and the places of its arguments.
Step = Union[float, tuple[str, list[int]]]

#: Steps, and the places of the results.
Taped = tuple[list[Step], list[int]]

#: Most steps: each point of a table takes several.
_MAX_STEPS = 2000

#: Results by steps and by the function may differ by so much of the largest one.
_MAX_DIFFERENCE = 1e-12

#: Functions of bits, which are logical ones for comparisons.
_LOGICAL = {
    "bitwise_and": "logical_and",
    "bitwise_or": "logical_or",
    "bitwise_xor": "logical_xor",
    "invert": "logical_not",
}


class NotTraceableError(Exception):
    """What a function does is no list of steps."""


class Tape:
    """Steps as they are noted. Places count columns first, then parameters, then steps."""

    def __init__(self, columns: int, parameters: int) -> None:
        self.before = columns + parameters
        self.steps: list[Step] = []
        self._numbers: dict[float, int] = {}

    def place(self, value: Any) -> int:
        """The place of a value: of one that is traced, or of a number."""
        if isinstance(value, Traced):
            if value._tape is not self:
                raise NotTraceableError("a value of another call")
            return value._place
        if isinstance(value, (bool, int, float, np.bool_, np.integer, np.floating)):
            number = float(value)
            if number not in self._numbers or number == 0.0 or number != number:
                self._numbers[number] = self._noted(number)
            return self._numbers[number]
        raise NotTraceableError(f"a value of type {type(value).__name__}")

    def call(self, name: str, *values: Any, is_truth: bool = False) -> Traced:
        """The value of a function of numpy."""
        return Traced(self, self._noted((name, [self.place(one) for one in values])), is_truth)

    def _noted(self, step: Step) -> int:
        if len(self.steps) >= _MAX_STEPS:
            raise NotTraceableError("too many steps")
        self.steps.append(step)
        return self.before + len(self.steps) - 1


_COMPARISONS = {"greater", "greater_equal", "less", "less_equal", "equal", "not_equal"}


class Traced(NDArrayOperatorsMixin):
    """Stands for an array of one dimension, and notes what is done with it."""

    ndim = 1
    __slots__ = ("_is_truth", "_place", "_tape")

    def __init__(self, tape: Tape, place: int, is_truth: bool = False) -> None:
        self._tape = tape
        self._place = place
        self._is_truth = is_truth

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **keywords: Any) -> Any:
        out = keywords.pop("out", None)
        if method != "__call__" or keywords or ufunc.nout != 1:
            raise NotTraceableError(f"{ufunc.__name__} with keywords or a method")
        truths = [getattr(one, "_is_truth", isinstance(one, (bool, np.bool_))) for one in inputs]
        name = ufunc.__name__
        if name in _LOGICAL:
            if not all(truths):
                raise NotTraceableError(f"{name} of numbers")
            name = _LOGICAL[name]
        elif name in ("negative", "subtract", "add") and all(truths):
            raise NotTraceableError(f"{name} of truths")
        is_truth = name in _COMPARISONS or name.startswith("logical_")
        found = self._tape.call(name, *inputs, is_truth=is_truth)
        if out is None:
            return found
        (into,) = out
        if not isinstance(into, Traced) or into._is_truth != is_truth:
            raise NotTraceableError("a result in an array")
        # an array that is changed in place is changed under all its names
        into._place = found._place
        return into

    def __array_function__(
        self, function: Callable[..., Any], types: Any, values: Any, keywords: Any
    ) -> Any:
        known = _FUNCTIONS.get(function.__name__)
        if known is None:
            raise NotTraceableError(f"np.{function.__name__}")
        return known(self._tape, *values, **keywords)

    def _refuse(self, *_: Any, **__: Any) -> Any:
        raise NotTraceableError("an array whose numbers are looked at")

    __array__ = __bool__ = __float__ = __int__ = __index__ = __complex__ = _refuse
    __len__ = __iter__ = __getitem__ = __setitem__ = __contains__ = _refuse
    __hash__ = None  # type: ignore[assignment]

    def copy(self) -> Traced:
        return Traced(self._tape, self._place, self._is_truth)

    def clip(self, low: Any = None, high: Any = None) -> Traced:
        return _clip(self._tape, self, low, high)


def _where(tape: Tape, condition: Any, yes: Any, no: Any) -> Traced:
    return tape.call("where", condition, yes, no)


def _clip(tape: Tape, value: Any, a_min: Any = None, a_max: Any = None) -> Traced:
    if a_min is not None:
        value = tape.call("maximum", value, a_min)
    return value if a_max is None else tape.call("minimum", value, a_max)


def _like(number: float) -> Callable[..., Traced]:
    return lambda tape, _: Traced(tape, tape.place(number))


def _full(tape: Tape, _: Any, fill_value: Any) -> Traced:
    return Traced(tape, tape.place(fill_value))


def _interp(tape: Tape, x: Any, xp: Any, fp: Any) -> Traced:
    """A table with straight lines between its points."""
    places, values = np.asarray(xp, dtype=float), np.asarray(fp, dtype=float)
    if places.ndim != 1 or places.shape != values.shape or np.any(np.diff(places) <= 0.0):
        raise NotTraceableError("a table that does not ascend")
    found = Traced(tape, tape.place(float(values[-1])))
    for k in range(len(places) - 2, -1, -1):
        slope = float((values[k + 1] - values[k]) / (places[k + 1] - places[k]))
        line = (x - float(places[k])) * slope + float(values[k])
        found = tape.call("where", x < float(places[k + 1]), line, found)
    return tape.call("where", x <= float(places[0]), float(values[0]), found)


def _select(tape: Tape, conditions: Any, choices: Any, default: Any = 0.0) -> Traced:
    found = Traced(tape, tape.place(default))
    for condition, choice in zip(reversed(conditions), reversed(choices)):
        found = tape.call("where", condition, choice, found)
    return found


def _polyval(tape: Tape, p: Any, x: Any) -> Traced:
    found = Traced(tape, tape.place(0.0))
    for coefficient in p:
        found = found * x + (coefficient if isinstance(coefficient, Traced) else float(coefficient))
    return found


def _real(tape: Tape, value: Any) -> Traced:
    return Traced(tape, tape.place(value))


_FUNCTIONS: dict[str, Callable[..., Traced]] = {
    "where": _where,
    "select": _select,
    "polyval": _polyval,
    "clip": _clip,
    "zeros_like": _like(0.0),
    "ones_like": _like(1.0),
    "full_like": _full,
    "interp": _interp,
    "real": _real,
    "copy": _real,
}


def traced(
    results: Callable[[Sequence[Any], Sequence[Any]], Sequence[Any]],
    called: Callable[[Any, Sequence[float]], Any],
    counts: tuple[int, int, int],
    samples: Sequence[tuple[Any, Sequence[float]]],
) -> Taped | None:
    """The steps of a function; None where they are not known, or give another result.

    Parameters
    ----------
    results : callable
        Gives what a law adds for what stands for columns and parameters.
    called : callable
        Gives what it adds for an array of columns and numbers.
    counts : three numbers
        Of columns, parameters and results.
    samples : sequence
        Columns and parameters at which both must agree.
    """
    columns, parameters, _ = counts
    tape = Tape(columns, parameters)
    stand_ins = [Traced(tape, place) for place in range(columns + parameters)]
    try:
        found = results(stand_ins[:columns], stand_ins[columns:])
        places = [tape.place(one) for one in found]
        for rows, values in samples:
            taped = _trackdyn.taped(counts, tape.steps, places, rows, list(values))
            with np.errstate(all="ignore"):
                expected = called(rows, values)
            largest = np.max(np.abs(expected), axis=1, keepdims=True)
            if not np.all(np.abs(taped - expected) <= _MAX_DIFFERENCE * largest):
                return None
    except Exception:  # noqa: BLE001 what stands for arrays may raise anything in any function
        return None
    return tape.steps, places
