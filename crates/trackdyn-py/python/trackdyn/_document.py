"""What is a file: vehicles and parameters."""

from __future__ import annotations

import os
from typing import Any

from . import _trackdyn, _values


class Document:
    """A file of the library, whose text says all that it is."""

    __slots__ = ()
    _inner: _trackdyn.Vehicle | _trackdyn.Parameters

    def to_dict(self) -> dict[str, Any]:
        """What the file says."""
        return _trackdyn.from_toml(self._inner.toml)

    def to_toml(self) -> str:
        """The text of the file."""
        return self._inner.toml

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the file.

        Parameters
        ----------
        path : str or path
            Where it goes.
        """
        self._inner.write(_values.path("path", path))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return NotImplemented
        return self._inner.toml == other._inner.toml

    def __hash__(self) -> int:
        return hash(self._inner.toml)
