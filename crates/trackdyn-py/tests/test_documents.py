"""What is documented holds."""

import doctest
import inspect
import pkgutil
from importlib import import_module
from typing import get_type_hints

import trackdyn as td


def test_examples_of_docstrings_hold():
    attempted = 0
    for module in [td, *(import_module(f"trackdyn.{m.name}") for m in _modules())]:
        result = doctest.testmod(module)
        assert result.failed == 0, module
        attempted += result.attempted
    assert attempted > 8


def test_everything_public_is_documented():
    for name in td.__all__:
        thing = getattr(td, name)
        if name == "__version__":
            continue
        assert inspect.getdoc(thing), name
        members = vars(thing).items() if inspect.isclass(thing) else ()
        for member, value in members:
            is_own = inspect.isfunction(value) or isinstance(value, (property, classmethod))
            if is_own and not member.startswith("_"):
                assert inspect.getdoc(value), f"{name}.{member}"


def test_types_of_every_function_resolve():
    """So tools that read them at run time can: documentation, checkers of arguments."""
    functions = [td.fleet.run, *(getattr(td, name) for name in td.__all__)]
    for function in filter(inspect.isfunction, functions):
        assert get_type_hints(function), function


def _modules():
    return [m for m in pkgutil.iter_modules(td.__path__) if m.name != "_trackdyn"]
