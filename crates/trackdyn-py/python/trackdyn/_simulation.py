"""Drives in time."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from . import _trackdyn, _values
from ._arguments import COMMAND, Progress, seed_of, told, vehicle_of
from ._errors import DrivingError, SettingError
from ._recording import Recording
from ._result import Result
from ._tables import Table
from ._vehicle import Vehicle, VehicleLike


class Simulation(Result):
    """A robot that was driven in simulation: what its sensors recorded, and how it really moved.

    Attributes
    ----------
    recording : Recording
        What the sensors recorded.
    vehicle : Vehicle
        The vehicle as it was driven.
    """

    __slots__ = ("_truth", "recording", "vehicle")
    _SAYS = {"document": lambda inner: inner.document(COMMAND)}
    _truth: Table | None
    recording: Recording
    vehicle: Vehicle

    def __init__(self, inner: _trackdyn.Simulation, made_from: dict[str, Any]) -> None:
        super().__init__(inner, made_from)
        self._truth = None
        self.recording = Recording._of(inner.recording)
        self.vehicle = Vehicle._of(inner.vehicle)

    @staticmethod
    def _compute(**made_from: Any) -> _trackdyn.Simulation:
        vehicle, keywords, seed = (made_from[key] for key in ("vehicle", "keywords", "seed"))
        return _trackdyn.simulate(vehicle._inner, keywords, seed, None)

    def _state(self) -> dict[str, Any]:
        return {"recording": self.recording, "vehicle": self.vehicle, "_truth": self.truth}

    @property
    def truth(self) -> Table:
        """The true motion, at every step of the integration.

        Columns run, t (s), x, y (m), yaw (rad), v_forward, v_lateral (m/s), yaw_rate (rad/s), and
        v_left, v_right: speeds of the belts over the hull (m/s).
        """
        if self._truth is None:
            self._truth = Table(self._inner.truth())
        return Table(self._truth)

    def to_dict(self) -> dict[str, Any]:
        """What it was made from, as ``simulation.toml`` says it."""
        return dict(self._say("document"))

    def write(self, folder: str | os.PathLike[str]) -> list[os.PathLike[str]]:
        """Write the recording, ``truth.csv`` and what it was made from.

        Parameters
        ----------
        folder : str or path
            Where they go. It is made where it is not there.

        Returns
        -------
        list of path
            The files.
        """
        return list(self._inner.write(_values.path("folder", folder), COMMAND))

    def __repr__(self) -> str:
        return f"<Simulation of {self.vehicle.name}: {self.recording!r}>"


def simulate(
    vehicle: VehicleLike,
    schedule: str | os.PathLike[str] | ArrayLike | Mapping[int, ArrayLike] = "manual",
    *,
    seed: int = 1,
    runs: int | None = None,
    duration: float | None = None,
    fastest: float | None = None,
    sensors: str | os.PathLike[str] = "laboratory",
    start: Sequence[float] = (0.0, 0.0, 0.0),
    inertia: bool = True,
    longest_step: float | None = None,
    progress: bool | Progress | None = None,
) -> Simulation:
    """Drive a robot in time, over ground with any of its effects, and record it.

    Parameters
    ----------
    vehicle : Vehicle, str, path or mapping
        The vehicle with its effects.
    schedule : str, path, array or mapping
        What the tracks do: ``"manual"``, ``"validation"``, ``"designed"``, ``"square"``; a CSV file
        t,v_left,v_right; an array of shape (n, 3) with these columns (s, m/s), whose last row ends
        the drive; or such an array for each run, by its number.
    seed : int
        Seed of driving and noise.
    runs : int, optional
        Runs of driving that is generated. Default: what is usual for it.
    duration : float, optional
        Time of each run of driving that is generated, s. Default: as long as it takes.
    fastest : float, optional
        Largest track speed of driving that is generated, m/s. Default: 1.
    sensors : str or path
        ``"perfect"``, ``"laboratory"``, ``"field"``, or a file (schema ``trackdyn.sensors/1``).
    start : triple of float
        Where each run begins: x, y (m), yaw (rad).
    inertia : bool
        Whether the robot has inertia. Without, it is at its stationary motion at once.
    longest_step : float, optional
        Longest step of the integration, s.
    progress : bool or callable
        Show a bar (tqdm), or call with stage, finished parts and all parts.

    Returns
    -------
    Simulation
        Depends on the arguments alone, not on the number of threads.
    """
    keywords = _keywords(schedule, runs, duration, fastest, sensors, start, inertia, longest_step)
    of, number = vehicle_of(vehicle), seed_of(seed)
    with told(progress, "simulate") as tell:
        inner = _trackdyn.simulate(of._inner, keywords, number, tell)
    return Simulation(inner, {"vehicle": of, "keywords": keywords, "seed": number})


def simulate_batch(
    vehicle: VehicleLike | Iterable[VehicleLike],
    schedule: str | os.PathLike[str] | ArrayLike | Mapping[int, ArrayLike] = "manual",
    *,
    parameters: Mapping[str, ArrayLike] | None = None,
    seed: int | ArrayLike = 1,
    runs: int | None = None,
    duration: float | None = None,
    fastest: float | None = None,
    sensors: str | os.PathLike[str] = "laboratory",
    start: Sequence[float] = (0.0, 0.0, 0.0),
    inertia: bool = True,
    longest_step: float | None = None,
    errors: Literal["raise", "none"] = "raise",
    progress: bool | Progress | None = None,
) -> list[Simulation | None]:
    """Drive many robots at once, in parallel, without holding the interpreter.

    Parameters
    ----------
    vehicle : Vehicle, str, path or mapping; or several
        One vehicle with `parameters`, or a vehicle for each drive.
    schedule : str, path, array or mapping
        What the tracks do, as for :func:`simulate`; all robots drive it.
    parameters : mapping of array_like, optional
        Values by their place in the vehicle file, one for each drive, such as
        ``{"friction.mu_x": mu, "effect.load-transfer.cog_height_m": height}``.
    seed : int or array_like of int
        One for all drives, or one for each. One for all: they differ in nothing but parameters.
    errors : {"raise", "none"}
        What becomes of a robot that cannot be simulated: its error is raised, of several the first,
        or None stands in its place.
    runs, duration, fastest, sensors, start, inertia, longest_step, progress
        As for :func:`simulate`.

    Returns
    -------
    list of Simulation
        In the order of the parameters or vehicles, each as :func:`simulate` gives it.
    """
    vehicles = _vehicles(vehicle, parameters)
    seeds: Any = [seed] * len(vehicles) if _values.is_single(seed) else seed
    keywords = _keywords(schedule, runs, duration, fastest, sensors, start, inertia, longest_step)
    inner = [one._inner for one in vehicles]
    numbers = [seed_of(number) for number in seeds]
    if _values.text("errors", errors) not in ("raise", "none"):
        raise _values.refused("errors", errors, "'raise' or 'none'")
    with told(progress, "simulate") as tell:
        found = _trackdyn.simulate_batch(inner, keywords, numbers, tell)
    simulated: list[Simulation | None] = []
    for one, of, number in zip(found, vehicles, numbers):
        if isinstance(one, BaseException):
            if errors == "raise":
                raise one
            simulated.append(None)
        else:
            made_from = {"vehicle": of, "keywords": keywords, "seed": number}
            simulated.append(Simulation(one, made_from))
    return simulated


def _vehicles(
    vehicle: VehicleLike | Iterable[VehicleLike], parameters: Mapping[str, ArrayLike] | None
) -> list[Vehicle]:
    if not isinstance(vehicle, (Vehicle, str, os.PathLike, Mapping)):
        if parameters is not None:
            raise SettingError("parameters: expected with one vehicle, and there are several")
        several: Any = [vehicle] if _values.is_single(vehicle) else vehicle
        return [vehicle_of(one) for one in several]
    expected = "values by their place in the vehicle file, such as {'friction.mu_x': [0.6, 0.7]}"
    if parameters is not None:
        parameters = _values.mapping("parameters", parameters, expected)
    if not parameters:
        raise SettingError("parameters: expected one value or more, or several vehicles")
    base = vehicle_of(vehicle)
    columns = {place: np.atleast_1d(np.asarray(of)) for place, of in parameters.items()}
    lengths = {len(of) for of in columns.values()}
    if len(lengths) > 1:
        found = ", ".join(f"{place} {len(of)}" for place, of in columns.items())
        raise SettingError(f"parameters: values of {found}: expected as many of each")
    rows = zip(*columns.values())
    return [base.with_values(dict(zip(columns, row))) for row in rows]


def _keywords(
    schedule: Any,
    runs: int | None,
    duration: float | None,
    fastest: float | None,
    sensors: str | os.PathLike[str],
    start: Sequence[float],
    inertia: bool,
    longest_step: float | None,
) -> dict[str, Any]:
    expected = "x, y (m) and yaw (rad)"
    return {
        "schedule": _commands(schedule),
        "runs": _values.maybe(_values.count, "runs", runs),
        "duration": _values.maybe(_values.number, "duration", duration),
        "fastest": _values.maybe(_values.number, "fastest", fastest),
        "sensors": _values.path("sensors", sensors),
        "start": tuple(_values.numbers("start", start, expected, 3)),
        "inertia": _values.flag("inertia", inertia),
        "longest_step": _values.maybe(_values.number, "longest_step", longest_step),
    }


def _commands(schedule: Any) -> Any:
    """A name or path, or numbers of runs with their commands."""
    if isinstance(schedule, (str, os.PathLike)):
        return os.fspath(schedule)
    runs = schedule.items() if isinstance(schedule, Mapping) else [(0, schedule)]
    expected = "the name of a schedule, a file, or rows of t, v_left, v_right"
    tables = [
        (_values.whole("schedule", run), _values.array("schedule", rows, expected))
        for run, rows in runs
    ]
    for run, rows in tables:
        if abs(run) >= 2**63:
            raise _values.refused("schedule", run, "numbers of runs within 64 bits")
        if rows.ndim != 2 or rows.shape[1] != 3:
            expected = "expected (n, 3): t, v_left, v_right"
            raise DrivingError(f"schedule: run {run}: an array of shape {rows.shape}: {expected}")
    return [(run, np.ascontiguousarray(rows)) for run, rows in tables]
