"""One row a log, whoever makes it, and only where it has to be made."""

import os
from concurrent.futures import ProcessPoolExecutor
from datetime import datetime, timezone
from pathlib import Path

import numpy as np
import pytest
from fleets import Inline, rows, run

import trackdyn as td
from trackdyn.fleet import _child, _table


def test_a_row_says_what_the_fit_says(in_fleet, expected, robot):
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


def test_what_is_no_log_has_a_row(in_fleet, expected):
    one = rows("expected.parquet")["logs/robot2/broken.mcap"]
    assert (one["status"], one["stage"], one["error_kind"]) == ("error", "read", "RecordingError")
    # by the name that it was asked for
    assert one["error"].startswith("logs/robot2/broken.mcap: ") and one["chi"] is None


def test_a_log_too_short_to_diagnose_keeps_its_icrs(robot, tmp_path):
    td.simulate(robot, "manual", runs=1, duration=6.2, seed=1).write(tmp_path / "short")
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


def test_same_bytes_whoever_makes_them_and_in_whatever_parts(in_fleet, expected):
    with ProcessPoolExecutor(2) as pool:
        run("pool.parquet", executor=pool)
    assert Path("pool.parquet").read_bytes() == expected
    td.fleet.run("logs/robot2/*", "auriga-alpha", "parts.parquet", diagnose=False, workers=1)
    outcome = run("parts.parquet", workers=2)
    assert (outcome.kept, outcome.made["ok"]) == (3, 4)
    assert Path("parts.parquet").read_bytes() == expected
    assert not Path("parts.parquet.journal").exists()


def test_only_what_changed_is_made_again(in_fleet, expected):
    def again(**keywords):
        inline = Inline()
        outcome = run("again.parquet", executor=inline, **keywords)
        return len(inline.jobs), outcome

    Path("again.parquet").write_bytes(expected)
    # the file beside it is gone, so the bytes of the logs have to tell
    jobs, outcome = again()
    assert (jobs, outcome.kept) == (7, 7) and not outcome.made
    assert again()[0] == 0
    log = in_fleet / "logs" / "robot0" / "2026-05-01"
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


def test_robots_are_renamed_without_work(in_fleet, expected):
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
