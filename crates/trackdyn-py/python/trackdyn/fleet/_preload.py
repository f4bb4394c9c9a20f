"""What a worker of Dask on this machine loads first."""

from __future__ import annotations

import signal


def dask_setup(worker: object) -> None:
    """Leave Ctrl-C, which a terminal sends to all processes, to the one that has the table."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
