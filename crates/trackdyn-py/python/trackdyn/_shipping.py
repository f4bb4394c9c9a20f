"""Laws on their way to another process: by name, or as the bytes of their function."""

from __future__ import annotations

import hashlib
import importlib
import os
import pickle
import sys
import sysconfig
from collections.abc import Callable, Mapping
from types import CodeType, FunctionType
from typing import Any

import numpy as np

from ._errors import EffectError

#: Modules that another process does not have: what a user types or runs.
_OWN_MODULES = ("__main__", "__mp_main__")


def is_importable(law: Any) -> bool:
    """Whether another process that has the module of a law finds it there by its name."""
    if law.__module__ in _OWN_MODULES:
        return False
    return _attribute(sys.modules.get(law.__module__), law.__qualname__) is law


def imported(module: str, name: str) -> Any:
    """What a module has under a name; None where there is no such module or name."""
    try:
        return _attribute(importlib.import_module(module), name)
    except Exception:  # noqa: BLE001 a module may raise anything
        return None


def _attribute(module: Any, name: str) -> Any:
    found = module
    for part in name.split("."):
        found = getattr(found, part, None)
    return found


def has_cloudpickle() -> bool:
    """Whether functions can be sent as bytes."""
    try:
        import cloudpickle  # noqa: F401
    except ImportError:
        return False
    return True


def bytes_of(function: Callable[..., Any], id: str) -> bytes:
    """The function of a law, as bytes from which another process makes it.

    Raises
    ------
    pickle.PicklingError
        Where it cannot be sent.
    """
    try:
        import cloudpickle
    except ImportError:
        how = "pip install cloudpickle, or define the law in a module that both can import"
        found = f"law {id!r}: another process cannot import {function.__qualname__}"
        raise pickle.PicklingError(f"{found}: expected cloudpickle ({how})") from None
    before = cloudpickle.list_registry_pickle_by_value()
    modules = list(sys.modules.values())
    local = [of for of in modules if _is_local(of) and of.__name__ not in before]
    try:
        # what the function calls of them goes with it: a worker may not have them
        for module in local:
            cloudpickle.register_pickle_by_value(module)
        made: bytes = cloudpickle.dumps(function)
    except Exception as error:  # noqa: BLE001 what a function holds may raise anything
        reason = f"{type(error).__name__}: {error}"
        raise pickle.PicklingError(f"law {id!r}: its function cannot be sent: {reason}") from error
    finally:
        after = cloudpickle.list_registry_pickle_by_value()
        for module in local:
            if module.__name__ in after:
                cloudpickle.unregister_pickle_by_value(module)
    return made


def _is_local(module: Any) -> bool:
    """Whether a module is a file of the user, not one of an installed package."""
    name, place = getattr(module, "__name__", None), getattr(module, "__file__", None)
    if name is None or place is None or sys.modules.get(name) is not module:
        return False
    if name in _OWN_MODULES or name.split(".")[0] == "trackdyn":
        return False
    installed = {sysconfig.get_path(one) for one in ("stdlib", "platstdlib", "purelib", "platlib")}
    return not any(place.startswith(os.path.join(one, "")) for one in installed)


def function_of(sent: bytes, id: str) -> Callable[..., Any]:
    """The function of such bytes."""
    try:
        made: Callable[..., Any] = pickle.loads(sent)
    except ModuleNotFoundError as error:
        found = f"law {id!r}: it was sent from another process, and no module {error.name} is here"
        raise EffectError(f"{found}: expected it installed (pip install {error.name})") from None
    return made


def digest(function: Any, declared: Any) -> str:
    """What tells a function from another: its code, and what it takes from around it."""
    sha = hashlib.sha256(repr(declared).encode())
    _feed(sha, function, set())
    return sha.hexdigest()[:16]


def _feed(sha: Any, value: Any, seen: set[int]) -> None:
    """Feed a value to a hash, the same in every process."""
    sha.update(type(value).__name__.encode())
    if isinstance(value, (bool, int, float, complex, str, bytes, type(None))):
        sha.update(repr(value).encode())
    elif isinstance(value, np.generic):
        sha.update(repr(value.item()).encode())
    elif id(value) in seen:
        return
    else:
        seen.add(id(value))
        _feed_parts(sha, value, seen)


def _feed_parts(sha: Any, value: Any, seen: set[int]) -> None:
    parts: list[Any] = []
    if isinstance(value, np.ndarray):
        parts = [value.shape, value.dtype.str, value.tobytes()]
    elif isinstance(value, (tuple, list)):
        parts = list(value)
    elif isinstance(value, (set, frozenset)):
        parts = sorted(value, key=repr)
    elif isinstance(value, Mapping):
        parts = [one for pair in value.items() for one in pair]
    elif isinstance(value, CodeType):
        parts = [value.co_code, value.co_consts, value.co_names, value.co_varnames]
    elif isinstance(value, FunctionType):
        cells = [_content(cell) for cell in value.__closure__ or ()]
        names = names_of(value.__code__)
        around = {name: value.__globals__[name] for name in names if name in value.__globals__}
        parts = [value.__code__, value.__defaults__, value.__kwdefaults__, cells, around]
    elif hasattr(value, "function") and hasattr(value, "parameters"):  # another law
        parts = [value.function]
    else:
        parts = [getattr(value, "__module__", ""), getattr(value, "__qualname__", "")]
        # what scipy interpolates with, and other objects with numbers in them
        if not isinstance(value, type) and type(value).__module__ != "builtins":
            parts.append(getattr(value, "__dict__", {}))
    for part in parts:
        _feed(sha, part, seen)


def names_of(code: CodeType) -> list[str]:
    """Names that code and the functions in it look up."""
    inner = [name for one in code.co_consts if isinstance(one, CodeType) for name in names_of(one)]
    return sorted({*code.co_names, *inner})


def _content(cell: Any) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # not yet filled
        return None
