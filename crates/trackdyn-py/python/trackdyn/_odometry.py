"""Dead reckoning."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _trackdyn, _values
from ._arguments import (
    COMMAND,
    RunsLike,
    gauge_of,
    parameters_of,
    recording_of,
    runs_of,
    time_of,
    vehicle_of,
)
from ._figure import Figure
from ._parameters import Parameters
from ._recording import Recording
from ._result import Result
from ._vehicle import VehicleLike

if TYPE_CHECKING:
    import pandas


class Odometry(Result):
    """Where the robot would be if parameters were true, against where it was.

    Sets of parameters are the ideal drive, then those given, each as it is and, where it has
    factors on the track speeds, without them. Last comes ``"physics"``: the forces on the vehicle,
    where a vehicle was given and they move it through all runs.
    """

    __slots__ = ()
    _SAYS = {
        "sets": lambda inner: inner.sets,
        "errors_at_end": lambda inner: inner.errors_at_end(),
        "paths": lambda inner: inner.paths(),
        "advice": lambda inner: inner.advice(),
        "document": lambda inner: inner.document(COMMAND),
        "runs_csv": lambda inner: inner.runs_csv(),
    }

    @staticmethod
    def _compute(**made_from: Any) -> _trackdyn.Odometry:
        return _trackdyn.odometry(
            made_from["recording"]._inner,
            gauge_of(made_from["vehicle"]),
            [parameters_of(one) for one in made_from["parameters"]],
            *made_from["settings"],
        )

    @property
    def sets(self) -> list[str]:
        """Names of the sets of parameters."""
        return list(self._say("sets"))

    @property
    def errors_at_end(self) -> NDArray[np.float64]:
        """Errors at the end of each run, root mean square over runs: (sets, 2), place (m), yaw (rad)."""
        return np.asarray(self._say("errors_at_end"))

    @property
    def paths(self) -> list[dict[str, Any]]:
        """For each run: ``run``, stamps ``t`` (s), ``recorded`` and a path by the name of each set.

        Paths are arrays of shape (n, 3): x, y (m), yaw (rad) in the frame of the run.
        """
        return list(self._say("paths"))

    @property
    def advice(self) -> str | None:
        """The file to take, ``"ideal"`` or ``"physics"``; None where this replay does not tell."""
        advice: str | None = self._say("advice")[0]
        return advice

    @property
    def reason(self) -> str | None:
        """Why it does not tell, and what to do."""
        reason: str | None = self._say("advice")[1]
        return reason

    @property
    def figure(self) -> Figure:
        """The replay as a figure."""
        return Figure(self._inner.figure(COMMAND))

    def to_dict(self) -> dict[str, Any]:
        """All errors with their intervals, as ``odometry.toml`` says them."""
        return dict(self._say("document"))

    def to_frame(self) -> pandas.DataFrame:
        """Errors run by run and set by set, as a frame of pandas, which has to be installed."""
        import pandas

        return pandas.read_csv(io.StringIO(self._say("runs_csv")))

    def rows(self) -> list[dict[str, str]]:
        """Errors run by run and set by set, as texts."""
        return list(csv.DictReader(io.StringIO(self._say("runs_csv"))))

    def write(self, folder: str | os.PathLike[str]) -> list[os.PathLike[str]]:
        """Write ``odometry.png``, ``runs.csv``, ``odometry.toml`` and trajectories.

        Layers of an earlier replay go: write them after this.

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

    def write_layers(self, folder: str | os.PathLike[str]) -> list[os.PathLike[str]]:
        """Write ``odometry.mcap`` for Foxglove, Rerun and PlotJuggler, and layouts.

        In it are the recorded path, those of the ideal drive and of each set of parameters, ICRs,
        track speeds, and residuals by segments, as messages of ROS 2.

        Parameters
        ----------
        folder : str or path
            Where they go. It is made where it is not there.

        Returns
        -------
        list of path
            The files.
        """
        return list(self._inner.write_layers(_values.path("folder", folder), COMMAND))

    def __repr__(self) -> str:
        return f"<Odometry of {len(self.paths)} runs: {', '.join(self.sets)}>"

    def _repr_html_(self) -> str:
        from ._html import table

        rows = [
            (name, f"{place:.3f} m", f"{np.degrees(yaw):.2f}°")
            for name, (place, yaw) in zip(self.sets, self.errors_at_end)
        ]
        return table(("parameters", "place at the end", "yaw at the end"), rows)


def odometry(
    recording: Recording,
    vehicle: VehicleLike | float,
    parameters: Parameters | Iterable[Parameters] = (),
    *,
    runs: RunsLike = None,
    time: Sequence[float] | None = None,
    tau: float | None = None,
    gyroscope: bool = False,
) -> Odometry:
    """Replay a recording by dead reckoning with the ideal drive and with parameters.

    Parameters
    ----------
    recording : Recording
        Track speeds and poses with positions.
    vehicle : Vehicle, str, path, mapping or float
        The vehicle, whose forces are replayed too, or its gauge in m alone, which is that of the
        ideal drive.
    parameters : Parameters or several
        What to compare.
    runs : str, int or sequence of int, optional
        Replay these runs only. Clocks are estimated from all.
    time : pair of float, optional
        Replay this time of each run only, s from its first reading.
    tau : float, optional
        Time by which poses lag behind the track speeds, s. Default: estimated.
    gyroscope : bool
        Correct the yaw of the poses by the recording's gyroscope.

    Returns
    -------
    Odometry

    Raises
    ------
    OdometryError
        For what cannot be replayed.
    RecordingError
        For a recording without positions, or a part that it does not have.
    """
    single = isinstance(parameters, Parameters) or _values.is_single(parameters)
    several: Any = [parameters] if single else list(parameters)  # type: ignore[arg-type]
    recording_of(recording)
    of: Any = vehicle
    made_from = {
        "recording": recording,
        "vehicle": of if _values.is_number(of) else vehicle_of(of),
        "parameters": several,
        "settings": (
            runs_of(runs),
            time_of(time),
            _values.maybe(_values.finite, "tau", tau),
            _values.flag("gyroscope", gyroscope),
        ),
    }
    return Odometry(Odometry._compute(**made_from), made_from)
