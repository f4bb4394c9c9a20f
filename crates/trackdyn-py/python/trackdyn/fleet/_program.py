"""What the programs of a fleet share: options of workers, progress, and words."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from typing import Any, NoReturn

from .._errors import Error, SettingError
from . import _executors
from ._reading_options import option_of

#: Time between two lines of progress where there is no bar, s.
_LINE_S = 10.0


class Parser(argparse.ArgumentParser):
    """A parser that ends with status 1 where the options are wrong."""

    def error(self, message: str) -> NoReturn:
        """Say what is wrong, and end."""
        self.exit(1, f"{self.prog}: {message}\n")


def add_workers(parser: argparse.ArgumentParser) -> None:
    """Add the options of :func:`executor_of`."""
    add = parser.add_argument
    add("--scheduler", metavar="ADDRESS", help="Dask cluster [default: one on this machine]")
    add("--workers", type=int, metavar="N", help="workers on this machine [default: processors]")


def ended(program: str, kept: str, arguments: set[str], work: Callable[[], None]) -> int:
    """Do the work of a program; its exit status: 0 done, 1 bad input, 130 interrupted.

    `kept` says what stays after an interrupt; `arguments` are settings without an option.
    """
    try:
        work()
    except KeyboardInterrupt:
        say(program, f"interrupted: {kept}; run again to go on")
        return 130
    except Error as error:
        say(program, worded(error, arguments))
        return 1
    return 0


def executor_of(program: str, scheduler: str | None, workers: int | None) -> Any:
    """Workers of Dask, or None: threads, where Dask is not installed.

    Raises
    ------
    SettingError
        For a scheduler beside workers of this machine, or without Dask.
    """
    if scheduler is not None and workers is not None:
        raise SettingError("workers: a scheduler has its own: expected one of both", "workers")
    if _executors.has_dask():
        return _executors.dask(scheduler, workers)
    if scheduler is not None:
        how = "Dask is not installed: pip install trackdyn[fleet]"
        raise SettingError(f"scheduler {scheduler}: {how}", "scheduler")
    say(program, "Dask is not installed, so threads start the work: pip install trackdyn[fleet]")
    return None


def progress_of(program: str, of: str) -> bool | Callable[[str, int, int], None]:
    """A bar, or a line now and then where tqdm is not installed or nobody looks."""
    try:
        import tqdm  # noqa: F401
    except ImportError:
        pass
    else:
        if sys.stderr.isatty():
            return True
    last = time.monotonic()

    def tell(stage: str, done: int, total: int) -> None:
        nonlocal last
        if done == total or time.monotonic() - last > _LINE_S:
            last = time.monotonic()
            say(program, f"{done} of {total} {of}, {stage}")

    return tell


def worded(error: Error, arguments: set[str]) -> str:
    """A message that begins with a setting names the option for it; arguments have none."""
    text, setting = str(error), error.setting
    if setting is None or setting in arguments or not text.startswith(setting):
        return text
    option = "--time-format" if setting == "time" else option_of(setting)
    return option + text[len(setting) :]


def say(program: str, text: str) -> None:
    """A line to the user, beside the result."""
    print(f"{program}: {text}", file=sys.stderr, flush=True)
