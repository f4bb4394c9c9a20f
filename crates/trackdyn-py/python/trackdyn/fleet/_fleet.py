"""The logs of a run: which rows are to be made, their making, and the table of all."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from concurrent.futures import Executor, Future
from contextlib import closing
from typing import Any

from .._arguments import Progress
from .._errors import ResultError, SettingError
from .._trackdyn import VERSION as __version__
from .._vehicle import Vehicle
from . import _table
from ._guard import make
from ._jobs import Options, carried_laws, fingerprint_of, job_of
from ._journal import Journal
from ._known import Known
from ._logs import Log
from ._outcome import Outcome
from ._submit import Lost, made, results


class Fleet:
    """Logs with what their rows are made from."""

    def __init__(
        self, logs: list[Log], vehicles: dict[str, Vehicle], options: Options, outcome: Outcome
    ) -> None:
        self._logs = {log.name: log for log in logs}
        self._vehicles = vehicles
        self._fingerprints = {robot: fingerprint_of(one) for robot, one in vehicles.items()}
        self._laws = {robot: carried_laws(one, options) for robot, one in vehicles.items()}
        self._options = options
        self._outcome = outcome

    def todo(self, known: Mapping[str, Known], retry: bool) -> dict[str, str | None]:
        """Logs whose row is to be made, with the SHA-256 with which it need not be."""
        todo: dict[str, str | None] = {}
        options = self._options.fingerprint
        for name, log in self._logs.items():
            row = known.get(name)
            if row is None:
                todo[name] = None
                continue
            vehicle = self._fingerprints[log.robot]
            reason = row.differs(vehicle, options, __version__, retry)
            if reason is not None:
                self._outcome.again[reason] += 1
                todo[name] = None
            elif row.is_touched(name):
                todo[name] = row.sha256
            else:
                self._outcome.kept += 1
        return todo

    def make(
        self,
        executor: Executor,
        todo: Mapping[str, str | None],
        journal: Journal,
        tell: Progress | None,
    ) -> None:
        """Make the rows and keep each in the journal as it comes.

        Raises
        ------
        SettingError
            Where an option is not accepted: no log could be made with it.
        ResultError
            Where the executor broke.
        """
        outcome = self._outcome
        jobs = (self._job(self._logs[name], unless) for name, unless in todo.items())
        with closing(results(executor, jobs, make)) as done:
            for job, future in done:
                done_now = _result(job["log"], future)
                if done_now["is_same"]:
                    outcome.kept += 1
                    journal.append(None, done_now["timing"])
                else:
                    row = self._named(job["log"], done_now["row"])
                    if job["unless"] is not None:
                        outcome.again["of changed logs"] += 1
                    outcome.made[row["status"]] += 1
                    journal.append(row, done_now["timing"])
                if tell is not None:
                    failed = sum(outcome.made.values()) - outcome.made["ok"]
                    tell(f"{failed} not ok", outcome.done, outcome.logs)

    def _job(self, log: Log, unless: str | None) -> dict[str, Any]:
        vehicle, laws = self._vehicles[log.robot], self._laws[log.robot]
        return job_of(log, vehicle, laws, self._options, unless)

    def merge(self, journal: Journal) -> None:
        """Write the table and the file beside it, with the rows of the journal."""
        out = self._outcome.path
        kept = _table.read(out)
        if kept is None and not len(journal):
            return
        beside = _table.beside(out)
        timings = (timing for _, timing in journal.rows())
        _table.write(beside, _table.timing_schema(), timings, _table.read(beside))
        rows = (row for row, _ in journal.rows() if row is not None)
        _table.write(out, _table.schema(), map(self._renamed, rows), self._all_renamed(kept))

    def _named(self, name: str, row: dict[str, Any]) -> dict[str, Any]:
        """A row with what its worker is not asked for."""
        robot = self._logs[name].robot
        if row.get("error_kind") == "SettingError":
            raise SettingError(row["error"], row["error"].split(" ", 1)[0])
        if row.get("version", __version__) != __version__:
            found = f"a worker has trackdyn {row['version']}, and this program {__version__}"
            raise ResultError(f"{found}: expected one version")
        gauge = self._vehicles[robot].gauge
        made_from = {"vehicle": self._fingerprints[robot], "gauge_m": gauge}
        made_from |= {"options": self._options.fingerprint, "version": __version__}
        return self._renamed({**row, **made_from, "log": name})

    def _renamed(self, row: dict[str, Any]) -> dict[str, Any]:
        """A row with robot and time as they are asked for now."""
        log = self._logs.get(row["log"])
        if log is None:
            return row
        first = row.get("first_stamp")
        return {**row, "robot": log.robot, "time": first if log.time_ns is None else log.time_ns}

    def _all_renamed(self, kept: Any) -> Any:
        """A table with robots and times as they are asked for now."""
        if kept is None:
            return None
        import pyarrow as pa

        names = ["log", "robot", "time", "first_stamp"]
        # whole ns: Python's times have microseconds
        columns = {name: kept[name] for name in names}
        for name in names[2:]:
            columns[name] = columns[name].cast(pa.int64())
        rows: Iterator[dict[str, Any]] = map(self._renamed, pa.table(columns).to_pylist())
        renamed = pa.Table.from_pylist(list(rows), schema=_named_columns(kept, names))
        for name in names[1:3]:
            kept = kept.set_column(kept.column_names.index(name), name, renamed[name])
        return kept


def _named_columns(table: Any, names: list[str]) -> Any:
    import pyarrow as pa

    return pa.schema([table.schema.field(name) for name in names])


def _result(log: str, future: Future[dict[str, Any]]) -> dict[str, Any]:
    """What a worker made of a log; a row that says so where the log cost several workers."""
    try:
        return made(log, future)
    except Lost as lost:
        row = {"status": "crashed", "stage": "start", "error": str(lost)}
        return {"row": row, "timing": {"log": log}, "is_same": False}
