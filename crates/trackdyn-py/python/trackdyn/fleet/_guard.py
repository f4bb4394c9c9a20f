"""What a worker does: it has a process of its own make the row, and outlives that process."""

from __future__ import annotations

import json
import math
import os
import queue
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import weakref
from typing import IO, Any

#: Logs after which a process is replaced, so that what its memory lost in holes comes back.
LOGS_OF_A_PROCESS = 100

#: Times that a log may end its process: one may be the machine's fault, two are the log's.
MAX_CRASHES = 2

#: Time that a process has to start, s: no log is blamed for it.
START_S = 120.0

#: Time that a process whose answers ended has to end as well, s.
END_S = 5.0

_CODE = """
import sys
sys.path[:] = {path!r}
from trackdyn.fleet import _child
_child.serve({memory})
"""

_here = threading.local()
_all: weakref.WeakSet[_Process] = weakref.WeakSet()


class Stopped(Exception):
    """A row that nobody waits for any more."""


class NotStarted(Exception):
    """A process that ended before it had a log, which is no log's fault."""


def make(job: dict[str, Any]) -> dict[str, Any]:
    """The row of a job, what it took, and whether it is the row that is there already.

    Raises for no log: one that ends or outlasts its process has a row that says so.

    Raises
    ------
    NotStarted
        Where no process can be had.
    """
    begin = time.monotonic()
    for attempt in range(1, MAX_CRASHES + 1):
        try:
            said = _process(job["memory"]).ask(job)
        except NotStarted:
            if attempt == MAX_CRASHES:
                raise
            continue
        if said["row"].get("status") != "crashed":
            break
    timing = {"log": job["log"], **said.get("look", {})}
    timing.update({f"{stage}_s": seconds for stage, seconds in said.get("seconds", {}).items()})
    timing.update(total_s=time.monotonic() - begin, attempts=attempt, host=socket.gethostname())
    return {"row": said["row"], "timing": timing, "is_same": said.get("is_same", False)}


def stop() -> None:
    """End all processes that make rows for this one."""
    for process in list(_all):
        process.is_stopped = True
        process.end()


def _process(memory: int | None) -> _Process:
    """The process of this thread."""
    process: _Process | None = getattr(_here, "process", None)
    # one of before a fork is the parent's
    if process is not None and process.parent != os.getpid():
        process = None
    if process is None or not process.is_ready or process.memory != memory:
        if process is not None:
            process.end()
        process = _here.process = _Process(memory)
        _all.add(process)
    return process


class _Process:
    """A process that makes rows."""

    def __init__(self, memory: int | None) -> None:
        self.memory = memory
        self.parent = os.getpid()
        self.is_stopped = False
        self._left = LOGS_OF_A_PROCESS
        self._words = tempfile.TemporaryFile()
        self._inner = subprocess.Popen(
            [sys.executable, "-c", _CODE.format(path=sys.path, memory=memory)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._words,
            env=_environment(),
            # Ctrl-C is the parent's
            start_new_session=True,
        )
        self._answers: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        threading.Thread(
            target=_listen, args=(self._inner.stdout, self._answers), daemon=True
        ).start()
        # a thread that ends leaves no process behind
        self._finalizer = weakref.finalize(self, _end, self._inner)
        self._words_before = 0
        self._is_started = False

    @property
    def is_ready(self) -> bool:
        """Whether it can take a job."""
        return self._left > 0 and self._inner.poll() is None

    def end(self) -> None:
        """End it, whatever it does."""
        self._left = 0
        self._finalizer()

    def ask(self, job: dict[str, Any]) -> dict[str, Any]:
        """What it says of a job until that is done, its time is over, or the process ended."""
        self._left -= 1
        self._words_before = os.fstat(self._words.fileno()).st_size
        deadline = time.monotonic() + (job["timeout"] if self._is_started else START_S)
        said: dict[str, Any] = {"row": {"stage": "start"}}
        try:
            assert self._inner.stdin is not None
            self._inner.stdin.write(json.dumps(job).encode() + b"\n")
            self._inner.stdin.flush()
        # it ended in between, and its answers end as well
        except OSError:
            pass
        while not said.get("done"):
            try:
                line = self._answers.get(timeout=max(deadline - time.monotonic(), 0.0))
            except queue.Empty:
                self.end()
                if not self._is_started:
                    raise NotStarted(f"no process started within {START_S:g} s") from None
                text = f"{said['row']['stage']}: not done after {job['timeout']:g} s"
                said["row"].update(status="timed out", error=text)
                return said
            if not line:
                text = f"its process {self._last_words()}"
                if not self._is_started:
                    raise NotStarted(text)
                said["row"].update(status="crashed", error=f"{said['row']['stage']}: {text}")
                return said
            said = json.loads(line)
            if "needs" in said:
                return {"row": self._too_little(said["needs"])}
            if not self._is_started:
                self._is_started = True
                deadline = time.monotonic() + job["timeout"]
        return said

    def _too_little(self, needs: int) -> dict[str, Any]:
        """The row that says that no log can be made in this memory."""
        self.end()
        gb = math.ceil(needs / 1e7) / 100.0
        error = f"memory {self.memory}: expected {needs} bytes ({gb:g} GB) or more, to begin with"
        return {"status": "error", "error_kind": "SettingError", "error": error}

    def _last_words(self) -> str:
        """How it ended, and the first line that it wrote of this log."""
        try:
            self._inner.wait(END_S)
        except subprocess.TimeoutExpired:
            pass
        self.end()
        if self.is_stopped:
            raise Stopped("stopped")
        code = self._inner.returncode
        how = "closed its answers" if code is None else f"ended with {code}"
        if code is not None and code < 0:
            how = f"ended by {signal.Signals(-code).name}"
        self._words.seek(self._words_before)
        lines = self._words.read().decode(errors="replace").strip().splitlines()
        # an exception of Python stands last
        line = lines[-1 if lines[0].startswith("Traceback") else 0] if lines else ""
        return f"{how}: {line}" if line else how


def _listen(stream: IO[bytes], answers: queue.SimpleQueue[bytes]) -> None:
    for line in stream:
        # a line that the end of the process cut is none
        if line.endswith(b"\n"):
            answers.put(line)
    answers.put(b"")


def _end(process: subprocess.Popen[bytes]) -> None:
    if process.poll() is None:
        process.kill()
    try:
        process.wait(END_S)
    # it waits for a disk, and nothing ends it before that answers
    except subprocess.TimeoutExpired:
        pass
    if process.stdin is not None:
        try:
            process.stdin.close()
        except OSError:
            pass


def _environment() -> dict[str, str]:
    """One thread for a log: workers are what runs side by side."""
    one = {"RAYON_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    return {**one, **os.environ, "RUST_BACKTRACE": "0"}
