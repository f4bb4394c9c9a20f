"""Judging a recording before it is used."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

from . import _trackdyn, _values
from ._arguments import RunsLike, gauge_of, parameters_of, runs_of, time_of
from ._figure import Figure
from ._parameters import Parameters
from ._reading import ReadingOptions, Unpack, reading
from ._vehicle import VehicleLike


class Inspection:
    """A recording with its judgement.

    Attributes
    ----------
    name : str
        Its name.
    content : {"motion", "points", "poses", "unread"}
        What it holds.
    topics : list of dict
        The topics, where it is a bag.
    driving : dict
        What the robot did: runs, duration (s), distance (m), turned and spun (rad, left and right),
        clock offset tau (s), separation of the ICRs (m, with its 95 % interval).
    taken : list of str
        What was taken where there was a choice.
    findings : list of str
        What looks wrong.
    lacks : list of pair of str
        What it lacks, and what to do about it.
    readiness : dict
        For identify, odometry and diagnose: "yes", "in part" or "no", and why.
    options : dict
        Keywords for :func:`trackdyn.read_recording` with which to go on.
    parts : pair or None
        Two parts of it, as arguments of :meth:`Recording.part`: to fit on one and judge on the other.
    figure : Figure or None
        Speeds and yaw rates over time.
    """

    def __init__(self, found: dict[str, Any]) -> None:
        self.name: str = found["name"]
        self.content: str = found["content"]
        self.fingerprint: str | None = found["fingerprint"]
        self.topics: list[dict[str, Any]] = found["topics"]
        self.driving: dict[str, Any] = found.get("driving", {})
        self.taken: list[str] = found["taken"]
        self.findings: list[str] = found["findings"]
        self.lacks: list[tuple[str, str]] = found["lacks"]
        self.readiness: dict[str, tuple[str, str]] = found["readiness"]
        self.options: dict[str, Any] = found["options"]
        self.parts: Any = found.get("parts")
        figure = found.get("figure")
        self.figure = None if figure is None else Figure(figure)

    def __repr__(self) -> str:
        ready = ", ".join(f"{use} {verdict}" for use, (verdict, _) in self.readiness.items())
        return f"<Inspection of {self.name}: {ready}>"

    def _repr_html_(self) -> str:
        from ._html import page

        rows = [
            (use, f"{verdict}: {reason}" if reason else verdict)
            for use, (verdict, reason) in self.readiness.items()
        ]
        lacks = [f"{what}: {advice}" for what, advice in self.lacks]
        return page(f"Inspection of {self.name}", rows, [*self.findings, *lacks])


def inspect(
    path: str | os.PathLike[str],
    *,
    vehicle: VehicleLike | float | None = None,
    parameters: Parameters | None = None,
    runs: RunsLike = None,
    time: Sequence[float] | None = None,
    tau: float | None = None,
    **options: Unpack[ReadingOptions],
) -> Inspection:
    """Judge a recording: what is there, what is missing for which use, what looks wrong.

    Parameters
    ----------
    path : str or path
        The recording.
    vehicle : Vehicle, str, path, mapping or float, optional
        The vehicle or its gauge in m, by which ICRs are judged.
    parameters : Parameters, optional
        Parameters that predict the yaw rate. Default: the distance of the ICRs that fits best.
    runs, time
        The part of it to judge, as for :meth:`Recording.part`.
    tau : float, optional
        Time by which poses lag behind the track speeds, s. Default: estimated.
    **options
        How it is read, as for :func:`trackdyn.read_recording`. What a bag needs beyond that is
        found where it can be.

    Returns
    -------
    Inspection

    Raises
    ------
    RecordingError
        For what cannot be read at all.
    SettingError
        For an option whose value is not accepted.
    """
    found = _trackdyn.inspect(
        _values.path("path", path),
        reading(options),
        None if vehicle is None else gauge_of(vehicle),
        None if parameters is None else parameters_of(parameters),
        runs_of(runs),
        time_of(time),
        _values.maybe(_values.finite, "tau", tau),
    )
    return Inspection(found)
