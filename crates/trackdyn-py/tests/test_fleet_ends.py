"""Whatever happens to a log, a worker or the program: no row is lost, and none is there twice."""

import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from fleets import Inline, rows, run, status_of

import trackdyn as td
from trackdyn.fleet import _executors, _guard, _journal, _submit, _table
from trackdyn.fleet.__main__ import main

needs_posix = pytest.mark.skipif(sys.platform == "win32", reason="pipes and signals of POSIX")

#: Time within which a program that runs aside gets so far, s.
PATIENCE = 60.0


@needs_posix
def test_a_log_that_hangs_or_crashes_costs_its_row(robot, tmp_path, monkeypatch):
    for name in ("a", "c"):
        td.simulate(robot, "designed", runs=1, duration=15.0, seed=1).write(tmp_path / name)
    # reading a pipe that nobody writes never ends
    os.mkfifo(tmp_path / "b.mcap")
    (tmp_path / "crash.mcap").write_bytes(b"")
    crash = (
        "_read = _child.read_recording\n"
        "def read(path, **options):\n"
        "    import os, signal\n"
        "    if path.name == 'crash.mcap':\n"
        "        os.write(2, b'out of luck')\n"
        "        os.kill(os.getpid(), signal.SIGSEGV)\n"
        "    return _read(path, **options)\n"
        "_child.read_recording = read\n"
    )
    code = _guard._CODE.replace("_child.serve(", crash + "_child.serve(")
    monkeypatch.setattr(_guard, "_CODE", code)
    out = tmp_path / "out.parquet"
    outcome = td.fleet.run(tmp_path / "*", robot, out, diagnose=False, workers=1, timeout=5.0)
    found = {Path(log).name: row for log, row in rows(out).items()}
    assert outcome.made == {"ok": 2, "timed out": 1, "crashed": 1}
    assert found["b.mcap"]["error"] == "fingerprint: not done after 5 s"
    assert found["crash.mcap"]["error"] == "read: its process ended by SIGSEGV: out of luck"
    assert found["a"]["chi"] == found["c"]["chi"] is not None
    attempts = {row["log"]: row["attempts"] for row in rows(_table.beside(out)).values()}
    assert sorted(attempts.values()) == [1, 1, 1, 2]


