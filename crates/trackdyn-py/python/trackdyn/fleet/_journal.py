"""Rows that are made but not yet in the table: appended one by one, so that an end loses none."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

from .._errors import InputError, OutputError


class Journal:
    """The file ``<out>.journal``, which also keeps others from the table while this process has it.

    Raises
    ------
    OutputError
        Where it cannot be written, or another process has it.
    """

    def __init__(self, out: Path) -> None:
        self.path = out.with_name(f"{out.name}.journal")
        self._out = out
        self._file = self._opened()
        #: Place of the latest row of each log.
        self._places: dict[str, int] = {}
        self._recover()

    def __len__(self) -> int:
        return len(self._places)

    def append(self, row: dict[str, Any] | None, timing: dict[str, Any]) -> None:
        """Keep a row with what it took; None: the row of the table holds."""
        self._places[timing["log"]] = self._file.seek(0, os.SEEK_END)
        self._file.write(json.dumps([row, timing]).encode() + b"\n")
        self._file.flush()

    def rows(self) -> Iterator[tuple[dict[str, Any] | None, dict[str, Any]]]:
        """The latest row of each log, in the order of the logs."""
        for log in sorted(self._places):
            self._file.seek(self._places[log])
            row, timing = json.loads(self._file.readline())
            yield row, timing

    def close(self, is_in_table: bool) -> None:
        """Let others to the table, and remove the journal where all of its rows are in there."""
        is_in_table = is_in_table or not self._places
        # who opened it meanwhile sees that its name is gone; Windows removes no open file
        if is_in_table and os.name != "nt":
            self.path.unlink(missing_ok=True)
        self._file.close()
        if is_in_table:
            self.path.unlink(missing_ok=True)

    def _opened(self) -> IO[bytes]:
        while True:
            try:
                file = self.path.open("a+b")
            except OSError as error:
                raise OutputError(f"{self.path}: cannot be written: {error.strerror}") from None
            try:
                is_ours = _is_locked(file)
            except OSError as error:
                raise OutputError(f"{self.path}: cannot be locked: {error.strerror}") from None
            if not is_ours:
                file.close()
                raise OutputError(
                    f"{self._out}: another process writes it: expected one at a time; wait for it, "
                    "or choose another out"
                )
            try:
                if os.path.samestat(os.fstat(file.fileno()), self.path.stat()):
                    return file
            except FileNotFoundError:
                pass
            # its owner ended it between our open and our lock
            file.close()

    def _recover(self) -> None:
        """Find the rows of a process that was ended, and drop a line that it did not finish."""
        self._file.seek(0)
        end = 0
        for line in iter(self._file.readline, b""):
            if not line.endswith(b"\n"):
                self._file.truncate(end)
                break
            try:
                _, timing = json.loads(line)
                self._places[timing["log"]] = end
            except (ValueError, TypeError, KeyError):
                expected = "expected rows of a fleet; remove it to go on without"
                raise InputError(f"{self.path}: byte {end}: not a row: {expected}") from None
            end += len(line)


def _is_locked(file: IO[bytes]) -> bool:
    """Lock a file until it is closed or the process ends; False: another process has it."""
    try:
        import fcntl
    except ImportError:
        return _is_locked_on_windows(file)
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _is_locked_on_windows(file: IO[bytes]) -> bool:
    import importlib

    msvcrt: Any = importlib.import_module("msvcrt")
    # a byte far behind the rows: locked bytes cannot be read
    file.seek(2**40)
    try:
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
    except OSError:
        return False
    return True
