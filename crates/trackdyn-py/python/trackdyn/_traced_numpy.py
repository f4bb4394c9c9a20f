"""Functions of numpy, math and scipy on what stands for arrays."""

from __future__ import annotations

import math
import sys
import threading
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ._tape import NotTraceableError, Rows, Tape, Traced, product, reduced


def tape_in(values: Any, depth: int = 4) -> Tape | None:
    """The tape of what is traced among values; None where nothing is."""
    if isinstance(values, Traced):
        return values._tape
    several = values.rows if isinstance(values, Rows) else values
    if depth and isinstance(several, (list, tuple)):
        found = (tape_in(one, depth - 1) for one in several)
        return next((one for one in found if one is not None), None)
    return None


def _tape(*values: Any) -> Tape:
    tape = tape_in(values)
    if tape is None:
        raise NotTraceableError("nothing that is traced")
    return tape


def of_numpy(function: Callable[..., Any]) -> Callable[..., Any]:
    """What stands for a function of numpy."""
    name = getattr(function, "__name__", "")
    module = getattr(function, "__module__", "") or ""
    known = _LINALG.get(name) if "linalg" in module else _FUNCTIONS.get(name)
    if known is None:
        raise NotTraceableError(f"np.{name}")
    return known


def _array(object: Any, *_: Any, **__: Any) -> Any:
    """An array of what is traced: of arrays, or of elements."""
    if isinstance(object, (Traced, Rows)):
        return object.copy()
    if not isinstance(object, (list, tuple)):
        raise NotTraceableError("an array of something else")
    if len(object) == 1 and isinstance(object[0], Traced):
        # a list of all elements, which one stands for
        return object[0].copy()
    if all(isinstance(one, (list, tuple)) and len(one) == 1 for one in object):
        return Rows([one[0] for one in object])
    if len(object) == 1 and isinstance(object[0], (list, tuple)):
        return Rows(list(object[0]), True)
    return Rows([_array([one]) if isinstance(one, list) else one for one in object])


def _stack(arrays: Any, axis: int = 0, **_: Any) -> Any:
    rows = list(arrays.rows if isinstance(arrays, Rows) else arrays)
    if axis not in (0, 1, -1) or not all(isinstance(one, Traced) for one in rows):
        raise NotTraceableError("np.stack of something else")
    return Rows(rows, axis != 0)


def _vstack(arrays: Any, **_: Any) -> Any:
    rows: list[Any] = []
    for one in arrays:
        rows += one.rows if isinstance(one, Rows) and not one.is_turned else [one]
    if not all(isinstance(one, Traced) for one in rows):
        raise NotTraceableError("np.vstack of something else")
    return Rows(rows)


def _column_stack(arrays: Any) -> Any:
    return _stack(arrays, 1)


def _where(condition: Any, *choices: Any) -> Any:
    if len(choices) != 2:
        raise NotTraceableError("np.where without values")
    values = [condition, *choices]
    rows = next((one for one in values if isinstance(one, Rows)), None)
    if rows is not None:
        return _by_rows(_where, rows, values)
    return _tape(*values).call("where", *values)


def _by_rows(function: Callable[..., Any], rows: Rows, values: Sequence[Any]) -> Rows:
    from ._tape import _spread

    columns = [_spread(one, len(rows.rows), rows.is_turned) for one in values]
    return Rows([function(*each) for each in zip(*columns)], rows.is_turned)


def _clip(a: Any, a_min: Any = None, a_max: Any = None, **keywords: Any) -> Any:
    low, high = keywords.get("min", a_min), keywords.get("max", a_max)
    if low is not None:
        a = np.maximum(a, low)
    return a if high is None else np.minimum(a, high)


def _like(number: float) -> Callable[..., Any]:
    def made(like: Any, *_: Any, **__: Any) -> Any:
        if isinstance(like, Rows):
            return Rows([made(row) for row in like.rows], like.is_turned)
        tape = _tape(like)
        return Traced(tape, tape.place(number))

    return made


def _full_like(like: Any, fill_value: Any, *_: Any, **__: Any) -> Any:
    tape = _tape(like, fill_value)
    return Traced(tape, tape.place(fill_value))


def _interp(x: Any, xp: Any, fp: Any, left: Any = None, right: Any = None, **_: Any) -> Any:
    """A table with straight lines between its points."""
    places, values = np.asarray(xp, dtype=float), np.asarray(fp, dtype=float)
    if places.ndim != 1 or places.shape != values.shape or np.any(np.diff(places) <= 0.0):
        raise NotTraceableError("a table that does not ascend")
    tape = _tape(x)
    if len(places) == 1:
        inside: Any = Traced(tape, tape.place(float(values[0])))
    else:
        slopes = np.diff(values) / np.diff(places)
        within = np.minimum(np.maximum(x, places[0]), places[-1])
        inside = tape.table(places, [slopes, values[:-1]], within)
    if left is not None:
        inside = tape.call("where", x < places[0], left, inside)
    return inside if right is None else tape.call("where", x > places[-1], right, inside)