@needs_posix
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_an_end_in_the_middle_loses_no_row(in_fleet, expected, monkeypatch, how):
    # the last log hangs, so all others are done before the end
    hanging = in_fleet / "logs" / "robot2" / "z.mcap"
    os.mkfifo(hanging)
    out = Path(f"{how.name}.parquet")
    code = (
        "import sys; from trackdyn.fleet import _executors; _executors.has_dask = lambda: False\n"
    )
    code += "from trackdyn.fleet.__main__ import main; sys.exit(main())"
    words = ["logs/*/*", "--vehicle", "auriga-alpha", "--no-diagnose", "--out", out, "--workers", 1]
    program = subprocess.Popen(
        [sys.executable, "-c", code, *map(str, words)],
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    try:
        journal = Path(f"{out}.journal")
        until = time.monotonic() + PATIENCE
        while not (journal.exists() and journal.read_bytes().count(b"\n") == 7):
            assert time.monotonic() < until and program.poll() is None
            time.sleep(0.05)
        with pytest.raises(td.OutputError, match="another process writes it"):
            run(out)
        program.send_signal(how)
        said = program.communicate(timeout=PATIENCE)[1]
    finally:
        program.kill()
        hanging.unlink()
    if how == signal.SIGINT:
        assert program.returncode == 130 and f"{out} has the rows that were done" in said
        assert len(rows(out)) == 7 and not journal.exists()
    else:
        assert not out.exists()
        with journal.open("ab") as torn:
            torn.write(b'[{"log": "logs/ro')
    inline = Inline()
    outcome = run(out, executor=inline)
    assert outcome.kept == 7 and not inline.jobs
    assert out.read_bytes() == expected and not journal.exists()


@needs_posix
def test_dask_loses_a_worker_and_no_row(in_fleet, expected):
    distributed = pytest.importorskip("distributed")
    killed = []
    with _executors.dask(None, 2) as executor:
        client = distributed.default_client()
        workers = client.run(os.getpid)

        def progress(stage, done, total):
            if done == 2:
                killed.append(sorted(workers.values())[0])
                os.kill(killed[0], signal.SIGKILL)

        outcome = run("dask.parquet", executor=executor, progress=progress)
    assert len(workers) == 2 and len(killed) == 1
    # nothing lost, nothing twice
    assert outcome.made == {"ok": 6, "error": 1} and outcome.kept == 0
    assert Path("dask.parquet").read_bytes() == expected


def test_an_executor_has_few_jobs_at_a_time(monkeypatch):
    monkeypatch.setattr(_submit, "IN_FLIGHT", 3)
    given = []

    def work(job):
        time.sleep(0.001)
        return job

    def jobs():
        for number in range(30):
            given.append(number)
            yield {"number": number}

    with ThreadPoolExecutor(2) as pool:
        for done, (job, future) in enumerate(_submit.results(pool, jobs(), work)):
            assert future.result() == job
            assert len(given) - done <= 3 + 1
    assert len(given) == done + 1 == 30


def test_an_executor_that_breaks_keeps_what_was_done(in_fleet, expected):
    with pytest.raises(td.Error, match="the executor broke: OSError: no worker is left"):
        run("broke.parquet", executor=Inline(after=3))
    assert len(rows("broke.parquet")) == 3
    run("broke.parquet", executor=Inline())
    assert Path("broke.parquet").read_bytes() == expected

    # of Dask: several workers were lost with this log
    class KilledWorker(Exception):
        pass

    def lost(result):
        raise KilledWorker("Attempted to run task 'make' on 4 different workers")

    outcome = run("lost.parquet", executor=Inline(lost))
    assert outcome.made == {"crashed": 7}


    def old(result):
        return {**result, "row": {**result["row"], "version": "0.0.1"}}

    with pytest.raises(td.Error, match="a worker has trackdyn 0.0.1, and this program"):
        run("old.parquet", executor=Inline(old))
    with pytest.raises(td.SettingError, match="nuisances lever: expected"):
        run("old.parquet", executor=Inline(), identify={"nuisances": ["lever"]})


@needs_posix
@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="no /proc tells of memory")
def test_memory_in_which_nothing_starts_is_refused(in_fleet, capsys):
    for memory in (1e7, 5e7):
        words = rf"memory {memory:.0f}: expected \d+ bytes"
        with pytest.raises(td.SettingError, match=words) as it:
            run("none.parquet", workers=1, memory=memory)
        assert it.value.setting == "memory" and not Path("none.parquet").exists()
    # in what is expected, the process starts, and what does not fit costs rows
    needs = int(str(it.value).split("expected ")[1].split()[0])
    outcome = run("some.parquet", workers=1, memory=needs + 2**20)
    assert sum(outcome.made.values()) == 7
    words = ["logs/*/*", "--vehicle", "auriga-alpha", "--no-diagnose", "--out", "none.parquet"]
    assert status_of(main, [*words, "--workers", "1", "--memory", "0.05"]) == 1
    said = capsys.readouterr().err
    assert "--memory 50000000: expected " in said and " GB) or more" in said, said


def test_a_journal_goes_on_behind_a_row_that_was_cut(tmp_path):
    out = tmp_path / "out.parquet"
    first = _journal.Journal(out)
    first.append({"log": "a", "chi": 0.1}, {"log": "a"})
    first.append({"log": "b", "chi": 0.2}, {"log": "b"})
    first.close(False)
    with first.path.open("ab") as torn:
        torn.write(b'[{"log": "c", "chi"')
    second = _journal.Journal(out)
    second.append({"log": "d", "chi": 0.3}, {"log": "d"})
    second.append({"log": "a", "chi": 0.4}, {"log": "a"})
    second.close(False)
    third = _journal.Journal(out)
    assert [(row["log"], row["chi"]) for row, _ in third.rows()] == [
        ("a", 0.4),
        ("b", 0.2),
        ("d", 0.3),
    ]
    third.close(True)
    assert not third.path.exists()


def test_a_journal_of_something_else_is_refused(tmp_path):
    (tmp_path / "out.parquet.journal").write_text("notes\n")
    with pytest.raises(td.InputError, match="byte 0: not a row"):
        _journal.Journal(tmp_path / "out.parquet")
