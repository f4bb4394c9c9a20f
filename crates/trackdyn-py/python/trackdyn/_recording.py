"""Recordings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _trackdyn, _values
from ._arguments import RunsLike, runs_of, time_of, warn_of
from ._errors import RecordingError
from ._tables import Table

#: Columns of each series, with their defaults where they may be missing.
_COLUMNS = {
    "tracks": ("t", "v_left", "v_right"),
    "poses": ("t", "x", "y", "yaw"),
    "imu": ("t", "gyro_z", "acc_x", "acc_y"),
}


class Recording:
    """What was seen of a robot: a recording of its motion, or a table of steady points.

    Axes are those of REP-103 (x forward, y left, yaw counter-clockwise), units SI, angles in rad.
    Made by :func:`trackdyn.read_recording`, :meth:`from_arrays` or :func:`trackdyn.simulate`.

    The library keeps samples, not columns: :attr:`tracks`, :attr:`poses` and :attr:`imu` are copied
    once, when they are first asked for, and share that memory from then on.
    """

    __slots__ = ("_inner", "_tables", "_warnings")
    _inner: _trackdyn.Recording
    _tables: dict[str, Table]
    _warnings: list[str]

    def __init__(self) -> None:
        raise TypeError("expected td.read_recording(path) or td.Recording.from_arrays(...)")

    @classmethod
    def _of(cls, inner: _trackdyn.Recording, warnings: list[str] | None = None) -> Recording:
        self = object.__new__(cls)
        self._inner = inner
        self._tables = {}
        self._warnings = inner.warnings if warnings is None else warnings
        return self

    @classmethod
    def from_arrays(
        cls,
        tracks: ArrayLike | Mapping[str, ArrayLike],
        poses: ArrayLike | Mapping[str, ArrayLike],
        imu: ArrayLike | Mapping[str, ArrayLike] | None = None,
        *,
        name: str = "arrays",
        robot: str = "unknown",
        accept: str | Sequence[str] | None = None,
    ) -> Recording:
        """A recording of arrays that are at hand.

        They are cleaned and doubted as the rows of a file are. All are copied.

        Parameters
        ----------
        tracks : mapping, frame, table of Arrow, structured array, or array of shape (n, 3)
            Columns ``t`` (s), ``v_left``, ``v_right`` (m/s, forward positive).
        poses : the same kinds, or array of shape (m, 4)
            Columns ``t`` (s, by the clock of the tracks up to a constant), ``x``, ``y`` (m), ``yaw``
            (rad, counter-clockwise).
        imu : the same kinds, or array of shape (k, 4), optional
            Columns ``t`` (s), ``gyro_z`` (rad/s), ``acc_x``, ``acc_y`` (m/s²).
        name : str
            What outputs and errors call it.
        robot : str
            The robot that was recorded.
        accept : str or sequence of str, optional
            Doubts that do not stop the reader, because you know better: ``"travel"``, ``"stamps"``,
            ``"yaw-unit"``, ``"orientation"``, ``"out-of-plane"``, ``"signs"``, ``"dead-encoder"``,
            ``"stuck-poses"``, ``"gyro-range"``.

        Returns
        -------
        Recording

        Raises
        ------
        RecordingError
            For columns that are missing or hold no numbers, and for what the reader doubts.

        Notes
        -----
        Where tables have a column ``run`` of whole numbers, it splits them into runs, each with a
        pose frame of its own.
        """
        given = {"tracks": tracks, "poses": poses, "imu": imu}
        for series in ("tracks", "poses"):
            if given[series] is None:
                raise RecordingError(f"{series}: None: expected {', '.join(_COLUMNS[series])}")
        split = {series: _split(series, rows) for series, rows in given.items() if rows is not None}
        if any(numbers for numbers, _ in split.values()):
            for series, (numbers, _) in split.items():
                if not numbers:
                    raise RecordingError(f"{series}: no column run: expected one, as others have it")
        by_run = {series: rows for series, (_, rows) in split.items()}
        rows = [
            (
                number,
                by_run["tracks"].get(number, np.empty((0, 3))),
                by_run["poses"].get(number, np.empty((0, 4))),
                by_run.get("imu", {}).get(number),
            )
            for number in sorted(by_run["tracks"].keys() | by_run["poses"].keys())
        ]
        names = _values.text("name", name), _values.text("robot", robot)
        inner = _trackdyn.Recording.of_rows(*names, rows, _values.texts("accept", accept))
        warn_of(inner)
        return cls._of(inner)

    def _table(self, series: str) -> Table:
        if series not in self._tables:
            self._tables[series] = Table(self._inner.columns(series))
        return Table(self._tables[series])

    @property
    def tracks(self) -> Table:
        """Track speeds: columns run, t (s), v_left, v_right (m/s, forward positive)."""
        return self._table("tracks")

    @property
    def poses(self) -> Table:
        """Poses in the frame of their run: columns run, t (s), x, y (m), yaw (rad, not wrapped)."""
        return self._table("poses")

    @property
    def imu(self) -> Table:
        """Readings of the IMU in axes of the body: run, t (s), gyro_z (rad/s), acc_x, acc_y (m/s²)."""
        return self._table("imu")

    @property
    def points(self) -> Table:
        """Steady points: v_left, v_right, v_forward, v_lateral (m/s), yaw_rate (rad/s), or NaN."""
        return self._table("points")

    @property
    def name(self) -> str:
        """Its name."""
        return self._inner.name

    @property
    def runs(self) -> list[int]:
        """Numbers of its runs; none of a table of steady points."""
        return self._inner.runs

    @property
    def fingerprint(self) -> str:
        """Fingerprint of what was read; of a part, that of the whole."""
        return self._inner.fingerprint

    @property
    def warnings(self) -> list[str]:
        """What was cleaned, left out or guessed in reading."""
        return list(self._warnings)

    @property
    def info(self) -> dict[str, Any]:
        """What it is: name, robot, runs, duration (s), rows, fingerprint, and what is known of it."""
        inner = self._inner
        return {
            "name": inner.name,
            "place": inner.place,
            "robot": inner.robot,
            "kind": "points" if inner.is_of_points else "motion",
            "runs": inner.runs,
            "duration": inner.duration,
            "tracks": self.tracks.rows,
            "poses": self.poses.rows,
            "imu": self.imu.rows,
            "points": self.points.rows,
            "has_positions": inner.has_positions,
            "epoch_ns": inner.epoch_ns,
            "fingerprint": inner.fingerprint,
            "warnings": self.warnings,
        }

    def part(self, runs: RunsLike = None, time: Sequence[float] | None = None) -> Recording:
        """A part of it: what is fitted on one part is judged on another.

        Parameters
        ----------
        runs : str, int or sequence of int, optional
            These runs only, such as ``"7,8,20-29"``.
        time : pair of float, optional
            This time of each run only, s from its first reading.

        Returns
        -------
        Recording
        """
        return self._of(self._inner.part(runs_of(runs), time_of(time)), self._warnings)

    def __getstate__(self) -> dict[str, Any]:
        return {"kept": self._inner.keep(), "warnings": self._warnings}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._inner = _trackdyn.Recording.restore(state["kept"])
        self._tables = {}
        self._warnings = state["warnings"]

    def __reduce__(self) -> tuple[Any, ...]:
        return object.__new__, (Recording,), self.__getstate__()

    def __repr__(self) -> str:
        if self._inner.is_of_points:
            return f"<Recording {self.name}: {self.points.rows} steady points>"
        runs = len(self.runs)
        return f"<Recording {self.name}: {runs} runs, {self._inner.duration:.1f} s>"

    def _repr_html_(self) -> str:
        from ._html import page

        rows = [(key, value) for key, value in self.info.items() if key != "warnings"]
        return page(f"Recording {self.name}", rows, self.warnings)


def _split(series: str, rows: Any) -> tuple[bool, dict[int, NDArray[np.float64]]]:
    """Whether runs are numbered, and the rows of each in the order of the columns of a series."""
    columns = _COLUMNS[series]
    # of structured arrays, of Arrow, of frames
    places = (getattr(rows, "dtype", None), "names"), (rows, "column_names"), (rows, "columns")
    found_names = (getattr(of, name, None) for of, name in places)
    names = next((one for one in found_names if one is not None), None)
    if isinstance(rows, Mapping) or names is not None:
        known = list(rows) if isinstance(rows, Mapping) else list(names)  # type: ignore[arg-type]
        missing = [name for name in columns if name not in known]
        if missing:
            found = ", ".join(map(str, known))
            expected = ", ".join(columns)
            raise RecordingError(f"{series}: columns {found}: expected {expected}")
        by_name = [_column(series, name, rows[name]) for name in columns]
        if len({len(column) for column in by_name}) > 1:
            lengths = ", ".join(str(len(column)) for column in by_name)
            raise RecordingError(f"{series}: columns of {lengths} rows: expected one length")
        table = np.column_stack(by_name)
        numbers = _column(series, "run", rows["run"]) if "run" in known else None
        if numbers is not None and len(numbers) != len(table):
            found = f"{len(numbers)} numbers of {len(table)} rows"
            raise RecordingError(f"{series}: column run: {found}: expected one length")
        if numbers is not None and not np.all((numbers == np.rint(numbers)) & (abs(numbers) < 2**53)):
            raise RecordingError(f"{series}: column run: expected whole numbers")
    else:
        array = _values.floats(rows)
        if array is None:
            raise RecordingError(f"{series}: not numbers: expected {', '.join(columns)}")
        table = np.ascontiguousarray(array)
        numbers = None
    if table.ndim != 2 or table.shape[1] != len(columns):
        shape = f"(n, {len(columns)})"
        raise RecordingError(
            f"{series}: an array of shape {table.shape}: expected {shape}: {', '.join(columns)}"
        )
    if numbers is None:
        return False, {0: table}
    return True, {
        int(number): np.ascontiguousarray(table[numbers == number]) for number in np.unique(numbers)
    }


def _column(series: str, name: str, values: Any) -> NDArray[np.float64]:
    """A column of numbers."""
    column = _values.floats(values)
    if column is None or column.ndim != 1:
        shape = "not numbers" if column is None else f"an array of shape {column.shape}"
        raise RecordingError(f"{series}: column {name}: {shape}: expected numbers in one dimension")
    return column
