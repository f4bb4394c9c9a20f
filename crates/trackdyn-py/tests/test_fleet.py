"""One row a log, whoever makes it and whatever happens to it."""

import argparse
import inspect
import os
import re
import signal
import subprocess
import sys
import time
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from datetime import datetime, timezone
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
import trackdyn as td
from trackdyn._reading import reading
from trackdyn.fleet import _child, _executors, _guard, _journal, _submit, _table
from trackdyn.fleet.__main__ import main
from trackdyn.fleet._reading_options import add_options, option_of, reading_of

needs_posix = pytest.mark.skipif(sys.platform == "win32", reason="pipes and signals of POSIX")

#: Time within which a program that runs aside gets so far, s.
PATIENCE = 60.0


@pytest.fixture(scope="module")
def logs(robot, tmp_path_factory):
    """Six logs of three robots, and one that is none, in a folder to work in."""
    folder = tmp_path_factory.mktemp("fleet")
    for number in range(6):
        drive = td.simulate(robot, "designed", runs=1, duration=15.0, seed=number)
        drive.write(folder / "logs" / f"robot{number // 2}" / f"2026-05-0{number + 1}")
    (folder / "logs" / "robot2" / "broken.mcap").write_bytes(b"not a bag")
    return folder


@pytest.fixture
def here(logs, monkeypatch):
    monkeypatch.chdir(logs)
    return logs


@pytest.fixture(scope="module")
def expected(logs):
    """The bytes of the table, made by threads."""
    before = Path.cwd()
    os.chdir(logs)
    try:
        td.fleet.run("logs/*/*", "auriga-alpha", "expected.parquet", diagnose=False, workers=2)
    finally:
        os.chdir(before)
    return (logs / "expected.parquet").read_bytes()


def rows(path):
    return {row["log"]: row for row in pq.read_table(path).to_pylist()}


def run(out, **keywords):
    return td.fleet.run("logs/*/*", "auriga-alpha", out, diagnose=False, **keywords)


class Inline(Executor):
    """Does at once what it is given."""

    def __init__(self, change=lambda result: result, after=10**9):
        self.change, self.left, self.jobs = change, after, []

    def submit(self, fn, /, *args, **kwargs):
        future = Future()
        self.jobs.append(args[0])
        self.left -= 1
        try:
            if self.left < 0:
                raise OSError("no worker is left")
            future.set_result(self.change(fn(*args, **kwargs)))
        except Exception as error:
            future.set_exception(error)
        return future


def test_a_row_says_what_the_fit_says(here, expected, robot):
    found = rows("expected.parquet")
    assert list(found) == sorted(found) and len(found) == 7
    one = found["logs/robot1/2026-05-03"]
    fitted = td.IcrKinematics(robot).fit(td.read_recording("logs/robot1/2026-05-03"))
    assert (one["x_l_m"], one["x_r_m"], one["y_m"]) == (fitted.x_l_, fitted.x_r_, fitted.y_)
    assert np.array_equal(np.reshape(one["covariance_m2"], (3, 3)), fitted.covariance_)
    assert one["chi"] == fitted.steering_efficiency_ and one["gauge_m"] == robot.gauge
    # the standard error of chi is the scatter of chi of ICRs drawn with that covariance
    mean = [fitted.x_l_, fitted.x_r_, fitted.y_]
    drawn = np.random.default_rng(0).multivariate_normal(mean, fitted.covariance_, 100_000)
    assert one["chi_se"] == pytest.approx(np.std(0.42 / (drawn[:, 1] - drawn[:, 0])), rel=0.02)
    assert (one["robot"], one["status"], one["error"]) == ("robot1", "ok", None)
    assert one["fingerprint"] == td.read_recording("logs/robot1/2026-05-03").fingerprint
    assert (one["vehicle"], one["version"]) == (robot.fingerprint, td.__version__)
    # stamps from 0 are no dates, and nobody asked for a diagnosis
    assert one["time"] is one["diagnosis"] is one["claims"] is None


def test_what_is_no_log_has_a_row(here, expected):
    one = rows("expected.parquet")["logs/robot2/broken.mcap"]
    assert (one["status"], one["stage"], one["error_kind"]) == ("error", "read", "RecordingError")
    # by the name that it was asked for
    assert one["error"].startswith("logs/robot2/broken.mcap: ") and one["chi"] is None


