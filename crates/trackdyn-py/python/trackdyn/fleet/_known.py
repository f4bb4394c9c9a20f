"""Rows that are there, and whether they still hold."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from . import _table
from ._files import look
from ._journal import Journal

_COLUMNS = ["status", "sha256", "vehicle", "options", "version"]


@dataclass(frozen=True)
class Known:
    """What a row was made from, and how its log looked then."""

    status: str
    sha256: str | None
    vehicle: str
    options: str
    version: str
    look: str | None = None

    def differs(self, vehicle: str, options: str, version: str, retry: bool) -> str | None:
        """Why the row is to be made again, whatever the log; None: it is not."""
        if self.version != version:
            return "of another version of trackdyn"
        if self.vehicle != vehicle:
            return "of another vehicle"
        if self.options != options:
            return "with other options"
        return "not ok" if retry and self.status != "ok" else None

    def is_touched(self, log: str) -> bool:
        """Whether the log looks otherwise, so that its bytes have to tell."""
        try:
            return bool(look(Path(log))["look"] != self.look)
        except OSError:
            return True


def known_rows(out: Path, journal: Journal) -> dict[str, Known]:
    """The rows of a table and of the journal beside it, by log."""
    known: dict[str, Known] = {}
    table = _table.read(out, ["log", *_COLUMNS])
    for row in () if table is None else table.to_pylist():
        known[row["log"]] = _known(row)
    seen = _table.read(_table.beside(out), ["log", "look"])
    for row in () if seen is None else seen.to_pylist():
        _see(known, row)
    for made, timing in journal.rows():
        if made is not None:
            known[timing["log"]] = _known(made)
        _see(known, timing)
    return known


def _known(row: dict[str, Any]) -> Known:
    columns: dict[str, Any] = {column: row.get(column) for column in _COLUMNS}
    return Known(**columns)


def _see(known: dict[str, Known], seen: dict[str, Any]) -> None:
    log = seen["log"]
    if log in known:
        known[log] = replace(known[log], look=seen.get("look"))
