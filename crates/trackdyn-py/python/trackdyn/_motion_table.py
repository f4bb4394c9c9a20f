"""Forces as a table, for the computer of a robot."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _trackdyn, _values
from ._arguments import COMMAND, vehicle_of
from ._result import Result
from ._vehicle import VehicleLike


class MotionTable(Result):
    """Steady motion by the forces on a vehicle, as polynomials of the encoder speeds.

    As a file it is ``motion_table.toml``, and a C header for the computer of the robot.
    """

    __slots__ = ()
    _SAYS = {
        "error": lambda inner: inner.error,
        "unsolved": lambda inner: inner.unsolved,
        "orders": lambda inner: inner.orders,
        "files": lambda inner: dict(inner.files),
    }

    @staticmethod
    def _compute(**made_from: Any) -> _trackdyn.MotionTable:
        return _trackdyn.motion_table(made_from["vehicle"]._inner, made_from["fastest"], COMMAND)

    @property
    def error(self) -> float:
        """Largest difference from the model, m/s; a yaw rate counts as a track speed."""
        return float(self._say("error"))

    @property
    def unsolved(self) -> float:
        """Part of the speeds at which the robot tips over or no forces balance, 0 to 1.

        They have the motion of their neighbours.
        """
        return float(self._say("unsolved"))

    @property
    def files(self) -> dict[str, str]:
        """Names and texts of its files."""
        return dict(self._say("files"))

    def predict(self, v_l: ArrayLike, v_r: ArrayLike) -> NDArray[np.float64]:
        """Motion of the body at encoder speeds.

        Parameters
        ----------
        v_l, v_r : array_like
            Speeds of the tracks by their encoders, m/s, forward positive; of shapes that broadcast.

        Returns
        -------
        ndarray of shape (..., 3)
            Speed forward and to the left (m/s), and yaw rate (rad/s, counter-clockwise).
        """
        left, right, shape = _values.pair(("v_l", "v_r"), v_l, v_r)
        return np.reshape(self._inner.twist(left, right), (*shape, 3))

    def derivatives(self, v_l: ArrayLike, v_r: ArrayLike) -> NDArray[np.float64]:
        """Derivatives of the motion by the encoder speeds.

        Parameters
        ----------
        v_l, v_r : array_like
            As for :meth:`predict`.

        Returns
        -------
        ndarray of shape (..., 3, 2)
            Of speed forward, speed to the left (1) and yaw rate (rad/m), each by `v_l` and `v_r`.
        """
        left, right, shape = _values.pair(("v_l", "v_r"), v_l, v_r)
        return np.reshape(self._inner.by_speed(left, right), (*shape, 3, 2))

    def write(self, folder: str | os.PathLike[str]) -> list[os.PathLike[str]]:
        """Write ``motion_table.toml`` and ``trackdyn_motion.h``.

        Parameters
        ----------
        folder : str or path
            Where they go. It is made where it is not there.

        Returns
        -------
        list of path
            The files.
        """
        return list(self._inner.write(_values.path("folder", folder)))

    def __repr__(self) -> str:
        sizes, angles = self._say("orders")
        return f"<MotionTable of {sizes * angles} polynomials a sector, error {self.error:.1e} m/s>"


def motion_table(vehicle: VehicleLike, *, fastest: float = 1.0) -> MotionTable:
    """Tabulate steady motion by the forces on a vehicle.

    Parameters
    ----------
    vehicle : Vehicle, str, path or mapping
        The vehicle with its effects. Those of heading, place or time are left out, and so is what
        is not steady; the files say which.
    fastest : float
        Largest track speed, m/s.

    Returns
    -------
    MotionTable

    Raises
    ------
    SettingError
        For a largest track speed that cannot be.

    Examples
    --------
    >>> import trackdyn as td
    >>> table = td.motion_table("auriga-alpha", fastest=0.8)
    >>> table.predict(0.3, 0.5).shape, table.error < 1e-6
    ((3,), True)
    """
    made_from = {"vehicle": vehicle_of(vehicle), "fastest": _values.number("fastest", fastest)}
    return MotionTable(MotionTable._compute(**made_from), made_from)
