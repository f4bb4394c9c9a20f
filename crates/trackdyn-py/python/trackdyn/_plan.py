"""Plans of the driving that decides."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _trackdyn, _values
from ._arguments import COMMAND, Progress, text_of_file, told, vehicle_of
from ._diagnosis import Diagnosis
from ._errors import DocumentError, VehicleError
from ._result import Result
from ._vehicle import Vehicle, VehicleLike


def _beside(diagnosis: str) -> Vehicle:
    """The vehicle that a diagnosis corrected."""
    try:
        return Vehicle(Path(diagnosis).with_name("vehicle.corrected.toml"))
    except (DocumentError, VehicleError) as error:
        expected = "expected beside the diagnosis, or vehicle"
        raise type(error)(f"{error}\n{expected}", error.setting) from None


class Plan(Result):
    """What to drive next, and what it separates."""

    __slots__ = ()
    _SAYS = {
        "schedule": lambda inner: inner.schedule(),
        "document": lambda inner: inner.document(COMMAND),
    }

    @staticmethod
    def _compute(**made_from: Any) -> _trackdyn.Plan:
        diagnosis, vehicle = made_from["diagnosis"], made_from["vehicle"]._inner
        fastest, duration, noise_xy, noise_yaw = made_from["settings"]
        return _trackdyn.plan(diagnosis, vehicle, fastest, duration, noise_xy, noise_yaw, None)

    @property
    def schedule(self) -> NDArray[np.float64] | None:
        """The commands, of shape (n, 3): t (s), v_left, v_right (m/s). None: no driving decides."""
        schedule: NDArray[np.float64] | None = self._say("schedule")
        return schedule

    def to_dict(self) -> dict[str, Any]:
        """The plan, as ``plan.toml`` says it."""
        return dict(self._say("document"))

    def write(self, folder: str | os.PathLike[str]) -> list[os.PathLike[str]]:
        """Write ``plan.csv``, a schedule for simulator and robot, and ``plan.toml``.

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
        schedule = self.schedule
        if schedule is None:
            return "<Plan: no driving decides>"
        return f"<Plan of {schedule[-1, 0] - schedule[0, 0]:.1f} s>"


def plan(
    diagnosis: Diagnosis | str | os.PathLike[str],
    vehicle: VehicleLike | None = None,
    *,
    fastest: float = 1.0,
    duration: float = 60.0,
    noise_xy: float | None = None,
    noise_yaw: float | None = None,
    progress: bool | Progress | None = None,
) -> Plan:
    """Plan the driving that tells apart what a diagnosis could not.

    Parameters
    ----------
    diagnosis : Diagnosis, or path of its file
        What is open.
    vehicle : Vehicle, str, path or mapping, optional
        The vehicle that has what the diagnosis found. Default: the one that it corrected.
    fastest : float
        Largest track speed, m/s.
    duration : float
        Time for all manoeuvres together, s.
    noise_xy, noise_yaw : float, optional
        Standard deviation of a pose along each axis, m, and of its yaw, rad. Default: as the
        diagnosis measured it.
    progress : bool or callable
        Show a bar (tqdm), or call with stage, finished parts and all parts.

    Returns
    -------
    Plan
        Its schedule is None where nothing is open, or where no driving decides.
    """
    if isinstance(diagnosis, Diagnosis):
        named = (diagnosis.name, diagnosis.to_toml())
        of = diagnosis.corrected_vehicle if vehicle is None else vehicle_of(vehicle)
    else:
        named = text_of_file(diagnosis, "diagnosis")
        # what is no diagnosis is said before a vehicle is sought beside it
        _trackdyn.is_decided(named)
        of = _beside(named[0]) if vehicle is None else vehicle_of(vehicle)
    limits = _values.number("fastest", fastest), _values.number("duration", duration)
    noise = (
        _values.maybe(_values.number, "noise_xy", noise_xy),
        _values.maybe(_values.number, "noise_yaw", noise_yaw),
    )
    settings = (*limits, *noise)
    with told(progress, "plan") as tell:
        inner = _trackdyn.plan(named, of._inner, *settings, tell)
    return Plan(inner, {"diagnosis": named, "vehicle": of, "settings": settings})