def _select(condlist: Any, choicelist: Any, default: Any = 0.0) -> Any:
    tape = _tape(condlist, choicelist, default)
    found = Traced(tape, tape.place(default))
    for condition, choice in zip(reversed(condlist), reversed(choicelist)):
        found = tape.call("where", condition, choice, found)
    return found


def _piecewise(x: Any, condlist: Any, funclist: Any, *args: Any, **keywords: Any) -> Any:
    conditions = list(condlist) if isinstance(condlist, (list, tuple)) else [condlist]
    choices = list(funclist)
    tape = _tape(x, conditions)
    values = [one(x, *args, **keywords) if callable(one) else one for one in choices]
    default = values.pop() if len(values) == len(conditions) + 1 else 0.0
    found = Traced(tape, tape.place(default))
    # where several hold, the last counts
    for condition, value in zip(conditions, values):
        found = tape.call("where", condition, value, found)
    return found


def _polyval(p: Any, x: Any) -> Any:
    found: Any = 0.0
    for coefficient in p:
        found = found * x + (coefficient if isinstance(coefficient, Traced) else float(coefficient))
    return found


def rounded(a: Any, decimals: int = 0, **_: Any) -> Any:
    """Rounded to so many digits, halves to even ones, as numpy does it."""
    factor = 10.0 ** abs(decimals)
    if decimals >= 0:
        return np.rint(a * factor) / factor if decimals else np.rint(a)
    return np.rint(a / factor) * factor


def _nan_to_num(
    x: Any, copy: bool = True, nan: float = 0.0, posinf: Any = None, neginf: Any = None
) -> Any:
    largest = float(np.finfo(float).max)
    high, low = largest if posinf is None else posinf, -largest if neginf is None else neginf
    found = _where(np.isnan(x), nan, x)
    return _where(found == np.inf, high, _where(found == -np.inf, low, found))


def _method(name: str) -> Callable[..., Any]:
    def called(a: Any, axis: Any = None, *_: Any, **__: Any) -> Any:
        if isinstance(a, (list, tuple)):
            a = _array(a)
        if isinstance(a, Traced):
            if name not in ("any", "all"):
                raise NotTraceableError(f"np.{name} of all states")
            return a.any()
        return getattr(a, name)(axis)

    return called


def _same(a: Any, *_: Any, **__: Any) -> Any:
    return a.copy() if isinstance(a, (Traced, Rows)) else _array(a)


def _norm(x: Any, ord: Any = None, axis: Any = None, keepdims: bool = False) -> Any:
    rows = _array(x) if isinstance(x, (list, tuple)) else x
    is_over_rows = isinstance(rows, Rows) and axis in ((1, -1) if rows.is_turned else (0, -2))
    if not is_over_rows or keepdims:
        raise NotTraceableError("a norm over all states")
    sizes = [abs(one) for one in rows.rows]
    if ord in (None, 2):
        return np.sqrt(reduced(np.add, [size * size for size in sizes]))
    if ord == 1:
        return reduced(np.add, sizes)
    if ord == np.inf:
        return reduced(np.maximum, sizes)
    raise NotTraceableError("another norm")


def _filled(number: float) -> Callable[..., Any]:
    """Zeros or ones of a shape: traced where the shape is that of all states."""
    real = np.zeros if number == 0.0 else np.ones

    def made(shape: Any = 1, *rest: Any, **keywords: Any) -> Any:
        tape: Tape | None = getattr(_current, "tape", None)
        if tape is None:
            return real(shape, *rest, **keywords)
        if shape in (1, (1,), [1]):
            return Traced(tape, tape.place(number))
        if isinstance(shape, (tuple, list)) and len(shape) == 2 and shape[1] == 1:
            return Rows([made(1) for _ in range(shape[0])])
        return real(shape, *rest, **keywords)

    return made


#: The tape of the function that this thread traces, for what takes nothing that is traced.
_current = threading.local()


def set_current(tape: Tape | None) -> None:
    """Begin or end tracing with a tape."""
    _current.tape = tape


def _vectorize(pyfunc: Callable[..., Any] | None = None, *_: Any, **__: Any) -> Any:
    """A function of numbers is one of elements."""
    return pyfunc if pyfunc is not None else (lambda function: function)


_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "where": _where,
    "select": _select,
    "piecewise": _piecewise,
    "polyval": _polyval,
    "clip": _clip,
    "zeros_like": _like(0.0),
    "ones_like": _like(1.0),
    "empty_like": _like(0.0),
    "full_like": _full_like,
    "interp": _interp,
    "around": rounded,
    "round": rounded,
    "nan_to_num": _nan_to_num,
    "stack": _stack,
    "vstack": _vstack,
    "row_stack": _vstack,
    "column_stack": _column_stack,
    "dot": product,
    "sum": _method("sum"),
    "prod": _method("prod"),
    "mean": _method("mean"),
    "max": _method("max"),
    "amax": _method("max"),
    "min": _method("min"),
    "amin": _method("min"),
    "any": _method("any"),
    "all": _method("all"),
    "transpose": lambda a, *_: a.T,
    "ndim": lambda a: a.ndim,
    "shape": lambda a: a.shape,
    **dict.fromkeys(("real", "copy", "squeeze", "ravel", "atleast_1d", "real_if_close"), _same),
}

