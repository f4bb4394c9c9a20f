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


def test_the_program_hands_over_to_dask(trial, program, monkeypatch):
    pytest.importorskip("distributed")
    words = ["trial", "run", trial, "--program", trial.parent / "canned"]
    done = program(*words, "--executor", "dask", "--workers", "2")
    assert f"{CASES} of {CASES} cases are done" in done.stdout, done.stderr
    assert "case-0005: " in done.stdout and len(calls(trial)) == CASES
    # what is not there is told, with what to do
    for options, said in [
        (["--executor", "dask", "--shard", "1/2"], "--shard: workers of Dask take all cases"),
        (["--workers", "2"], "--scheduler, --workers: expected with --executor dask"),
        (["--executor", "slurm"], "invalid value 'slurm' for '--executor"),
    ]:
        done = program(*words, *options)
        assert done.returncode == 1 and said in " ".join(done.stderr.split()), done.stderr


def test_where_python_or_the_package_is_missing_it_is_told(trial, program, monkeypatch, tmp_path):
    # a program that lies alone, as one that cargo built
    import shutil
    import subprocess

    alone = tmp_path / "bin"
    alone.mkdir()
    path = shutil.copy2(program.path, alone / "trackdyn")
    words = [path, "trial", "run", str(trial), "--executor", "dask"]
    for script, said in [
        (None, "python3 cannot be started"),
        ("echo \"No module named 'distributed'\" >&2; exit 1", "No module named 'distributed'"),
    ]:
        if script is not None:
            (alone / "python3").write_text(f"#!/bin/sh\n{script}\n")
            (alone / "python3").chmod(0o755)
        done = subprocess.run(
            words, capture_output=True, text=True, check=False, env={"PATH": str(alone)}
        )
        told = " ".join(done.stderr.split())
        assert done.returncode == 1 and said in told, told
        assert "pip install trackdyn[fleet], or --executor local" in told, told
