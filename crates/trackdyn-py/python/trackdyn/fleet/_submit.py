"""Jobs to an executor and results back, with a bounded number on the way."""

from __future__ import annotations

import queue
from collections.abc import Callable, Generator, Iterable
from concurrent.futures import CancelledError, Executor, Future
from typing import Any

from .._errors import ResultError

#: Jobs that an executor has at a time: enough for any cluster, and no memory for a million logs.
IN_FLIGHT = 1000

#: Time between two looks at Ctrl-C, which Windows does not hear while it waits, s.
_LOOK_S = 1.0

class Lost(Exception):
    """Several workers were lost while they had a job: the fault is the job's."""


_Result = tuple[dict[str, Any], "Future[dict[str, Any]]"]


def results(
    executor: Executor,
    jobs: Iterable[dict[str, Any]],
    work: Callable[[dict[str, Any]], dict[str, Any]],
) -> Generator[_Result, None, None]:
    """Each job with the future of its work when that is done, in the order of their ends.

    Jobs that have not begun are cancelled where the caller ends early.
    """
    done: queue.SimpleQueue[Future[dict[str, Any]]] = queue.SimpleQueue()
    waiting: dict[Future[dict[str, Any]], dict[str, Any]] = {}
    try:
        for job in jobs:
            future = executor.submit(work, job)
            waiting[future] = job
            future.add_done_callback(done.put)
            while len(waiting) >= IN_FLIGHT or not done.empty():
                future = _next(done)
                yield waiting.pop(future), future
        while waiting:
            future = _next(done)
            yield waiting.pop(future), future
    finally:
        for future in waiting:
            future.cancel()


def _next(done: queue.SimpleQueue[Future[dict[str, Any]]]) -> Future[dict[str, Any]]:
    while True:
        try:
            return done.get(timeout=_LOOK_S)
        except queue.Empty:
            continue


def made(of: str, future: Future[dict[str, Any]]) -> dict[str, Any]:
    """What a worker made of a job, which is `of` something.

    Raises
    ------
    Lost
        Where several workers ended while they had this job.
    ResultError
        For an executor that broke.
    """
    try:
        return future.result()
    except (CancelledError, Exception) as error:
        kind = type(error).__name__
        if kind == "KilledWorker":  # of Dask
            raise Lost(f"several workers were lost: {str(error).splitlines()[0]}") from None
        raise ResultError(
            f"{of}: the executor broke: {kind}: {error}: what was done is kept; run again to go on"
        ) from error