_LINALG: dict[str, Callable[..., Any]] = {"norm": _norm}

#: What cannot ask what it is given whether it is traced.
_MADE = {
    "array": _array,
    "asarray": _array,
    "asanyarray": _array,
    "ascontiguousarray": _array,
    "asfarray": _array,
    "float64": _same,
    "bool_": _same,
}


def either(real: Callable[..., Any], traced: Callable[..., Any]) -> Callable[..., Any]:
    """A function for what is traced, and the real one for all else."""

    def called(*values: Any, **keywords: Any) -> Any:
        given = [*values, *keywords.values()]
        return (real if tape_in(given) is None else traced)(*values, **keywords)

    return called


_MATH = {
    **{name: name for name in "sqrt exp expm1 log2 log10 log1p sin cos tan sinh cosh tanh".split()},
    **{name: name for name in "hypot copysign floor ceil trunc fmod isnan isfinite isinf".split()},
    **{f"a{name}": f"arc{name}" for name in "sin cos tan sinh cosh tanh tan2".split()},
    **{"fabs": "abs", "pow": "power", "degrees": "degrees", "radians": "radians", "cbrt": "cbrt"},
}


class _Reducible:
    """A function of two numbers that is asked for that of several, too."""

    def __init__(self, real: np.ufunc) -> None:
        self._real = real
        self.reduce = either(real.reduce, self._reduced)

    def _reduced(self, array: Any, axis: Any = 0, **_: Any) -> Any:
        if isinstance(array, Rows):
            return self._real.reduce(array, axis=axis)
        if axis != 0:
            raise NotTraceableError(f"np.{self._real.__name__}.reduce of all states")
        return reduced(self._real, array)

    def __call__(self, *values: Any, **keywords: Any) -> Any:
        return self._real(*values, **keywords)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._real, name)


_REDUCIBLE = "add", "multiply", "maximum", "minimum", "logical_and", "logical_or"


def _log(x: Any, base: Any = None) -> Any:
    return np.log(x) if base is None else np.log(x) / math.log(base)


def _special(name: str) -> Callable[..., Any]:
    return lambda x: _tape(x).call(name, x)


def module_functions(module: Any) -> dict[str, Any]:
    """What stands for functions of a module, by name."""
    if module is np:
        made = _either_of(np, _MADE)
        of_shape = {"zeros": _filled(0.0), "ones": _filled(1.0), "empty": _filled(0.0)}
        # those that numpy asks of lists of what is traced, too
        asked = _either_of(np, _FUNCTIONS)
        several = {name: _Reducible(getattr(np, name)) for name in _REDUCIBLE}
        return {**asked, **made, **of_shape, **several, "vectorize": _vectorize}
    if module is np.linalg:
        return _either_of(np.linalg, _LINALG)
    if module is math:
        known = {name: getattr(np, of) for name, of in _MATH.items()}
        special = {"erf": "erf", "erfc": "erfc", "gamma": "gamma", "lgamma": "gammaln"}
        known |= {name: _special(of) for name, of in special.items()}
        return _either_of(math, {**known, "log": _log})
    return {}


def _either_of(module: Any, known: dict[str, Callable[..., Any]]) -> dict[str, Callable[..., Any]]:
    there = {name: of for name, of in known.items() if hasattr(module, name)}
    return {name: either(getattr(module, name), of) for name, of in there.items()}


def spline_of(value: Any) -> Callable[..., Any] | None:
    """What stands for a spline of scipy; None for anything else."""
    interpolate: Any = sys.modules.get("scipy.interpolate")
    if interpolate is None:
        return None
    pieces = None
    if isinstance(value, interpolate.PPoly):
        pieces = value
    elif isinstance(value, interpolate.BSpline):
        pieces = interpolate.PPoly.from_spline(value)
    elif isinstance(value, interpolate.UnivariateSpline) and value._data[-1] != 2:
        pieces = interpolate.PPoly.from_spline(value._eval_args)
    # a spline that goes round, or that ends, is none of these
    if pieces is None or pieces.c.ndim != 2 or pieces.extrapolate not in (True, 1):
        return None
    keep = np.flatnonzero(np.diff(pieces.x) > 0.0)
    places = np.append(pieces.x[keep], pieces.x[-1])
    coefficients = pieces.c[:, keep]

    def called(x: Any, nu: int = 0, extrapolate: Any = None, **__: Any) -> Any:
        if nu or extrapolate not in (None, True):
            raise NotTraceableError("a derivative of a spline")
        return _tape(x).table(places, coefficients, x)

    return either(value, called)
