"""The program ``python -m trackdyn.fleet``."""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any, NoReturn

from .._errors import Error, SettingError
from . import _executors
from ._reading_options import add_options, option_of, reading_of
from ._run import run

#: Time between two lines of progress where there is no bar, s.
_LINE_S = 10.0

_ABOUT = """Identify and diagnose every log of a fleet: one row a log, errors too.

The table is continued where it is there: rows are made again only where their log, the vehicle, the
options or the version of trackdyn changed. Ctrl-C keeps the rows that are done."""


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.exit(1, f"{self.prog}: {message}\n")


def main(arguments: list[str] | None = None) -> int:
    """Run the program; its exit status: 0 done, 1 bad input, 130 interrupted."""
    given = _parser().parse_args(arguments)
    try:
        outcome = run(
            given.logs,
            given.vehicle,
            given.out,
            robot=given.robot,
            time=given.time,
            diagnose=_diagnose(given),
            identify={"gyroscope": True} if given.gyroscope else None,
            executor=_executor(given),
            workers=given.workers,
            timeout=given.timeout,
            memory=None if given.memory is None else given.memory * 1e9,
            retry=given.retry,
            progress=_progress(),
            **reading_of(given),
        )
    except KeyboardInterrupt:
        _say(f"interrupted: {given.out} has the rows that were done; run again to go on")
        return 130
    except Error as error:
        _say(_worded(error))
        return 1
    print(f"{outcome.path}: {outcome}")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="trackdyn.fleet",
        allow_abbrev=False,
        description=_ABOUT,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("logs", nargs="+", metavar="LOG", help='logs, or patterns such as "logs/**/*.mcap"')
    add(
        "--vehicle",
        required=True,
        metavar="FILE|NAME",
        help="vehicle of all robots; {robot} in it stands for the name of each",
    )
    add("--out", default="results.parquet", metavar="FILE", help="table [default: %(default)s]")
    add(
        "--robot",
        metavar="REGEX",
        help=r"whose a log is, such as '(?P<robot>robot\d+)', and if wanted (?P<time>...) "
        "[default: the folder that it lies in]",
    )
    add(
        "--time-format",
        dest="time",
        metavar="FORMAT",
        help="format of (?P<time>...), such as %%Y%%m%%d-%%H%%M [default: ISO 8601]; without the "
        "group, the first stamp of the log is its time",
    )
    add("--no-diagnose", action="store_true", help="ICRs alone, in a hundredth of the time")
    add("--settings", metavar="FILE", help="settings of the diagnosis")
    add("--gyroscope", action="store_true", help="correct the yaw of poses by the gyroscope")
    add("--scheduler", metavar="ADDRESS", help="Dask cluster [default: one on this machine]")
    add("--workers", type=int, metavar="N", help="workers on this machine [default: processors]")
    add(
        "--timeout",
        type=float,
        default=3600.0,
        metavar="SECONDS",
        help="time that a log may take [default: %(default)g]",
    )
    add("--memory", type=float, metavar="GB", help="memory that a log may take [default: any]")
    add("--retry", action="store_true", help="make rows again that are not ok")
    add_options(parser)
    return parser


def _diagnose(given: argparse.Namespace) -> Any:
    if given.no_diagnose and given.settings is not None:
        raise SettingError("settings: expected without --no-diagnose", "settings")
    if given.no_diagnose:
        return False
    keywords: dict[str, Any] = {}
    if given.settings is not None:
        keywords["settings"] = given.settings
    if given.gyroscope:
        keywords["gyroscope"] = True
    return keywords or True


def _executor(given: argparse.Namespace) -> Any:
    """Workers of Dask, or None: threads, where Dask is not installed."""
    if given.scheduler is not None and given.workers is not None:
        raise SettingError("workers: a scheduler has its own: expected one of both", "workers")
    if _executors.has_dask():
        return _executors.dask(given.scheduler, given.workers)
    if given.scheduler is not None:
        how = "Dask is not installed: pip install trackdyn[fleet]"
        raise SettingError(f"scheduler {given.scheduler}: {how}", "scheduler")
    _say("Dask is not installed, so threads start the work: pip install trackdyn[fleet]")
    return None


def _progress() -> Any:
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
            _say(f"{done} of {total} logs, {stage}")

    return tell


def _worded(error: Error) -> str:
    """A message that begins with a setting names the option for it."""
    text, setting = str(error), error.setting
    # the logs have no option
    if setting is None or setting == "logs" or not text.startswith(setting):
        return text
    option = "--time-format" if setting == "time" else option_of(setting)
    return option + text[len(setting) :]


def _say(text: str) -> None:
    print(f"trackdyn.fleet: {text}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
