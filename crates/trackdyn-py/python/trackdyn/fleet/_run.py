"""Rows of many logs: what is there is kept, the rest is made by an executor."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from concurrent.futures import Executor
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from .. import _values
from .._arguments import Progress, told
from .._errors import OutputError, SettingError
from .._reading import ReadingOptions, Unpack
from . import _executors
from ._fleet import Fleet
from ._jobs import DiagnoseLike, FleetVehicle, options_of, vehicles_of
from ._journal import Journal
from ._known import known_rows
from ._logs import RobotLike, TimeLike, find, name_all
from ._outcome import Outcome


def run(
    logs: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
    vehicle: FleetVehicle,
    out: str | os.PathLike[str] = "results.parquet",
    *,
    robot: RobotLike = None,
    time: TimeLike = None,
    diagnose: DiagnoseLike = True,
    identify: Mapping[str, Any] | None = None,
    executor: Executor | AbstractContextManager[Executor] | None = None,
    workers: int | None = None,
    timeout: float = 3600.0,
    memory: float | None = None,
    retry: bool = False,
    progress: bool | Progress | None = None,
    **options: Unpack[ReadingOptions],
) -> Outcome:
    """Identify and diagnose every log of a fleet: one row a log, errors too.

    Parameters
    ----------
    logs : str, path or several
        Logs, or patterns of them such as ``"logs/**/*.mcap"``. Workers must see them at the same
        absolute path.
    vehicle : Vehicle, str, path or mapping
        The vehicle of all robots; or a path with ``{robot}``, such as ``"vehicles/{robot}.toml"``.
    out : str or path
        The table, Parquet. Rows that it has are not made again, unless the log, the vehicle, the
        options or the version of trackdyn changed; rows of other logs stay. Beside it stands
        ``*.timings.parquet``: what each row took, and where.
    robot : str or callable, optional
        Whose a log is: a regular expression with the group ``robot``, searched in its path, or a
        function of its path. Default: the folder that it lies in.
    time : str or callable, optional
        When a log began: the format of the group ``time`` of `robot`, or a function of its path to
        a datetime (of no zone: UTC) or to Unix seconds. Default: that group in ISO 8601, else the
        first stamp of the log where it is a date.
    diagnose : bool or mapping
        Whether to diagnose, or keywords for :func:`trackdyn.diagnose`, such as ``{"laws": law}``.
        It takes by far most of the time; without it, there are ICRs and no claims.
    identify : mapping, optional
        Keywords for :class:`trackdyn.IcrKinematics`, such as ``{"gyroscope": True}``.
    executor : concurrent.futures.Executor, optional
        Who makes the rows, such as ``dask.distributed.Client(...).get_executor(pure=False)`` or
        ``mpi4py.futures.MPIPoolExecutor()``; for others, ``submit`` has to return a future of
        ``concurrent.futures``, as Ray's ``remote(...).future()`` is. A context manager of one is
        entered only where there are rows to make. Default: threads.
    workers : int, optional
        Rows that are made side by side where no executor is given. Default: one a processor.
    timeout : float
        Time that a log may take, s. One that takes longer has a row that says so.
    memory : float, optional
        Address space that a log may take, bytes; one that needs more has a row that says so. Less
        than a process has before it reads a log is refused. Default: not bounded.
    retry : bool
        Make rows again that are not "ok".
    progress : bool or callable
        Show a bar (tqdm), or call with a word, finished logs and all logs.
    **options
        How logs are read, as for :func:`trackdyn.read_recording`.

    Returns
    -------
    Outcome
        With the path of the table. Its columns: ``log``, ``robot``, ``time``, ``first_stamp``;
        ``status``, ``stage``, ``error_kind``, ``error``; ``runs``, ``duration_s``; ``x_l_m``,
        ``x_r_m``, ``y_m``, ``covariance_m2`` (3 by 3, row by row), ``gauge_m``; ``chi`` and its
        standard error ``chi_se``; ``diagnosis``, ``claims``, ``refusals`` (null: not diagnosed);
        ``warnings``; ``fingerprint`` of the recording, ``sha256`` of the log; and of what made the
        row ``vehicle``, ``options``, ``version``.

    Notes
    -----
    A worker has a process of its own make the row. It makes the rows of one log after another, with
    one thread unless the environment has ``RAYON_NUM_THREADS``. One that crashes or hangs costs the
    row of its log. After Ctrl-C the table has the rows that were done.

    Raises
    ------
    SettingError
        For an argument that is not accepted, before any log is read.
    OutputError
        Where the table cannot be written, or another process writes it.
    ResultError
        Where the executor broke. Rows that were done are kept.
    """
    if workers is not None and _values.whole("workers", workers) < 1:
        raise SettingError(f"workers {workers}: expected 1 or more", "workers")
    named = name_all(find(logs), robot, time)
    vehicles = vehicles_of(vehicle, sorted({log.robot for log in named}))
    path = _path(out)
    outcome = Outcome(path, len(named))
    made_by = options_of(options, identify, diagnose, timeout, memory)
    fleet = Fleet(named, vehicles, made_by, outcome)
    journal = Journal(path)
    is_in_table = False
    try:
        todo = fleet.todo(known_rows(path, journal), retry)
        try:
            if todo:
                with _executors.entered(executor, workers) as who, told(progress, "fleet") as tell:
                    fleet.make(who, todo, journal, tell)
        finally:
            fleet.merge(journal)
            is_in_table = True
    finally:
        journal.close(is_in_table)
    return outcome


def _path(out: str | os.PathLike[str]) -> Path:
    path = Path(_values.path("out", out))
    if path.suffix != ".parquet":
        raise SettingError(f"out {path}: expected a name that ends in .parquet", "out")
    try:
        import pyarrow.parquet  # noqa: F401
    except ImportError:
        how = "pip install trackdyn[fleet]"
        raise OutputError(f"{path}: pyarrow writes it and is not installed: {how}") from None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror}") from None
    return path
