"""Kinematic parameters."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _trackdyn, _values
from ._arguments import COMMAND, text_of_file
from ._document import Document
from ._errors import Warning  # noqa: A004

if TYPE_CHECKING:
    from ._odometry import Odometry


class Parameters(Document):
    """Kinematic parameters of a robot, and where they come from (schema ``trackdyn.kinematics/1``).

    Parameters
    ----------
    path : str or path
        A kinematics file.

    Notes
    -----
    ICRs have the axes of the paper (x right, y forward, from the robot's centre), motions those of
    REP-103 (x forward, y left).
    """

    __slots__ = ("_inner",)
    _inner: _trackdyn.Parameters

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._inner = _trackdyn.Parameters.open(_values.path("path", path))

    @classmethod
    def _of(cls, inner: _trackdyn.Parameters) -> Parameters:
        self = object.__new__(cls)
        self._inner = inner
        return self

    @classmethod
    def from_toml(cls, text: str, name: str = "kinematics.toml") -> Parameters:
        """The parameters of the text of a kinematics file.

        Parameters
        ----------
        text : str
            The text.
        name : str
            What errors call it.

        Returns
        -------
        Parameters
        """
        name, text = _values.text("name", name), _values.text("text", text)
        return cls._of(_trackdyn.Parameters.from_toml(name, text))

    @property
    def name(self) -> str:
        """The file as given, or the name of the one that they go into."""
        return self._inner.name

    @property
    def x_l(self) -> float:
        """ICR of the left track, m right of the centre: negative."""
        return self._inner.values[0]

    @property
    def x_r(self) -> float:
        """ICR of the right track, m right of the centre."""
        return self._inner.values[1]

    @property
    def y(self) -> float:
        """ICR of both, m forward of the centre."""
        return self._inner.values[2]

    @property
    def alpha_l(self) -> float:
        """Factor from measured to true speed of the left track; 1 where it was not fitted."""
        return self._inner.values[3]

    @property
    def alpha_r(self) -> float:
        """Factor from measured to true speed of the right track; 1 where it was not fitted."""
        return self._inner.values[4]

    @property
    def covariance(self) -> NDArray[np.float64] | None:
        """Covariance of x_l, x_r, y and, where fitted, alpha_l, alpha_r; None of a map."""
        covariance = self._inner.covariance
        return None if covariance is None else np.array(covariance)

    @property
    def steering_efficiency(self) -> float:
        """Gauge over the distance of the ICRs: 1 of an ideal differential drive."""
        return self._inner.steering_efficiency

    @property
    def is_doubtful(self) -> bool:
        """Whether other parts of the answer that they come from contradict them."""
        return self._inner.is_doubtful

    @property
    def fingerprint(self) -> str:
        """Fingerprint of the text of the file."""
        return self._inner.fingerprint

    def predict(self, v_l: ArrayLike, v_r: ArrayLike) -> NDArray[np.float64]:
        """Motion of the body at track speeds.

        Parameters
        ----------
        v_l, v_r : array_like
            Speeds of the tracks, m/s, forward positive; of shapes that broadcast.

        Returns
        -------
        ndarray of shape (..., 3)
            Speed forward and to the left (m/s), and yaw rate (rad/s, counter-clockwise).
        """
        left, right, shape = _values.pair(("v_l", "v_r"), v_l, v_r)
        return self._inner.twist(left, right).reshape((*shape, 3))

    def track_speeds(self, forward: ArrayLike, yaw_rate: ArrayLike) -> NDArray[np.float64]:
        """Track speeds for a motion; the lateral speed follows and cannot be chosen.

        Parameters
        ----------
        forward, yaw_rate : array_like
            Speed forward (m/s), and yaw rate (rad/s, counter-clockwise).

        Returns
        -------
        ndarray of shape (..., 2)
            Speeds of the left and the right track, m/s.
        """
        ahead, turn, shape = _values.pair(("forward", "yaw_rate"), forward, yaw_rate)
        return self._inner.track_speeds(ahead, turn).reshape((*shape, 2))

    def write_ros2(
        self,
        folder: str | os.PathLike[str],
        *,
        wheel_radius: float | None = None,
        left_joints: str | Sequence[str] | None = None,
        right_joints: str | Sequence[str] | None = None,
        base_frame: str | None = None,
        odom_frame: str | None = None,
        icr_frame: str | None = None,
        contact_centre: Sequence[float] = (0.0, 0.0),
        controller: str | None = None,
        residuals: Odometry | str | os.PathLike[str] | None = None,
        publish_rate: float | None = None,
    ) -> list[os.PathLike[str]]:
        """Write the parameters of ros2_control's diff_drive_controller, and a launch file.

        Parameters
        ----------
        folder : str or path
            Where to write.
        wheel_radius : float, optional
            Belt travel in m per radian of the wheel joints. Default: that of the log.
        left_joints, right_joints : str or sequence of str, optional
            Wheel joints of each side. Default: those of the log, else ``left_wheel_joint`` and
            ``right_wheel_joint``.
        base_frame : str, optional
            Root link of the robot's URDF. Default: the frame whose poses the log has, else
            ``base_link``.
        odom_frame, icr_frame : str, optional
            Frame of the odometry, and the one midway between the ICRs. Default: ``odom``,
            ``icr_link``.
        contact_centre : pair of float
            Origin of the ICRs in the base frame, m forward and left.
        controller : str, optional
            Name of the controller. Default: ``diff_drive_controller``.
        residuals : Odometry or path of its file, optional
            A replay with these parameters, for the covariances; best of runs that they were not
            fitted to. Default: none are written.
        publish_rate : float, optional
            Rate at which the controller publishes, Hz. Default: 50.

        Returns
        -------
        list of path
            The files.
        """
        expected = "two numbers in m, forward and left"
        texts = {
            "odom_frame": odom_frame,
            "icr_frame": icr_frame,
            "base_frame": base_frame,
            "controller": controller,
        }
        keywords = {
            **{name: _values.maybe(_values.text, name, text) for name, text in texts.items()},
            "wheel_radius": _values.maybe(_values.number, "wheel_radius", wheel_radius),
            "left_joints": _values.texts("left_joints", left_joints),
            "right_joints": _values.texts("right_joints", right_joints),
            "contact_centre": tuple(_values.numbers("contact_centre", contact_centre, expected, 2)),
            "residuals": _residuals(residuals),
            "publish_rate": _values.maybe(_values.number, "publish_rate", publish_rate),
        }
        if publish_rate is not None and residuals is None:
            raise _values.refused("publish_rate", publish_rate, "residuals, whose covariances need it")
        place = _values.path("folder", folder)
        files, are_fitted = _trackdyn.write_ros2(self._inner, place, keywords, COMMAND)
        if are_fitted:
            text = "residuals of driving that was fitted to: covariances come out too small"
            warnings.warn(f"{self.name}: {text}", Warning, stacklevel=2)
        if self.is_doubtful:
            text = "other parts of the answer that they come from contradict them"
            warnings.warn(f"{self.name}: {text}", Warning, stacklevel=2)
        return list(files)

    def __reduce__(self) -> tuple[Any, ...]:
        return Parameters.from_toml, (self._inner.toml, self.name)

    def __repr__(self) -> str:
        return f"<Parameters x_l {self.x_l:.5f}, x_r {self.x_r:.5f}, y {self.y:.5f} m>"


def _residuals(of: Odometry | str | os.PathLike[str] | None) -> tuple[str, str] | None:
    """The name and the text of an odometry file."""
    if of is None:
        return None
    from ._odometry import Odometry

    if isinstance(of, Odometry):
        return "odometry.toml", of._inner.toml(COMMAND)
    return text_of_file(of, "residuals")
