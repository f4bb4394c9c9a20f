"""A blind trial over an executor: each case is run once, whatever happens to the others."""

import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from fleets import Inline, status_of

import trackdyn as td
from trackdyn.fleet import _executors
from trackdyn.fleet.trial import main

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="programs are scripts of a shell")

CASES = 5


@pytest.fixture
def trial(tmp_path, diagnosis, drive, robot):
    """A trial, and a program in place of the diagnosis, which fails on a case."""
    folder = tmp_path / "trial"
    for place in range(1, CASES + 1):
        case = folder / f"case-{place:04}"
        drive.write(case / "recording")
        (case / "vehicle.toml").write_text(robot.to_toml())
    (case / "recording" / "unlucky").touch()
    (folder / "commitment.txt").write_text(f'answers_sha256 = "{"0" * 64}"\n')
    (folder / "no-case.txt").touch()
    answer = tmp_path / "answer.toml"
    answer.write_text(diagnosis.to_toml())
    calls = tmp_path / "calls"
    script = (
        "#!/bin/sh\n"
        f"echo $RAYON_NUM_THREADS >> {calls}\n"
        "[ -e recording/unlucky ] && echo out of luck >&2 && exit 3\n"
        f'while [ $# -gt 1 ]; do [ "$1" = --out ] && cp {answer} "$2/diagnosis.toml"; shift; done\n'
    )
    program = tmp_path / "canned"
    program.write_text(script)
    program.chmod(0o755)
    return folder


def calls(trial: Path) -> list[str]:
    return (trial.parent / "calls").read_text().split()


def test_each_case_is_run_once(trial):
    program = trial.parent / "canned"
    told = []
    outcome = td.fleet.run_trial(
        trial, program=program, workers=2, progress=lambda *of: told.append(of)
    )
    assert (outcome.cases, outcome.diagnosed, outcome.kept) == (CASES, CASES - 1, 0)
    assert list(outcome.failed) == [f"case-{CASES:04}"]
    assert "ended with" in outcome.failed[f"case-{CASES:04}"]
    assert told[-1] == ("1 failed", CASES, CASES)
    # side by side, a case has one processor
    assert calls(trial) == ["1"] * CASES
    again = td.fleet.run_trial(trial, program=program, executor=ThreadPoolExecutor(1))
    assert (again.kept, again.diagnosed, again.failed) == (CASES, 0, {})
    assert len(calls(trial)) == CASES
    (trial / f"case-{CASES:04}" / "recording" / "unlucky").unlink()
    retried = td.fleet.run_trial(trial, program=program, retry=True, workers=1)
    assert (retried.kept, retried.diagnosed) == (CASES - 1, 1)
    assert len(calls(trial)) == CASES + 1


def test_workers_of_dask_run_them(trial, capsys):
    pytest.importorskip("distributed")
    assert main([str(trial), "--program", str(trial.parent / "canned"), "--workers", "2"]) == 0
    said = capsys.readouterr().out
    assert f"{CASES} of {CASES} cases are done: 0 were there, {CASES - 1} diagnosed" in said
    assert f"case-{CASES:04}: the process ended with" in said
    assert len(calls(trial)) == CASES


def test_an_interrupt_ends_what_runs(trial):
    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    # the unlucky one is told first: all others hang
    program = trial.parent / "some-hang"
    program.write_text("#!/bin/sh\n[ -e recording/unlucky ] && exit 3\nexec sleep 60\n")
    program.chmod(0o755)
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        td.fleet.run_trial(trial, program=program, workers=CASES, progress=stop)
    assert time.monotonic() - started < 30.0
    assert not list(trial.glob("case-*/some-hang/diagnosis.toml"))


def test_an_executor_that_breaks_keeps_what_was_done(trial):
    program = trial.parent / "canned"
    with pytest.raises(td.Error, match="case-0003: the executor broke: OSError: no worker is left"):
        td.fleet.run_trial(trial, program=program, executor=Inline(after=2))
    outcome = td.fleet.run_trial(trial, program=program, executor=Inline())
    assert (outcome.kept, outcome.diagnosed) == (2, CASES - 3)

    # of Dask: several workers were lost with this case
    class KilledWorker(Exception):
        pass

    def lost(result):
        raise KilledWorker("Attempted to run task '_case' on 4 different workers")

    outcome = td.fleet.run_trial(trial, program=program, executor=Inline(lost))
    assert len(outcome.failed) == CASES and outcome.done == CASES
    assert all("several workers were lost" in reason for reason in outcome.failed.values())


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["nowhere"], "nowhere: no cases: expected the folder of a trial"),
        (["TRIAL", "--limit", "0"], "--limit 0: expected seconds above zero"),
        (["TRIAL", "--workers", "0"], "--workers 0: expected 1 or more"),
        (["TRIAL", "--program", "none"], "none: cannot be run"),
        (["TRIAL", "--name", "a/b"], "a/b"),
        (["TRIAL", "--bogus"], "--bogus"),
    ],
)
def test_bad_input_is_refused(trial, monkeypatch, capsys, words, message):
    monkeypatch.setattr(_executors, "has_dask", lambda: False)
    words = [str(trial) if word == "TRIAL" else word for word in words]
    status = status_of(main, words)
    said = capsys.readouterr().err
    assert status == 1 and message in said and "Traceback" not in said, said
