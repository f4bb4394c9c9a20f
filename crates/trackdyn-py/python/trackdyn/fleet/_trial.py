"""Cases of a blind trial, diagnosed by an executor.

Each case is a process of ``trackdyn trial run`` on the worker, which lets the diagnosis see nothing
of the trial, bounds its time and keeps what it wrote. So cases that are done stay done, and results
are those of one machine.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sysconfig
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import AbstractContextManager, closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .. import _values
from .._arguments import Progress, told
from .._errors import ResultError, SettingError
from ._executors import entered
from ._submit import Lost, made, results

#: What the program says when it has ended.
_SAID = re.compile(r": \d+ cases: (\d+) diagnosed now, (\d+) failed, (\d+) before")

#: What it says of a case that failed.
_REASON = re.compile(r"^(case-\w+): (.*)$", re.MULTILINE)

#: Programs that this process has started.
_RUNNING: set[subprocess.Popen[str]] = set()


@dataclass
class TrialOutcome:
    """What a run over a trial did.

    Attributes
    ----------
    trial : Path
        Its folder.
    cases : int
        Its cases.
    kept : int
        Cases that were done before.
    diagnosed : int
        Cases that were diagnosed.
    failed : dict of str
        Cases whose process failed, with the reason in a line.
    """

    trial: Path
    cases: int = 0
    kept: int = 0
    diagnosed: int = 0
    failed: dict[str, str] = field(default_factory=dict)

    @property
    def done(self) -> int:
        """Cases that have a diagnosis or a failure."""
        return self.kept + self.diagnosed + len(self.failed)

    def __str__(self) -> str:
        return (
            f"{self.done} of {self.cases} cases are done: {self.kept} were there, "
            f"{self.diagnosed} diagnosed, {len(self.failed)} failed"
        )


def run_trial(
    trial: str | os.PathLike[str],
    *,
    program: str | os.PathLike[str] | None = None,
    name: str | None = None,
    limit: int = 3600,
    retry: bool = False,
    executor: Executor | AbstractContextManager[Executor] | None = None,
    workers: int | None = None,
    progress: bool | Progress | None = None,
) -> TrialOutcome:
    """Diagnose the cases of a blind trial, many at a time.

    Parameters
    ----------
    trial : str or path
        Folder that ``trackdyn trial make`` wrote. Workers must see it at the same absolute path.
    program : str or path, optional
        Program in place of ``trackdyn diagnose``, as for ``trackdyn trial run --program``.
    name : str, optional
        Name under which its diagnoses are kept. Default: that of the program's file.
    limit : int
        Time that a case may take, s.
    retry : bool
        Run cases again whose process failed.
    executor : concurrent.futures.Executor, optional
        Who runs them, as for :func:`trackdyn.fleet.run`. Default: threads.
    workers : int, optional
        Cases that run side by side where no executor is given. Default: one a processor.
    progress : bool or callable
        Show a bar (tqdm), or call with a word, finished cases and all cases.

    Returns
    -------
    TrialOutcome
        The diagnoses lie in the folder, where ``trackdyn trial score`` finds them.

    Notes
    -----
    A case has one thread unless the environment of the worker has ``RAYON_NUM_THREADS``. Cases that
    are done are not run again.

    Raises
    ------
    SettingError
        For an argument that is not accepted.
    ResultError
        Where a worker has no program, it cannot run a case, or the executor broke.
    """
    if _values.whole("limit", limit) < 1:
        raise SettingError(f"limit {limit}: expected seconds above zero", "limit")
    if workers is not None and _values.whole("workers", workers) < 1:
        raise SettingError(f"workers {workers}: expected 1 or more", "workers")
    folder = Path(_values.path("trial", trial))
    cases = _cases(folder)
    count = len(cases)
    if count == 0:
        expected = "no cases: expected the folder of a trial (trackdyn trial make)"
        raise SettingError(f"trial {folder}: {expected}", "trial")
    words = [str(folder.resolve()), "--limit", str(limit)]
    if program is not None:
        words += ["--program", str(Path(_values.path("program", program)).resolve())]
    if name is not None:
        words += ["--name", name]
    if retry:
        words.append("--retry")
    outcome = TrialOutcome(folder, count)
    jobs = (
        {"case": case, "words": [*words, "--shard", f"{place}/{count}"]}
        for place, case in enumerate(cases, 1)
    )
    with entered(executor, workers) as who, told(progress, "trial") as tell, _ended_early():
        with closing(results(who, jobs, _case)) as done:
            for job, future in done:
                try:
                    _count(outcome, made(job["case"], future))
                except Lost as lost:
                    outcome.failed[job["case"]] = str(lost)
                if tell is not None:
                    tell(f"{len(outcome.failed)} failed", outcome.done, outcome.cases)
    return outcome


@contextmanager
def _ended_early() -> Iterator[None]:
    """Where this ends early, the programs that threads wait for end, too."""
    try:
        yield
    except BaseException:
        for running in list(_RUNNING):
            running.terminate()
        raise


def _cases(folder: Path) -> list[str]:
    """Names of the cases, in the order in which the program numbers them."""
    return sorted(path.parent.name for path in folder.glob("case-*/recording"))


def _case(job: dict[str, Any]) -> dict[str, Any]:
    """Run a case: the work of a worker."""
    program = shutil.which("trackdyn", path=sysconfig.get_path("scripts"))
    program = program or shutil.which("trackdyn")
    if program is None:
        return {"said": "", "told": "no program trackdyn: the wheel of this package brings it"}
    environment = {"RAYON_NUM_THREADS": "1", **os.environ}
    words = [program, "trial", "run", *job["words"]]
    pipe, nothing = subprocess.PIPE, subprocess.DEVNULL
    running = subprocess.Popen(
        words, stdin=nothing, stdout=pipe, stderr=pipe, text=True, env=environment
    )
    _RUNNING.add(running)
    try:
        said, told_of = running.communicate()
    finally:
        _RUNNING.discard(running)
    return {"said": said, "told": told_of}


def _count(outcome: TrialOutcome, ended: dict[str, Any]) -> None:
    said = _SAID.search(ended["said"])
    if said is None:
        raise ResultError(f"{outcome.trial}: {ended['told'].strip()}")
    diagnosed, _, before = (int(count) for count in said.groups())
    outcome.diagnosed += diagnosed
    outcome.kept += before
    outcome.failed.update(_REASON.findall(ended["told"]))
