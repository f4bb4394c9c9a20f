"""The program ``python -m trackdyn.fleet``."""

from __future__ import annotations

import argparse
import math
import sys
from typing import Any

from .._errors import SettingError
from ._program import Parser, add_workers, ended, executor_of, progress_of
from ._reading_options import add_options, reading_of
from ._run import run

_PROGRAM = "trackdyn.fleet"

_ABOUT = """Identify and diagnose every log of a fleet: one row a log, errors too.

The table is continued where it is there: rows are made again only where their log, the vehicle, the
options or the version of trackdyn changed. Ctrl-C keeps the rows that are done."""


def main(arguments: list[str] | None = None) -> int:
    """Run the program; its exit status: 0 done, 1 bad input, 130 interrupted."""
    given = _parser().parse_args(arguments)

    def work() -> None:
        outcome = run(
            given.logs,
            given.vehicle,
            given.out,
            robot=given.robot,
            time=given.time,
            diagnose=_diagnose(given),
            identify={"gyroscope": True} if given.gyroscope else None,
            executor=executor_of(_PROGRAM, given.scheduler, given.workers),
            workers=given.workers,
            timeout=given.timeout,
            memory=_bytes(given.memory),
            retry=given.retry,
            progress=progress_of(_PROGRAM, "logs"),
            **reading_of(given),
        )
        print(f"{outcome.path}: {outcome}")

    return ended(_PROGRAM, f"{given.out} has the rows that were done", {"logs"}, work)


def _bytes(memory: float | None) -> float | None:
    """Memory in bytes of GB."""
    if memory is not None and not 0.0 < memory < math.inf:
        raise SettingError(f"memory {memory:g}: expected GB above zero", "memory")
    return None if memory is None else memory * 1e9


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog=_PROGRAM,
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
    add_workers(parser)
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


if __name__ == "__main__":
    sys.exit(main())
