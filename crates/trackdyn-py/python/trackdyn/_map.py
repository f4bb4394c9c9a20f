"""ICR maps."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _trackdyn, _values
from ._arguments import COMMAND, Progress, told, vehicle_of
from ._figure import Figure
from ._parameters import Parameters
from ._result import Result
from ._tables import Table
from ._vehicle import Vehicle, VehicleLike

if TYPE_CHECKING:
    import pandas
    import xarray

#: Quantities of a map, with unit and meaning.
_QUANTITIES = {
    "x_l": ("m", "ICR of the left track, right of the centre"),
    "x_r": ("m", "ICR of the right track, right of the centre"),
    "y": ("m", "ICR of both tracks, forward of the centre"),
    "v_forward": ("m/s", "speed forward"),
    "v_lateral": ("m/s", "speed to the left"),
    "yaw_rate": ("rad/s", "yaw rate, counter-clockwise"),
    "status": ("", "kind of motion"),
}


class IcrMap(Result):
    """The stationary motion of a vehicle for every pair of track speeds of a grid.

    Quantities are arrays of shape (n, n): rows are speeds of the left track, columns those of the
    right one, as :attr:`speeds`. :attr:`table` has a row for each pair.

    Attributes
    ----------
    vehicle : Vehicle
        The vehicle.
    table : Table
        All quantities, a row for each pair of track speeds.
    """

    __slots__ = ("table", "vehicle")
    _SAYS = {
        "speeds": lambda inner: inner.speeds,
        "statistics": lambda inner: inner.statistics() or {},
        "parameters": lambda inner: _parameters(inner),
    }
    table: Table
    vehicle: Vehicle

    def __init__(self, inner: _trackdyn.IcrMap, made_from: dict[str, Any]) -> None:
        super().__init__(inner, made_from)
        self.vehicle = made_from["vehicle"]
        self.table = Table(inner.columns())

    @staticmethod
    def _compute(**made_from: Any) -> _trackdyn.IcrMap:
        points, max_speed, position, heading, time = made_from["settings"]
        vehicle = made_from["vehicle"]._inner
        return _trackdyn.icr_map(vehicle, points, max_speed, position, heading, time, None)

    def _state(self) -> dict[str, Any]:
        return {"vehicle": self.vehicle, "table": self.table}

    def _square(self, name: str) -> NDArray[Any]:
        count = len(self.speeds)
        return self.table[name].reshape(count, count)

    @property
    def x_l(self) -> NDArray[np.float64]:
        """ICR of the left track, m right of the centre; NaN where the robot does not turn."""
        return self._square("x_l")

    @property
    def x_r(self) -> NDArray[np.float64]:
        """ICR of the right track, m right of the centre; NaN where the robot does not turn."""
        return self._square("x_r")

    @property
    def y(self) -> NDArray[np.float64]:
        """ICR of both tracks, m forward of the centre; NaN where the robot does not turn."""
        return self._square("y")

    @property
    def v_forward(self) -> NDArray[np.float64]:
        """Speed forward, m/s; NaN where there is no stationary motion."""
        return self._square("v_forward")

    @property
    def v_lateral(self) -> NDArray[np.float64]:
        """Speed to the left, m/s; NaN where there is no stationary motion."""
        return self._square("v_lateral")

    @property
    def yaw_rate(self) -> NDArray[np.float64]:
        """Yaw rate, rad/s, counter-clockwise; NaN where there is no stationary motion."""
        return self._square("yaw_rate")

    @property
    def status(self) -> NDArray[np.int64]:
        """Kind of motion: an index in :attr:`status_names`."""
        return self._square("status")

    @property
    def speeds(self) -> NDArray[np.float64]:
        """The speeds of both tracks, ascending, m/s."""
        return np.asarray(self._say("speeds"))

    @property
    def status_names(self) -> list[str]:
        """Names of the kinds of motion."""
        return list(_trackdyn.IcrMap.status_names())

    @property
    def statistics(self) -> dict[str, float]:
        """Means and spreads of the ICRs (m), steering efficiency and eccentricity.

        Empty where no motion turns.
        """
        return dict(self._say("statistics"))

    @property
    def parameters(self) -> Parameters | None:
        """The parameters to drive with; None where no motion turns."""
        parameters: Parameters | None = self._say("parameters")
        return parameters

    @property
    def figure(self) -> Figure:
        """The map as a figure."""
        return Figure(self._inner.figure(COMMAND))

    def to_xarray(self) -> xarray.Dataset:
        """The map as a Dataset of xarray, which has to be installed: dimensions v_left, v_right."""
        import xarray

        dims = ("v_left", "v_right")
        variables = {
            name: (dims, getattr(self, name), {"units": unit, "long_name": meaning})
            for name, (unit, meaning) in _QUANTITIES.items()
        }
        coords = {name: (name, self.speeds, {"units": "m/s"}) for name in dims}
        return xarray.Dataset(variables, coords, {"vehicle": self.vehicle.name, **self.statistics})

    def to_frame(self) -> pandas.DataFrame:
        """The map as a frame of pandas, which has to be installed: a row for each pair."""
        return self.table.to_frame()

    def write(self, folder: str | os.PathLike[str]) -> list[os.PathLike[str]]:
        """Write ``icr_map.png`` and, where the robot turns, ``kinematics.toml``.

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
        count = len(self.speeds)
        return f"<IcrMap of {self.vehicle.name}, {count} x {count} track speeds>"

    def _repr_html_(self) -> str:
        from ._html import page

        return page(repr(self)[1:-1], list(self.statistics.items()))


def icr_map(
    vehicle: VehicleLike,
    *,
    points: int = 21,
    max_speed: float = 1.0,
    position: Sequence[float] = (0.0, 0.0),
    heading: float = 0.0,
    time: float = 0.0,
    progress: bool | Progress | None = None,
) -> IcrMap:
    """Solve the stationary motion of a vehicle for every pair of track speeds of a grid.

    Parameters
    ----------
    vehicle : Vehicle, str, path or mapping
        The vehicle with its effects.
    points : int
        Speeds per track.
    max_speed : float
        Largest track speed, m/s.
    position : pair of float
        Place in the world, m, for effects that know places.
    heading : float
        Heading in the world, rad, for effects that know directions.
    time : float
        Time since the start, s, for effects that know times.
    progress : bool or callable
        Show a bar (tqdm), or call with stage, finished parts and all parts.

    Returns
    -------
    IcrMap

    Raises
    ------
    SettingError
        For a grid, a place, a heading or a time that cannot be.

    Examples
    --------
    >>> import trackdyn as td
    >>> round(td.icr_map("auriga-alpha").statistics["x_r"], 5)
    0.45735
    """
    of = vehicle_of(vehicle)
    x, y = _values.numbers("position", position, "x and y in m", 2)
    numbers = _values.number("heading", heading), _values.number("time", time)
    grid = _values.count("points", points), _values.number("max_speed", max_speed)
    settings = (*grid, (x, y), *numbers)
    with told(progress, "map") as tell:
        inner = _trackdyn.icr_map(of._inner, *settings, tell)
    return IcrMap(inner, {"vehicle": of, "settings": settings})


def _parameters(inner: _trackdyn.IcrMap) -> Parameters | None:
    found = inner.parameters(COMMAND)
    return None if found is None else Parameters._of(found)
