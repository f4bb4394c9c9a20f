"""What functions accept: vehicles, numbers of NumPy, progress; and who asked, for the files."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _errors
from ._trackdyn import Recording as RawRecording

if TYPE_CHECKING:
    from ._vehicle import Vehicle

#: Stands in every file that is written, as the command that made it.
COMMAND = "the Python package trackdyn"

#: A function that is called with a stage, finished parts and all parts.
Progress = Callable[[str, int, int], object]

#: A vehicle, or what makes one: the path of a file, the name of a preset, or a dict.
VehicleLike = Union["Vehicle", str, "os.PathLike[str]", Mapping[str, Any]]

#: Numbers of runs: a list such as ``"7,8,20-29"``, one number or several.
RunsLike = Union[str, int, Sequence[int], None]


def vehicle_of(vehicle: VehicleLike) -> Vehicle:
    """The vehicle that an argument stands for."""
    from ._vehicle import Vehicle

    return vehicle if isinstance(vehicle, Vehicle) else Vehicle(vehicle)


def gauge_of(vehicle: VehicleLike | float) -> Any:
    """A gauge in m, or the vehicle that has it."""
    if isinstance(vehicle, (int, float, np.integer, np.floating)):
        return float(vehicle)
    return vehicle_of(vehicle)._inner


def runs_of(runs: RunsLike) -> str | None:
    """Numbers of runs as the library reads them."""
    if runs is None or isinstance(runs, str):
        return runs
    numbers = np.atleast_1d(np.asarray(runs))
    return ",".join(str(int(number)) for number in numbers)


def time_of(time: Sequence[float] | None) -> tuple[float, float] | None:
    """A beginning and an end, s."""
    if time is None:
        return None
    start, end = time
    return float(start), float(end)


def seed_of(seed: Any) -> int:
    """A seed of random numbers."""
    number = int(seed)
    if not 0 <= number < 2**64:
        raise _errors.SettingError(f"seed {number}: expected 0 to 2^64 - 1", "seed")
    return number


def names_of(names: str | Sequence[str] | None) -> list[str]:
    """One name, several or none."""
    if names is None:
        return []
    return [names] if isinstance(names, str) else [str(name) for name in names]


def pair_of(
    one: ArrayLike, other: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64], tuple[int, ...]]:
    """Two arrays of one shape, flat, and that shape."""
    first, second = np.broadcast_arrays(
        np.asarray(one, dtype=np.float64), np.asarray(other, dtype=np.float64)
    )
    return np.ravel(first), np.ravel(second), first.shape


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