def test_a_log_too_short_to_diagnose_keeps_its_icrs(robot, tmp_path):
    td.simulate(robot, "manual", runs=1, duration=12.0, seed=1).write(tmp_path / "short")
    td.fleet.run(tmp_path / "short", robot, tmp_path / "out.parquet", executor=Inline())
    (one,) = rows(tmp_path / "out.parquet").values()
    assert (one["status"], one["stage"]) == ("error", "diagnose")
    assert one["error_kind"] == "DiagnoseError" and "segments to learn from" in one["error"]
    assert one["chi"] == pytest.approx(0.505, abs=0.02)


def test_claims_and_refusals_are_those_of_the_diagnosis(robot, recording, monkeypatch, tmp_path):
    size = td.Size("strength", 1.0, 0.8, 1.2, "1")
    claim = td.Claim("centripetal", ("centripetal", "x"), "physics", (size,), 0.01, 5.0, 7.0, None)

    class Found:
        status, claims, refusals = "explained", (claim,), (td.Refusal(("gyro-bias",), "small"),)

    monkeypatch.setattr(_child, "diagnose", lambda *of, **keywords: Found)
    row = {"log": "a", **_child._diagnosed(recording, robot, {})}
    _table.write(tmp_path / "a.parquet", _table.schema(), [row], None)
    one = rows(tmp_path / "a.parquet")["a"]
    assert one["diagnosis"] == "explained"
    assert one["claims"][0]["one_of"] == ["centripetal", "x"] and one["claims"][0]["p"] == 0.01
    assert one["claims"][0]["sizes"] == [vars(size)]
    assert one["refusals"] == [{"one_of": ["gyro-bias"], "reason": "small"}]


def test_same_bytes_whoever_makes_them_and_in_whatever_parts(here, expected):
    with ProcessPoolExecutor(2) as pool:
        run("pool.parquet", executor=pool)
    assert Path("pool.parquet").read_bytes() == expected
    td.fleet.run("logs/robot2/*", "auriga-alpha", "parts.parquet", diagnose=False, workers=1)
    outcome = run("parts.parquet", workers=2)
    assert (outcome.kept, outcome.made["ok"]) == (3, 4)
    assert Path("parts.parquet").read_bytes() == expected
    assert not Path("parts.parquet.journal").exists()


def test_only_what_changed_is_made_again(here, expected):
    def again(**keywords):
        inline = Inline()
        outcome = run("again.parquet", executor=inline, **keywords)
        return len(inline.jobs), outcome

    Path("again.parquet").write_bytes(expected)
    # the file beside it is gone, so the bytes of the logs have to tell
    jobs, outcome = again()
    assert (jobs, outcome.kept) == (7, 7) and not outcome.made
    assert again()[0] == 0
    log = here / "logs" / "robot0" / "2026-05-01"
    os.utime(log / "tracks.csv", ns=(1, 1))
    jobs, outcome = again()
    assert (jobs, outcome.kept) == (1, 7) and Path("again.parquet").read_bytes() == expected
    poses = (log / "poses.csv").read_text()
    try:
        (log / "poses.csv").write_text("\n".join(poses.splitlines()[:-20]) + "\n")
        outcome = again()[1]
        assert outcome.again == {"of changed logs": 1} and outcome.made == {"ok": 1}
        assert Path("again.parquet").read_bytes() != expected
    finally:
        (log / "poses.csv").write_text(poses)
    again()
    assert Path("again.parquet").read_bytes() == expected
    outcome = again(retry=True)[1]
    assert outcome.again == {"not ok": 1} and outcome.made == {"error": 1}
    assert again(identify={"settle": 0.1})[1].again == {"with other options": 7}


