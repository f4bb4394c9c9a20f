"""What stands for arrays while a function is traced, and the steps that it notes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, Union

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

#: A number; or the name of a function of numpy and the places of its arguments; or a table:
#: ascending places, coefficients of polynomials between them, and the place of the argument.
Step = Union[float, tuple[str, list[int]], tuple[list[float], list[list[float]], int]]

#: Most steps: what a loop over a thousand numbers takes.
_MAX_STEPS = 2000

#: Functions of bits, which are logical ones for comparisons.
_LOGICAL = {
    "bitwise_and": "logical_and",
    "bitwise_or": "logical_or",
    "bitwise_xor": "logical_xor",
    "invert": "logical_not",
}

#: Functions that answer yes or no.
_QUESTIONS = {"greater", "greater_equal", "less", "less_equal", "equal", "not_equal"}
_QUESTIONS |= {"isfinite", "isnan", "isinf", "signbit"}


class NotTraceableError(Exception):
    """What a function does is no list of steps."""


class Tape:
    """Steps as they are noted. Places count columns first, then parameters, then steps."""

    def __init__(self, columns: int, parameters: int) -> None:
        self.before = columns + parameters
        self.steps: list[Step] = []
        self._known: dict[Any, int] = {}
        #: Answers that the function is given where it asks for a truth, as long as there are some.
        self._given: list[bool] = []
        #: Conditions that it asked for, in order, and the answers that it got.
        self.asked: dict[int, bool] = {}

    def begin(self, given: list[bool]) -> None:
        """A new path through the function, with these answers first."""
        self._given, self.asked = given, {}

    def answer(self, condition: int) -> bool:
        """Whether a condition is true on this path."""
        if condition not in self.asked:
            number = len(self.asked)
            self.asked[condition] = self._given[number] if number < len(self._given) else True
        return self.asked[condition]

    def place(self, value: Any) -> int:
        """The place of a value: of one that is traced, or of a number."""
        if isinstance(value, Traced):
            if value._tape is not self:
                raise NotTraceableError("a value of another call")
            return value._place
        if isinstance(value, np.ndarray) and value.size == 1:
            value = value.item()
        if isinstance(value, (bool, int, float, np.bool_, np.integer, np.floating)):
            return self._noted(float(value), repr(float(value)))
        raise NotTraceableError(f"a value of type {type(value).__name__}")

    def call(self, name: str, *values: Any, is_truth: bool = False) -> Traced:
        """The value of a function of numpy."""
        places = [self.place(one) for one in values]
        return Traced(self, self._noted((name, places), (name, *places)), is_truth)

    def table(self, places: Any, coefficients: Any, x: Any) -> Traced:
        """Polynomials between ascending places: a row of coefficients for each power."""
        at, ends = self.place(x), [float(one) for one in places]
        rows = [[float(one) for one in row] for row in coefficients]
        step = (ends, rows, at)
        return Traced(self, self._noted(step, repr(step)))

    def _noted(self, step: Step, key: Any) -> int:
        """The place of a step; the one that it has where it was noted before."""
        if key not in self._known:
            if len(self.steps) >= _MAX_STEPS:
                raise NotTraceableError("too many steps")
            self.steps.append(step)
            self._known[key] = self.before + len(self.steps) - 1
        return self._known[key]


class Traced(NDArrayOperatorsMixin):
    """Stands for an array of one dimension, or for each of its elements, and notes what is done.

    A condition that the function asks for, as in ``if``, has one answer on each path.
    """

    ndim = 1
    #: One element stands for all.
    shape = (1,)
    size = 1
    __slots__ = ("_is_truth", "_mask", "_place", "_tape")

    def __init__(
        self, tape: Tape, place: int, is_truth: bool = False, mask: int | None = None
    ) -> None:
        self._tape = tape
        self._place = place
        self._is_truth = is_truth
        #: Place of the condition by which its elements were chosen.
        self._mask = mask

    @property
    def dtype(self) -> np.dtype[Any]:
        return np.dtype(bool if self._is_truth else float)

    @property
    def T(self) -> Traced:
        return self

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **keywords: Any) -> Any:
        if any(isinstance(one, Rows) for one in inputs):
            return NotImplemented
        if method == "reduce" and ufunc.nin == 2 and isinstance(inputs[0], (list, tuple)):
            return reduced(ufunc, list(inputs[0]))
        out = keywords.pop("out", None)
        keywords.pop("dtype", None)
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
        is_truth = name in _QUESTIONS or name.startswith("logical_")
        found = self._tape.call(name, *inputs, is_truth=is_truth)
        found._mask = _mask_of(inputs)
        if out is None:
            return found
        (into,) = out
        if not isinstance(into, Traced) or into._is_truth != is_truth or into._mask != found._mask:
            raise NotTraceableError("a result in an array")
        # an array that is changed in place is changed under all its names
        into._place = found._place
        return into

    def __array_function__(
        self, function: Callable[..., Any], types: Any, values: Any, keywords: Any
    ) -> Any:
        from ._traced_numpy import of_numpy

        return of_numpy(function)(*values, **keywords)

    def _refuse(self, *_: Any, **__: Any) -> Any:
        raise NotTraceableError("an array whose numbers are looked at")

    __array__ = __float__ = __int__ = __index__ = __complex__ = _refuse
    __contains__ = _refuse
    __hash__ = None  # type: ignore[assignment]

    def __bool__(self) -> bool:
        return self._tape.answer(self._place)

    def __len__(self) -> int:
        return 1

    def __iter__(self) -> Iterator[Traced]:
        return iter([self.copy()])

    def __getitem__(self, of: Any) -> Traced:
        if isinstance(of, Traced) and of._is_truth and self._mask is None:
            return Traced(self._tape, self._place, self._is_truth, of._place)
        if of is Ellipsis or (isinstance(of, slice) and of == slice(None)):
            return self
        if isinstance(of, int) and of == 0:
            return self.copy()
        raise NotTraceableError("some elements of an array")

    def __setitem__(self, of: Any, value: Any) -> None:
        if isinstance(of, Traced) and of._is_truth:
            if isinstance(value, Traced) and value._mask != of._place:
                raise NotTraceableError("elements that were chosen otherwise")
            self._place = self._tape.call("where", of, value, self)._place
        elif of is Ellipsis or of == 0 or (isinstance(of, slice) and of == slice(None)):
            self._place = self._tape.place(value)
        else:
            raise NotTraceableError("some elements of an array")

    def __round__(self, digits: int | None = None) -> Any:
        from ._traced_numpy import rounded

        return rounded(self, digits or 0)

    def _same(self, *_: Any, **__: Any) -> Traced:
        return Traced(self._tape, self._place, self._is_truth, self._mask)

    copy = astype = ravel = flatten = squeeze = conj = conjugate = _same

    def tolist(self) -> list[Traced]:
        return [self.copy()]

    def item(self) -> Traced:
        return self._same()

    def any(self, *_: Any, **__: Any) -> Traced:
        """Of each state as if it were alone: a law is a function of the state."""
        return self._tape.call("not_equal", self, 0.0, is_truth=True)

    all = any

    def clip(self, *ends: Any, **keywords: Any) -> Any:
        return np.clip(self, *ends, **keywords)

    def round(self, decimals: int = 0) -> Any:
        return self.__round__(decimals)


def _mask_of(values: Sequence[Any]) -> int | None:
    """The condition by which the elements of all traced values were chosen."""
    masks = {one._mask for one in values if isinstance(one, Traced)}
    if len(masks) > 1:
        raise NotTraceableError("elements that were chosen otherwise")
    return masks.pop() if masks else None


class Rows(NDArrayOperatorsMixin):
    """Stands for an array of two dimensions: arrays one below the other, or side by side."""

    ndim = 2
    __slots__ = ("is_turned", "rows")

    def __init__(self, rows: Sequence[Any], is_turned: bool = False) -> None:
        self.rows = list(rows)
        #: Whether arrays are columns.
        self.is_turned = is_turned

    @property
    def T(self) -> Rows:
        return Rows(self.rows, not self.is_turned)

    def transpose(self) -> Rows:
        return self.T

    def copy(self) -> Rows:
        return Rows(self.rows, self.is_turned)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **keywords: Any) -> Any:
        if method == "reduce":
            return _reduce(ufunc, inputs[0], keywords.get("axis", 0))
        if method != "__call__" or keywords:
            raise NotTraceableError(f"{ufunc.__name__} with keywords or a method")
        if ufunc.__name__ == "matmul":
            return product(*inputs)
        count = len(self.rows)
        columns = [_spread(one, count, self.is_turned) for one in inputs]
        return Rows([ufunc(*values) for values in zip(*columns)], self.is_turned)

    def __array_function__(
        self, function: Callable[..., Any], types: Any, values: Any, keywords: Any
    ) -> Any:
        from ._traced_numpy import of_numpy

        return of_numpy(function)(*values, **keywords)

    def _refuse(self, *_: Any, **__: Any) -> Any:
        raise NotTraceableError("an array whose numbers are looked at")

    __array__ = __bool__ = __float__ = __contains__ = _refuse
    __hash__ = None  # type: ignore[assignment]

    def __len__(self) -> int:
        return 1 if self.is_turned else len(self.rows)

    def __iter__(self) -> Iterator[Any]:
        return iter([self.rows] if self.is_turned else self.rows)

    def __getitem__(self, of: Any) -> Any:
        if isinstance(of, tuple) and len(of) == 2:
            of, states = of[::-1] if self.is_turned else of
            if not (states is Ellipsis or (isinstance(states, slice) and states == slice(None))):
                raise NotTraceableError("some elements of an array")
        elif self.is_turned:
            raise NotTraceableError("some elements of an array")
        if isinstance(of, (int, np.integer)):
            return self.rows[of]
        if isinstance(of, slice):
            return Rows(self.rows[of], self.is_turned)
        raise NotTraceableError("some elements of an array")

    def sum(self, axis: Any = None) -> Any:
        return _reduce(np.add, self, axis)

    def prod(self, axis: Any = None) -> Any:
        return _reduce(np.multiply, self, axis)

    def mean(self, axis: Any = None) -> Any:
        return _reduce(np.add, self, axis) / len(self.rows)

    def max(self, axis: Any = None) -> Any:
        return _reduce(np.maximum, self, axis)

    def min(self, axis: Any = None) -> Any:
        return _reduce(np.minimum, self, axis)

    def any(self, axis: Any = None) -> Any:
        return _reduce(np.logical_or, self, axis)

    def all(self, axis: Any = None) -> Any:
        return _reduce(np.logical_and, self, axis)

    def dot(self, other: Any) -> Any:
        return product(self, other)


def _reduce(ufunc: np.ufunc, of: Any, axis: Any) -> Any:
    axes = (1, -1) if of.is_turned else (0, -2)
    if axis not in axes:
        raise NotTraceableError(f"{ufunc.__name__} of all states")
    return reduced(ufunc, of.rows)


def reduced(ufunc: np.ufunc, values: Sequence[Any]) -> Any:
    """A function of two arguments over several, from the first to the last."""
    found = values[0]
    for value in values[1:]:
        found = ufunc(found, value)
    return found


def _spread(value: Any, count: int, is_turned: bool) -> list[Any]:
    """What a value is in each of the rows."""
    if isinstance(value, Rows):
        if len(value.rows) != count or value.is_turned != is_turned:
            raise NotTraceableError("arrays of other shapes")
        return value.rows
    if isinstance(value, np.ndarray) and value.size > 1:
        shapes = [(count,), (1, count)] if is_turned else [(count, 1)]
        if value.shape not in shapes:
            raise NotTraceableError("an array of constants")
        return list(value.ravel())
    if isinstance(value, Traced) and is_turned:
        raise NotTraceableError("arrays of other shapes")
    return [value] * count


def product(one: Any, other: Any) -> Any:
    """A product of matrices, or of a matrix and a vector, one of them of constants."""

    def sums(matrix: Any, rows: Sequence[Any]) -> list[Any]:
        table = np.atleast_2d(matrix)
        if table.shape[1] != len(rows):
            raise NotTraceableError("arrays of other shapes")
        terms = [[float(a) * b for a, b in zip(line, rows)] for line in table.tolist()]
        return [reduced(np.add, line) for line in terms]

    if isinstance(other, Rows) and not other.is_turned and not isinstance(one, (Rows, Traced)):
        found = sums(one, other.rows)
        return found[0] if np.ndim(one) == 1 else Rows(found)
    if isinstance(one, Rows) and one.is_turned and not isinstance(other, (Rows, Traced)):
        found = sums(np.asarray(other).T, one.rows)
        return found[0] if np.ndim(other) == 1 else Rows(found, True)
    if isinstance(one, (int, float)) or isinstance(other, (int, float)):
        return one * other
    raise NotTraceableError("a product over all states")
