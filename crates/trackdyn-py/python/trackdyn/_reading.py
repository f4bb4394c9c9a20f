"""Reading recordings."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypedDict

from . import _trackdyn, _values
from ._arguments import warn_of
from ._errors import SettingError
from ._recording import Recording

if TYPE_CHECKING:
    from typing_extensions import Unpack as Unpack
elif sys.version_info >= (3, 11):
    from typing import Unpack
else:
    # what runs needs a name alone
    from typing import Union as Unpack


class ReadingOptions(TypedDict, total=False):
    """How a recording is read, see :func:`trackdyn.read_recording`."""

    tracks: str | os.PathLike[str] | None
    columns: str | Mapping[str, str] | None
    tracks_topic: str | None
    left_joints: str | Sequence[str] | None
    right_joints: str | Sequence[str] | None
    joint_signal: str | None
    wheel_radius: float | None
    pose_topic: str | None
    pose_index: int | None
    parent_frame: str | None
    child_frame: str | None
    imu_topic: str | None
    twist_topic: str | None
    separation: float | None
    left_signals: str | Sequence[str] | None
    right_signals: str | Sequence[str] | None
    speed_unit: str | None
    msg_dir: str | os.PathLike[str] | None
    dated_by: str | None
    pose_unit: str | None
    pose_axes: str | None
    mount_yaw: float | None
    gyro_unit: str | None
    accept: str | Sequence[str] | None


_Check = Callable[[str, Any], object]

#: How the value of each option is checked.
_CHECKS: dict[str, _Check] = {
    **dict.fromkeys(ReadingOptions.__annotations__, _values.text),
    **dict.fromkeys(("tracks", "msg_dir"), _values.path),
    **dict.fromkeys(("wheel_radius", "separation"), _values.number),
    "mount_yaw": _values.finite,
    "pose_index": _values.count,
}

#: Options that may have several values.
_LISTS = "left_joints", "right_joints", "left_signals", "right_signals", "accept"


def reading(options: Mapping[str, Any]) -> dict[str, Any]:
    """All options of reading, checked, as the library takes them.

    Raises
    ------
    SettingError
        For one that there is not, or a value of another kind.
    """
    for name in options:
        if name not in _CHECKS:
            raise SettingError(f"{name}: expected one of {', '.join(_CHECKS)}", name)
    given = dict(options)
    if isinstance(given.get("columns"), Mapping):
        given["columns"] = ",".join(f"{key}={name}" for key, name in given["columns"].items())
    single = {
        name: _values.maybe(check, name, given.get(name))
        for name, check in _CHECKS.items()
        if name not in _LISTS
    }
    return {**single, **{name: _values.texts(name, given.get(name)) for name in _LISTS}}


def read_recording(
    path: str | os.PathLike[str], **options: Unpack[ReadingOptions]
) -> Recording:
    """Read a recording.

    Parameters
    ----------
    path : str or path
        A folder with ``recording.toml``; a bag of ROS (``.mcap``, ``.db3``, ``.bag``, or their
        folder); a trajectory of the TUM benchmark (``.tum``, ``.txt``) with `tracks`; one table of
        both (``.csv``) with `columns`; or a table of steady points (``.csv``).
    tracks : str or path
        Of a trajectory: the table of its track speeds (CSV with t, v_left, v_right).
    columns : str or mapping
        Of one table: its columns by key, such as ``{"t": "Time:ms", "v_l": "left:rpm", "v_r":
        "-right:rpm", "x": "px", "y": "py", "yaw": "heading:deg"}``.
    wheel_radius : float
        Belt travel in m per radian of the joints, or of wheels.
    tracks_topic, pose_topic, imu_topic, twist_topic : str
        Of a bag: topics of joint states, poses, readings of an IMU, or a twist in place of joints.
    left_joints, right_joints : str or sequence of str
        Of a bag: joints of each side, with ``-`` before those that run backwards.
    joint_signal : {"velocity", "position"}
        Of a bag: signal of the joints. Default: velocity where there is one. Position also reads
        the numbers of signals as angles or ticks.
    pose_index : int
        Of a bag: which pose of a PoseArray is that of the robot, from 0.
    parent_frame, child_frame : str
        Of a bag: frame that the poses are expressed in, and frame whose poses they are.
    separation : float
        Of a bag: separation in m that the driver of `twist_topic` computes with.
    left_signals, right_signals : str or sequence of str
        Of a bag: numbers that are speeds, such as ``"/status:motors[0].rpm"``.
    speed_unit : str
        Unit of the speeds: m/s, mm/s, cm/s, km/h, mph, ft/s, or of wheels rad/s, rpm, turns/s, deg/s.
    msg_dir : str or path
        Folder of definitions of messages, for signals of a bag that has none.
    dated_by : {"header", "log"}
        Of a bag: what dates its messages.
    pose_unit : {"m", "mm", "cm", "ft", "in"}
        Unit of x and y of the poses; not of satellite fixes.
    pose_axes : {"ros", "ned"}
        Axes of the poses: of ned (north, east, down), y points right and yaw counts clockwise.
    mount_yaw : float
        Yaw of the pose sensor on the robot, rad: pi where it faces backwards.
    gyro_unit : {"rad/s", "deg/s"}
        Unit of the yaw rates of the IMU.
    accept : str or sequence of str
        Doubts that do not stop the reader, see :meth:`Recording.from_arrays`.

    Returns
    -------
    Recording

    Warns
    -----
    trackdyn.Warning
        Of what was cleaned, left out or guessed.

    Raises
    ------
    RecordingError
        For what cannot be read: names file and, where there is one, line and column.
    SettingError
        For an option whose value is not accepted.
    """
    inner = _trackdyn.Recording.open(_values.path("path", path), reading(options))
    warn_of(inner)
    return Recording._of(inner)
