"""Tables: columns of numbers by name, as NumPy arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._trackdyn import arrow_stream

if TYPE_CHECKING:
    import pandas


class Table(dict[str, NDArray[Any]]):
    """Columns by name: one-dimensional arrays of one length, float64 or int64.

    A dict, so ``pandas.DataFrame(table)``, ``polars.DataFrame(table)`` and ``xarray`` take it; and
    what speaks Arrow takes it by the PyCapsule interface (``pyarrow.table(table)``). Arrays are
    contiguous and read-only; asking for a column again gives the same memory. The Arrow stream is
    a copy.
    """

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(next(iter(self.values()), ()))

    def to_array(self, *columns: str) -> NDArray[np.float64]:
        """These columns side by side, as a copy.

        Parameters
        ----------
        *columns : str
            Names of columns. None: all of them.

        Returns
        -------
        ndarray of shape (rows, columns)
        """
        for name in columns:
            if name not in self:
                raise KeyError(f"column {name!r}: expected one of {', '.join(self)}")
        chosen = [self[name] for name in columns or self]
        return np.column_stack(chosen) if chosen else np.empty((0, 0))

    def to_structured(self) -> NDArray[np.void]:
        """All columns as a structured array, as a copy."""
        kind = [(name, column.dtype) for name, column in self.items()]
        rows = np.empty(self.rows, dtype=kind)
        for name, column in self.items():
            rows[name] = column
        return rows

    def to_frame(self) -> pandas.DataFrame:
        """All columns as a frame of pandas, which has to be installed."""
        import pandas

        return pandas.DataFrame(dict(self))

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """All columns as a stream of Arrow with one batch. The schema asked for is not heeded."""
        return arrow_stream(dict(self))

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (dict(self),)

    def __repr__(self) -> str:
        return f"<Table of {self.rows} rows: {', '.join(self)}>"


def _restored(columns: dict[str, NDArray[Any]]) -> Table:
    """A table from a pickle: nobody writes to its columns, as to those of the library."""
    for column in columns.values():
        column.flags.writeable = False
    return Table(columns)
