"""Values of keywords: what is of another kind is refused by name, value and what was expected."""

from __future__ import annotations

import operator
import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import SettingError

_T = TypeVar("_T")

#: Most characters of a value in a message.
_MAX_SHOWN = 60


def refused(name: str, value: object, expected: str) -> SettingError:
    """The error of a value that a keyword cannot have."""
    shown = repr(value)
    if len(shown) > _MAX_SHOWN or "\n" in shown:
        shown = f"of type {type(value).__name__}"
    return SettingError(f"{name} {shown}: expected {expected}", name)


def maybe(check: Callable[[str, Any], _T], name: str, value: Any) -> _T | None:
    """A value that may be left open."""
    return None if value is None else check(name, value)


def number(name: str, value: Any) -> float:
    """A real number. The library says which numbers it takes."""
    if not isinstance(value, (bool, np.bool_, str, bytes, bytearray)):
        try:
            return float(value)
        except (TypeError, ValueError, OverflowError):
            pass
    raise refused(name, value, "a number")


def is_number(value: Any) -> bool:
    """Whether a value is a number."""
    return isinstance(value, (int, float, np.integer, np.floating))


def finite(name: str, value: Any) -> float:
    """A number that is finite."""
    found = number(name, value)
    if not np.isfinite(found):
        raise refused(name, value, "a finite number")
    return found


def whole(name: str, value: Any) -> int:
    """A whole number, also as a float without a fraction."""
    if not isinstance(value, (bool, np.bool_)):
        try:
            is_float = isinstance(value, (float, np.floating))
            found = int(value) if is_float else operator.index(value)
            if found == value:
                return found
        except (TypeError, ValueError, OverflowError):
            pass
    raise refused(name, value, "a whole number")


def count(name: str, value: Any) -> int:
    """A whole number from 0 on that the extension can take."""
    found = whole(name, value)
    if not 0 <= found < 2**63:
        raise refused(name, value, "a whole number from 0 on")
    return found


def flag(name: str, value: Any) -> bool:
    """True or False."""
    if isinstance(value, (bool, np.bool_, int)) and value in (0, 1):
        return bool(value)
    raise refused(name, value, "True or False")


def text(name: str, value: Any) -> str:
    """A text."""
    if isinstance(value, str):
        return value
    raise refused(name, value, "a text")


def path(name: str, value: Any) -> str:
    """A path as a text."""
    if isinstance(value, (str, os.PathLike)):
        found = os.fspath(value)
        if isinstance(found, str):
            return found
    raise refused(name, value, "a path, as a text or a pathlib.Path")


def texts(name: str, value: Any) -> list[str]:
    """One text, several or none."""
    if value is None:
        return []
    if isinstance(value, str):
        return [value]
    return [text(name, one) for one in _listed(name, value, "a text, or a list of texts")]


def numbers(name: str, value: Any, expected: str, size: int | None = None) -> list[float]:
    """Numbers in an order, so many of them."""
    found = _listed(name, value, expected)
    if size is not None and len(found) != size:
        raise refused(name, value, expected)
    return [number(name, one) for one in found]


def mapping(name: str, value: Any, expected: str) -> Mapping[Any, Any]:
    """A mapping."""
    if isinstance(value, Mapping):
        return value
    raise refused(name, value, expected)


def array(name: str, value: Any, expected: str = "numbers") -> NDArray[np.float64]:
    """An array of floats."""
    found = floats(value)
    if found is None:
        raise refused(name, value, expected)
    return found


def floats(value: Any) -> NDArray[np.float64] | None:
    """An array of floats; None for what is none."""
    if value is None or isinstance(value, (str, bytes, Mapping)):
        return None
    try:
        return np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        return None


def pair(
    names: tuple[str, str], one: ArrayLike, other: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64], tuple[int, ...]]:
    """Two arrays of one shape, flat, and that shape."""
    given = array(names[0], one), array(names[1], other)
    try:
        first, second = np.broadcast_arrays(*given)
    except ValueError:
        shapes = " and ".join(f"{name} of shape {of.shape}" for name, of in zip(names, given))
        raise SettingError(f"{shapes}: expected shapes that broadcast", names[1]) from None
    return np.ravel(first), np.ravel(second), first.shape


def is_single(value: Any) -> bool:
    """Whether a value is one, not several."""
    if isinstance(value, np.ndarray):
        return value.ndim == 0
    return isinstance(value, (str, bytes)) or not isinstance(value, Iterable)


def _listed(name: str, value: Any, expected: str) -> list[Any]:
    """What stands in an order: no text, set or mapping, whose order means something else."""
    if isinstance(value, Iterable) and not isinstance(value, (str, bytes, Mapping, set, frozenset)):
        try:
            return list(value)
        except TypeError:  # an array without dimensions
            pass
    raise refused(name, value, expected)
