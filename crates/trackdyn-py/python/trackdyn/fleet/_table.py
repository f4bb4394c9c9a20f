"""The table of a fleet: one row a log, sorted by log; and beside it what each row took.

Same logs, vehicle, options and version: same bytes, whoever made the rows. So what depends on the
machine stands in a file of its own.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any

from .._errors import InputError, OutputError

#: Marks the files that this package wrote.
SCHEMA = b"trackdyn.fleet/1"

#: Rows that are turned into columns at once.
_BATCH = 1000


def schema() -> Any:
    """Columns of the table. Units stand in the names; ICRs have the axes of the paper."""
    import pyarrow as pa

    text, number, whole = pa.string(), pa.float64(), pa.int64()
    size = {"name": text, "value": number, "low": number, "high": number, "unit": text}
    claim = {"effect": text, "one_of": pa.list_(text), "kind": text, "p": number}
    claim |= {"ln_bayes_factor": number, "held_out_gain": number}
    claim["sizes"] = pa.list_(pa.struct(size))
    refusal = {"one_of": pa.list_(text), "reason": text}
    instant = pa.timestamp("ns", tz="UTC")
    columns = {
        "log": text,
        "robot": text,
        # as it was named, else that of the first stamp
        "time": instant,
        "first_stamp": instant,
        # ok, error, timed out, crashed; and where that was
        "status": text,
        "stage": text,
        "error_kind": text,
        "error": text,
        "runs": whole,
        "duration_s": number,
        "x_l_m": number,
        "x_r_m": number,
        "y_m": number,
        # of x_l, x_r, y, row by row; not of a fixed size, which some versions of Arrow do not read
        "covariance_m2": pa.list_(number),
        "gauge_m": number,
        "chi": number,
        "chi_se": number,
        # null: none was asked for or reached
        "diagnosis": text,
        "claims": pa.list_(pa.struct(claim)),
        "refusals": pa.list_(pa.struct(refusal)),
        "warnings": pa.list_(text),
        # of the recording that was read, and of the bytes of the log
        "fingerprint": text,
        "sha256": text,
        "vehicle": text,
        "options": text,
        "version": text,
    }
    return pa.schema(list(columns.items()), metadata={b"schema": SCHEMA})


def timing_schema() -> Any:
    """Columns of the file beside the table."""
    import pyarrow as pa

    stages = ("fingerprint", "read", "identify", "diagnose", "total")
    columns = {"log": pa.string(), "size_bytes": pa.int64(), "look": pa.string()}
    columns |= {f"{stage}_s": pa.float64() for stage in stages}
    columns |= {"attempts": pa.int64(), "host": pa.string()}
    return pa.schema(list(columns.items()), metadata={b"schema": SCHEMA})


def beside(out: Path) -> Path:
    """The file of what each row took."""
    return out.with_name(f"{out.stem}.timings{out.suffix}")


def read(path: Path, columns: list[str] | None = None) -> Any:
    """A table that this package wrote; None where there is none.

    Raises
    ------
    InputError
        For a file of something else.
    """
    import pyarrow as pa
    from pyarrow import parquet

    if not path.exists():
        return None
    try:
        marked = (parquet.read_schema(path).metadata or {}).get(b"schema")
        if marked == SCHEMA:
            return parquet.read_table(path, columns=columns)
    except (OSError, pa.ArrowInvalid) as error:
        raise InputError(f"{path}: not a table of a fleet: {error}") from None
    found = marked.decode() if marked else "no schema"
    raise InputError(f"{path}: not a table of a fleet: {found}: expected {SCHEMA.decode()}")


def write(path: Path, schema: Any, rows: Iterable[dict[str, Any]], kept: Any) -> None:
    """Write rows of their own and those of another table that none of them replaces.

    The file is there at once or not at all.
    """
    import pyarrow as pa
    import pyarrow.compute as pc
    from pyarrow import parquet

    parts = [pa.Table.from_pylist(some, schema=schema) for some in _batches(rows)]
    made = pa.concat_tables(parts) if parts else schema.empty_table()
    if kept is not None:
        is_replaced = pc.is_in(kept["log"], value_set=made["log"].combine_chunks())
        made = pa.concat_tables([kept.cast(schema).filter(pc.invert(is_replaced)), made])
    made = made.take(pc.sort_indices(made, [("log", "ascending")])).combine_chunks()
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        parquet.write_table(made.replace_schema_metadata(schema.metadata), temporary)
        os.replace(temporary, path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from None


def _batches(rows: Iterable[dict[str, Any]]) -> Iterator[list[dict[str, Any]]]:
    iterator = iter(rows)
    while some := list(islice(iterator, _BATCH)):
        yield some
