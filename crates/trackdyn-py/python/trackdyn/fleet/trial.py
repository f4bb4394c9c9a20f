"""The program ``python -m trackdyn.fleet.trial``."""

from __future__ import annotations

import argparse
import sys

from ._program import Parser, add_workers, ended, executor_of, progress_of
from ._trial import run_trial

_PROGRAM = "trackdyn.fleet.trial"

_ABOUT = """Diagnose the cases of a blind trial on many workers, as `trackdyn trial run` does on one.

Cases that are done are not run again. Ctrl-C keeps what is done. Then: `trackdyn trial score`."""


def main(arguments: list[str] | None = None) -> int:
    """Run the program; its exit status: 0 done, 1 bad input, 130 interrupted."""
    given = _parser().parse_args(arguments)

    def work() -> None:
        outcome = run_trial(
            given.trial,
            program=given.program,
            name=given.name,
            limit=given.limit,
            retry=given.retry,
            executor=executor_of(_PROGRAM, given.scheduler, given.workers),
            workers=given.workers,
            progress=progress_of(_PROGRAM, "cases"),
        )
        print(f"{outcome.trial}: {outcome}")
        for case, reason in sorted(outcome.failed.items()):
            print(f"{case}: {reason}")

    return ended(_PROGRAM, f"{given.trial} has what was done", {"trial"}, work)


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog=_PROGRAM,
        allow_abbrev=False,
        description=_ABOUT,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("trial", metavar="TRIAL", help="folder of the trial, which all workers see")
    add("--program", metavar="PROGRAM", help="as of `trackdyn trial run` [default: its own]")
    add("--name", metavar="NAME", help="name under which diagnoses are kept")
    add(
        "--limit",
        type=int,
        default=3600,
        metavar="SECONDS",
        help="time that a case may take [default: %(default)d]",
    )
    add("--retry", action="store_true", help="run cases again whose process failed")
    add_workers(parser)
    return parser


if __name__ == "__main__":
    sys.exit(main())
