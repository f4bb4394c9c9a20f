"""What a function does with its arrays, as steps that need no interpreter.

A function of a law is called with objects that stand for arrays and note what is done with them.
Where it asks for a truth, as in ``if``, it is called once for each answer, and steps choose between
the paths. Its names for numpy, math and scipy stand for functions that know these objects. What
cannot be noted so leaves the function to the interpreter.

What is noted is compared with what the function gives for arrays. A function that gives something
else for a state in the company of others is thus found out, and left to the interpreter.
"""

from __future__ import annotations

import math
import types
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from . import _trackdyn
from ._shipping import names_of
from ._tape import NotTraceableError, Step, Tape, Traced
from ._traced_numpy import module_functions, set_current, spline_of

#: Steps, and the places of the results.
Taped = tuple[list[Step], list[int]]

#: Most paths through a function.
_MAX_PATHS = 64

#: Results by steps and by the function may differ by so much of the largest one.
_MAX_DIFFERENCE = 1e-12

#: Modules whose functions know what is traced, or are not to be looked into.
_FOREIGN = ("numpy", "scipy", "math", "builtins", "trackdyn")


class _Module:
    """Stands for a module of numpy, or for math."""

    def __init__(self, real: types.ModuleType) -> None:
        self._real = real
        self._functions = module_functions(real)

    def __getattr__(self, name: str) -> Any:
        if name in self._functions:
            return self._functions[name]
        found = getattr(self._real, name)
        return _Module(found) if isinstance(found, types.ModuleType) else found


def _number(real: Callable[..., Any]) -> Callable[..., Any]:
    """A conversion to a number, which leaves what is traced as it is."""
    return lambda value=0.0, *rest: value if isinstance(value, Traced) else real(value, *rest)


#: Functions of the interpreter that take what is traced for numbers.
_BUILTINS = {"float": _number(float)}


def stand_in(function: Any) -> Any:
    """The function with names for numpy and math that know what is traced."""
    return _stand_in(function, {})


def _stand_in(value: Any, made: dict[int, Any]) -> Any:
    if id(value) in made:
        return made[id(value)]
    found = value
    if isinstance(value, types.ModuleType):
        if value is math or value.__name__.split(".")[0] == "numpy":
            found = _Module(value)
    elif isinstance(value, types.FunctionType):
        module = (value.__module__ or "").split(".")[0]
        found = _of_module(value) if module in _FOREIGN else _function(value, made)
    elif isinstance(value, np.vectorize):
        found = _stand_in(value.pyfunc, made)
    elif hasattr(value, "function") and hasattr(value, "parameters"):  # another law
        found = _stand_in(value.function, made)
    elif hasattr(value, "py_func"):  # compiled by numba
        found = _stand_in(value.py_func, made)
    elif isinstance(value, types.BuiltinFunctionType):
        found = _of_module(value)
    else:
        found = spline_of(value) or value
    made[id(value)] = found
    return found


def _of_module(function: Any) -> Any:
    """A function that was imported by its name alone."""
    name = getattr(function, "__name__", "")
    for module in (math, np, np.linalg):
        if getattr(module, name, None) is function:
            return module_functions(module).get(name, function)
    return function


def _function(function: types.FunctionType, made: dict[int, Any]) -> Any:
    around = function.__globals__
    names: dict[str, Any] = {**_BUILTINS, "__builtins__": around.get("__builtins__", __builtins__)}
    code = function.__code__
    cells = [types.CellType() for _ in code.co_freevars]
    found = types.FunctionType(code, names, function.__name__, None, tuple(cells))
    # functions may name each other
    made[id(function)] = found
    for cell, real in zip(cells, function.__closure__ or ()):
        try:
            cell.cell_contents = _stand_in(real.cell_contents, made)
        except ValueError:  # not yet filled
            pass
    for name in names_of(code):
        if name in around:
            names[name] = _stand_in(around[name], made)
    defaults = function.__defaults__
    found.__defaults__ = defaults and tuple(_stand_in(one, made) for one in defaults)
    found.__kwdefaults__ = function.__kwdefaults__
    return found


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

    def path() -> list[int]:
        stand_ins = [Traced(tape, place) for place in range(columns + parameters)]
        return [tape.place(one) for one in results(stand_ins[:columns], stand_ins[columns:])]

    set_current(tape)
    try:
        places = _all_paths(tape, path)
        for rows, values in samples:
            taped = _trackdyn.taped(counts, tape.steps, places, rows, list(values))
            set_current(None)
            with np.errstate(all="ignore"):
                expected = called(rows, values)
            largest = np.max(np.abs(expected), axis=1, keepdims=True)
            is_near = np.abs(taped - expected) <= _MAX_DIFFERENCE * largest
            if not np.all(is_near | (np.isnan(taped) & np.isnan(expected))):
                return None
    except Exception:  # noqa: BLE001 what stands for arrays may raise anything in any function
        return None
    finally:
        set_current(None)
    return tape.steps, places


def _all_paths(tape: Tape, path: Callable[[], list[int]]) -> list[int]:
    """Places of the results, chosen between all paths through a function."""
    paths = 0

    def along(given: list[bool]) -> list[int]:
        nonlocal paths
        paths += 1
        if paths > _MAX_PATHS:
            raise NotTraceableError("too many paths")
        tape.begin(given)
        places = path()
        asked = list(tape.asked.items())
        for number in range(len(asked) - 1, len(given) - 1, -1):
            condition = Traced(tape, asked[number][0])
            otherwise = along([answer for _, answer in asked[:number]] + [False])
            pairs = zip(places, otherwise)
            chosen = (
                yes if yes == no else _where(tape, condition, yes, no) for yes, no in pairs
            )
            places = list(chosen)
        return places

    return along([])


def _where(tape: Tape, condition: Traced, yes: int, no: int) -> int:
    return tape.call("where", condition, Traced(tape, yes), Traced(tape, no))._place
