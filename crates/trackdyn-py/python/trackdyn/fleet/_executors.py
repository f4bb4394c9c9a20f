"""Who makes the rows: threads of this machine, or workers of Dask."""

from __future__ import annotations

import logging
import os
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import Any

from .._errors import SettingError
from . import _guard, _preload

#: Time within which the scheduler of a cluster has to answer, s.
CONNECT_S = 10.0


def processors() -> int:
    """Processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@contextmanager
def threads(workers: int | None) -> Iterator[Executor]:
    """Threads of this process, each of which has a process that makes its rows.

    So a process that ends breaks no pool, as it would break a ``ProcessPoolExecutor``.
    """
    executor = ThreadPoolExecutor(workers or processors())
    try:
        yield executor
    except BaseException:
        executor.shutdown(wait=False, cancel_futures=True)
        _guard.stop()
        raise
    finally:
        executor.shutdown()


def entered(
    executor: Executor | AbstractContextManager[Executor] | None, workers: int | None
) -> AbstractContextManager[Executor]:
    """The executor that is given, or threads."""
    if executor is None:
        return threads(workers)
    # one that is given is its owner's to shut down
    given: Any = executor
    return nullcontext(given) if hasattr(given, "submit") else given


def has_dask() -> bool:
    """Whether workers of Dask can be had."""
    try:
        import distributed  # noqa: F401
    except ImportError:
        return False
    return True


@contextmanager
def dask(scheduler: str | None, workers: int | None) -> Iterator[Executor]:
    """Workers of a Dask cluster: the one at an address, or one on this machine.

    Raises
    ------
    SettingError
        Where no scheduler answers.
    """
    from distributed import Client, LocalCluster

    if scheduler is not None:
        try:
            client = Client(scheduler, timeout=CONNECT_S)
        except (OSError, ValueError) as error:
            reason = f"no scheduler of Dask answers: {error}"
            raise SettingError(f"scheduler {scheduler}: {reason}", "scheduler") from None
        with client:
            # a log is made whenever it is asked for, even where an equal job was done
            yield client.get_executor(pure=False)
        return
    # each worker waits for a process that it started, which is what has the memory
    cluster = LocalCluster(
        n_workers=workers or processors(),
        threads_per_worker=1,
        memory_limit=None,
        dashboard_address="127.0.0.1:0",
        silence_logs=logging.CRITICAL,
        preload=[_preload.__name__],
    )
    with cluster, Client(cluster) as client:
        yield client.get_executor(pure=False)
