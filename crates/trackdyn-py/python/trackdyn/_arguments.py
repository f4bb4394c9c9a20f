"""What functions accept: vehicles, recordings, parts, progress; and who asked, for the files."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _errors, _values
from ._trackdyn import Parameters as RawParameters
from ._trackdyn import Recording as RawRecording

if TYPE_CHECKING:
    from ._vehicle import Vehicle, VehicleLike

#: Stands in every file that is written, as the command that made it.
COMMAND = "the Python package trackdyn"

#: A function that is called with a stage, finished parts and all parts.
Progress = Callable[[str, int, int], object]

#: Numbers of runs: a list such as ``"7,8,20-29"``, one number or several.
RunsLike = Union[str, int, Sequence[int], None]


def vehicle_of(vehicle: VehicleLike) -> Vehicle:
    """The vehicle that an argument stands for."""
    from ._vehicle import Vehicle

    if isinstance(vehicle, (Vehicle, str, os.PathLike, Mapping)):
        return vehicle if isinstance(vehicle, Vehicle) else Vehicle(vehicle)
    expected = "a Vehicle, the path of a file, the name of a preset, or a dict"
    raise _values.refused("vehicle", vehicle, expected)


def gauge_of(vehicle: VehicleLike | float) -> Any:
    """A gauge in m, or the vehicle that has it."""
    if _values.is_number(vehicle):
        return _values.number("vehicle", vehicle)
    return vehicle_of(vehicle)._inner  # type: ignore[arg-type]


def recording_of(recording: Any) -> RawRecording:
    """The recording that an argument is."""
    from ._recording import Recording

    if isinstance(recording, Recording):
        return recording._inner
    raise _values.refused("recording", recording, "a Recording, as td.read_recording(path) gives it")


def parameters_of(parameters: Any) -> RawParameters:
    """The kinematic parameters that an argument is."""
    from ._parameters import Parameters

    if isinstance(parameters, Parameters):
        return parameters._inner
    expected = "Parameters, such as fitted.parameters_ or td.Parameters(path)"
    raise _values.refused("parameters", parameters, expected)


def runs_of(runs: RunsLike, name: str = "runs") -> str | None:
    """Numbers of runs as the library reads them."""
    if runs is None or isinstance(runs, str):
        return runs
    if _values.is_single(runs):
        return str(_values.whole(name, runs))
    numbers = _values.numbers(name, runs, "a list such as '7,8,20-29', a number, or several")
    return ",".join(str(_values.whole(name, number)) for number in numbers)


def time_of(time: Sequence[float] | None) -> tuple[float, float] | None:
    """A beginning and an end, s."""
    if time is None:
        return None
    start, end = _values.numbers("time", time, "the beginning and the end in s", 2)
    return start, end


def seed_of(seed: Any) -> int:
    """A seed of random numbers."""
    number = _values.whole("seed", seed)
    if not 0 <= number < 2**64:
        raise _values.refused("seed", number, "0 to 2^64 - 1")
    return number


def text_of_file(path: Any, name: str) -> tuple[str, str]:
    """The name and the text of a file."""
    place = _values.path(name, path)
    try:
        return place, Path(place).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "it is no text in UTF-8"
        raise _errors.DocumentError(f"{place}: cannot be read: {reason}") from None


def plain(value: Any) -> Any:
    """A value without NumPy's types, and dicts without entries that are None."""
    if isinstance(value, Mapping):
        return {str(key): plain(one) for key, one in value.items() if one is not None}
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(one) for one in value]
    return value


def warn_of(recording: RawRecording) -> None:
    """Warns of what reading cleaned, left out or guessed."""
    for text in recording.warnings:
        warnings.warn(f"{recording.place}: {text}", _errors.Warning, stacklevel=3)


@contextmanager
def told(progress: bool | Progress | None, title: str) -> Iterator[Progress | None]:
    """A function to tell progress: the one given, or a bar of tqdm where it is installed."""
    if progress is None or progress is False:
        yield None
        return
    if callable(progress):
        yield progress
        return
    if progress is not True:
        raise _values.refused("progress", progress, "True, False, or what can be called")
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    with tqdm(desc=title, unit="part", leave=False) as bar:

        def tell(stage: str, done: int, total: int) -> None:
            bar.total = total
            bar.set_postfix_str(stage, refresh=False)
            bar.update(done - bar.n)

        yield tell