def test_robots_are_renamed_without_work(here, expected):
    Path("named.parquet").write_bytes(expected)
    # looks at all logs, which the table does not know
    run("named.parquet", executor=Inline())
    inline = Inline()
    pattern = r"(?P<robot>robot\d)(/(?P<time>[\d-]+))?"
    run("named.parquet", executor=inline, robot=pattern.replace("robot\\d", "bot\\d"))
    found = rows("named.parquet")
    assert not inline.jobs and found["logs/robot1/2026-05-03"]["robot"] == "bot1"
    at = found["logs/robot1/2026-05-03"]["time"].to_pydatetime()
    assert at == datetime(2026, 5, 3, tzinfo=timezone.utc)
    functions = {"robot": lambda path: path.upper(), "time": lambda path: 1e9}
    run("named.parquet", executor=inline, **functions)
    one = rows("named.parquet")["logs/robot1/2026-05-03"]
    assert one["robot"] == "LOGS/ROBOT1/2026-05-03" and one["time"].timestamp() == 1e9


def test_the_first_stamp_is_the_time_of_a_log(drive, tmp_path):
    one = drive.recording.part(runs=0)
    begin = 1_780_000_000.0
    tracks = one.tracks.to_array("t", "v_left", "v_right") + [begin, 0.0, 0.0]
    t, x, y, yaw = one.poses.to_array("t", "x", "y", "yaw").T
    zero = np.zeros_like(t)
    poses = np.column_stack([t + begin, x, y, zero, zero, zero, np.sin(yaw / 2), np.cos(yaw / 2)])
    head = "t,v_left,v_right"
    np.savetxt(tmp_path / "t.csv", tracks, "%.6f", ",", header=head, comments="")
    np.savetxt(tmp_path / "a.tum", poses, "%.9f")
    out = tmp_path / "out.parquet"
    options = {"diagnose": False, "executor": Inline(), "tracks": tmp_path / "t.csv"}
    td.fleet.run(tmp_path / "a.tum", "auriga-alpha", out, **options)
    (found,) = rows(out).values()
    first = min(tracks[0, 0], poses[0, 0])
    assert found["status"] == "ok", found
    assert found["time"].timestamp() == pytest.approx(first, abs=1e-3)


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
    code = _guard._CODE.replace("_child.serve()", crash + "_child.serve()")
    monkeypatch.setattr(_guard, "_CODE", code)
    out = tmp_path / "out.parquet"
    outcome = td.fleet.run(tmp_path / "*", robot, out, diagnose=False, workers=2, timeout=5.0)
    found = {Path(log).name: row for log, row in rows(out).items()}
    assert outcome.made == {"ok": 2, "timed out": 1, "crashed": 1}
    assert found["b.mcap"]["error"] == "fingerprint: not done after 5 s"
    assert found["crash.mcap"]["error"] == "read: its process ended by SIGSEGV: out of luck"
    assert found["a"]["chi"] == found["c"]["chi"] is not None
    attempts = {row["log"]: row["attempts"] for row in rows(_table.beside(out)).values()}
    assert sorted(attempts.values()) == [1, 1, 1, 2]


@needs_posix
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_an_end_in_the_middle_loses_no_row(here, expected, monkeypatch, how):
    # the last log hangs, so all others are done before the end
    hanging = here / "logs" / "robot2" / "z.mcap"
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
def test_dask_loses_a_worker_and_no_row(here, expected):
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
    monkeypatch.setattr(_submit, "make", lambda job: time.sleep(0.001) or job)
    given = []

    def jobs():
        for number in range(30):
            given.append(number)
            yield {"number": number}

    with ThreadPoolExecutor(2) as pool:
        for done, (job, future) in enumerate(_submit.results(pool, jobs())):
            assert future.result() == job
            assert len(given) - done <= 3 + 1
    assert len(given) == done + 1 == 30


def test_an_executor_that_breaks_keeps_what_was_done(here, expected):
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

    # nothing starts in 10 MB, whatever the log
    with pytest.raises(td.Error, match="broke: NotStarted: its process ended"):
        run("none.parquet", workers=1, memory=1e7)
    assert not Path("none.parquet").exists()

    def old(result):
        return {**result, "row": {**result["row"], "version": "0.0.1"}}

    with pytest.raises(td.Error, match="a worker has trackdyn 0.0.1, and this program"):
        run("old.parquet", executor=Inline(old))
    with pytest.raises(td.SettingError, match="nuisances lever: expected"):
        run("old.parquet", executor=Inline(), identify={"nuisances": ["lever"]})


