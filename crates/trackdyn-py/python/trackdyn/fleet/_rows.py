"""Rows of a table for its trends, and those of them that do not count."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from .. import _values
from .._errors import InputError
from . import _table

_COLUMNS = ("log", "robot", "time", "chi", "chi_se", "diagnosis", "claims")


def rows_of(table: Any) -> Any:
    """The rows of a table, with whole ns beside their times.

    Raises
    ------
    InputError
        For a table that is not there, or not one of a fleet.
    """
    import pandas

    if isinstance(table, (str, os.PathLike)):
        read = _table.read(Path(table), list(_COLUMNS))
        if read is None:
            raise InputError(f"{table}: no such file: expected a table of trackdyn.fleet")
        rows = read.to_pandas()
    elif isinstance(table, pandas.DataFrame):
        rows = table.copy()
    else:
        raise _values.refused("table", table, "the path of a table, or a frame of pandas")
    missing = ", ".join(name for name in _COLUMNS if name not in rows.columns)
    if missing:
        raise InputError(f"table: no column {missing}: expected those of a table of a fleet")
    rows["time"] = pandas.to_datetime(rows["time"], utc=True).astype("datetime64[ns, UTC]")
    rows["ns"] = rows["time"].astype("int64")
    return rows


def left_out(rows: Any) -> list[str]:
    """What does not count, and why."""
    notes = []
    without = int((~rows["chi_se"].gt(0.0)).sum())
    if without:
        notes.append(f"{without} of {len(rows)} logs have no ICRs")
    undated = int((rows["chi_se"].gt(0.0) & rows["time"].isna()).sum())
    if undated:
        how = "give them by time"
        notes.append(f"{undated} of {len(rows)} logs have stamps that are no dates: {how}")
    return notes


def name_of(table: Any) -> str:
    """What errors call a table."""
    return os.fspath(table) if isinstance(table, (str, os.PathLike)) else "table"
