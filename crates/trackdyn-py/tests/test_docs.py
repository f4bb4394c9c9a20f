"""Docstrings say what functions take and return, in the form of numpydoc."""

import inspect
import typing

import pytest

import trackdyn as td

SPACES = {"td": td, "td.fleet": td.fleet}


def public():
    """Functions and methods of the package that take something, by name."""
    for space, module in SPACES.items():
        for name in module.__all__:
            of = getattr(module, name)
            if inspect.isfunction(of):
                yield f"{space}.{name}", of
            elif inspect.isclass(of) and not issubclass(of, (Exception, Warning)):
                for method, function in vars(of).items():
                    function = getattr(function, "__func__", function)
                    is_own = inspect.isfunction(function) and not method.startswith("_")
                    if is_own and function.__module__.startswith("trackdyn"):
                        yield f"{space}.{name}.{method}", function


PUBLIC = dict(public())


def test_there_are_functions():
    assert {"td.diagnose", "td.IcrMap.write", "td.fleet.run"} < set(PUBLIC)


@pytest.mark.parametrize("name", PUBLIC)
def test_what_is_taken_and_returned_is_said(name):
    function = PUBLIC[name]
    text = inspect.getdoc(function) or ""
    taken = [one for one in inspect.signature(function).parameters if one not in ("self", "cls")]
    if taken:
        assert "Parameters\n----------" in text, f"{name} does not say what it takes"
        section = text.split("Parameters\n----------", 1)[1].split("\n\n")[0]
        lines = [line for line in section.splitlines() if line and not line.startswith(" ")]
        said = {word.strip("* ") for line in lines for word in line.split(" : ")[0].split(",")}
        if "options" in taken and "options" not in said:
            taken.remove("options")
            assert "tracks" in said, f"{name}: the options are not said"
        assert set(taken) <= said, f"{name}: {set(taken) - said}"
    is_short = not taken and text.count("\n") == 0
    if function.__annotations__.get("return") not in (None, "None") and not is_short:
        assert "Returns\n-------" in text, f"{name} does not say what it returns"


def test_options_of_reading_are_typed():
    from trackdyn import _reading

    keywords = _reading.reading({})
    typed = typing.get_type_hints(_reading.ReadingOptions)
    assert set(typed) == set(keywords)
    said = inspect.getdoc(td.read_recording)
    assert [name for name in keywords if name not in said] == []
    for function in (td.read_recording, td.inspect, td.fleet.run):
        assert function.__annotations__["options"] == "Unpack[ReadingOptions]"


@pytest.mark.parametrize("call", [td.read_recording, td.inspect])
def test_an_option_that_there_is_not_names_those_there_are(call):
    with pytest.raises(td.SettingError, match="wheel_radios: expected one of tracks,") as it:
        call("x", wheel_radios=0.1)
    assert it.value.setting == "wheel_radios" and "wheel_radius" in str(it.value)