def test_without_dask_threads_start_the_work(here, expected, monkeypatch, capsys):
    monkeypatch.setattr(_executors, "has_dask", lambda: False)
    words = ["logs/*/*", "--vehicle", "auriga-alpha", "--no-diagnose", "--out", "threads.parquet"]
    assert main(words) == 0
    said = capsys.readouterr()
    assert "Dask is not installed" in said.err and "7 of 7 logs, 1 not ok" in said.err
    assert said.out.startswith(
        "threads.parquet: 7 of 7 logs have a row: 0 were there, made 1 error"
    )
    assert Path("threads.parquet").read_bytes() == expected
    assert main([*words, "--scheduler", "tcp://127.0.0.1:1"]) == 1
    assert "--scheduler tcp://127.0.0.1:1: Dask is not installed" in capsys.readouterr().err


def test_options_of_reading_are_those_of_the_program(program):
    said = program("diagnose", "--help").stdout
    of_program = set(re.findall(r"^ +(--[a-z-]+)", said, re.M))
    given = [option_of(keyword) for keyword in inspect.signature(reading).parameters]
    # the program chooses among several of an IMU by itself
    assert set(given) - of_program == {"--imu-topic"} and len(given) > 20
    parser = argparse.ArgumentParser()
    add_options(parser)
    words = "--left-joint a --left-joint b --mount-yaw 180 --wheel-radius 0.1 --pose-index 2"
    expected = {"left_joints": ["a", "b"], "mount_yaw": np.pi, "wheel_radius": 0.1, "pose_index": 2}
    assert reading_of(parser.parse_args(words.split())) == expected


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--robot", "("], "--robot (: not a regular expression"),
        (["--robot", "x"], "--robot x: expected a group (?P<robot>...)"),
        (
            ["--robot", "(?P<robot>z)"],
            "--robot (?P<robot>z): does not match 7 of 7 logs, such as logs",
        ),
        (["--robot", r"(?P<robot>ro)(?P<time>b)"], "--time-format b of the log logs/robot0"),
        (["--time-format", "%Y"], "--time-format %Y: expected a group (?P<time>...)"),
        (["--vehicle", "none.toml"], "none.toml: cannot be read"),
        (["--vehicle", "{robot}.toml"], "robot0.toml: cannot be read"),
        (["--out", "x.csv"], "--out x.csv: expected a name that ends in .parquet"),
        (["--out", "foreign.parquet"], "foreign.parquet: not a table of a fleet"),
        (["--settings", "none.toml"], "--settings none.toml: cannot be read"),
        (["--settings", "bad.toml"], "bad.toml:1: verdikt"),
        (["--wheel-radius", "-1"], "--wheel-radius -1: expected a number above zero"),
        (["--wheel-radius", "x"], "argument --wheel-radius: invalid float value"),
        (["--gyro-unit", "rpm"], "--gyro-unit rpm: expected one of rad/s, deg/s"),
        (["--workers", "0"], "--workers 0: expected 1 or more"),
        (["--timeout", "0"], "--timeout 0.0: expected seconds above zero"),
        (["--memory", "-1"], "--memory -1000000000.0: expected bytes above zero"),
        (["nothing/*"], "nothing/*: no such file"),
        (["--bogus"], "--bogus"),
    ],
)
def test_bad_input_is_refused_before_any_work(here, capsys, words, message):
    Path("foreign.parquet").write_text("a,b\n1,2\n")
    Path("bad.toml").write_text("[verdikt]\nmax_p = 0.1\n")
    # the latest of an option counts
    usual = ["--vehicle", "auriga-alpha", "--out", "bad.parquet"]
    if words[0].startswith("--"):
        words = ["logs/*/*", *usual, *words]
    else:
        words = [*words, *usual]
    try:
        status = main(words)
    except SystemExit as ended:
        status = ended.code
    said = capsys.readouterr().err
    assert status == 1 and message in said and "Traceback" not in said, said
    assert not list(here.glob("bad.parquet*")) and not list(here.glob("*.journal"))


def test_a_journal_of_something_else_is_refused(tmp_path):
    (tmp_path / "out.parquet.journal").write_text("notes\n")
    with pytest.raises(td.InputError, match="byte 0: not a row"):
        _journal.Journal(tmp_path / "out.parquet")
