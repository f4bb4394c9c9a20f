"""The program of fleets: its options, and what it refuses."""

import argparse
import re
from pathlib import Path

import numpy as np
import pytest
from fleets import status_of

from trackdyn._reading import ReadingOptions
from trackdyn.fleet import _executors
from trackdyn.fleet.__main__ import main
from trackdyn.fleet._reading_options import add_options, option_of, reading_of


def test_without_dask_threads_start_the_work(in_fleet, expected, monkeypatch, capsys):
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
    given = [option_of(keyword) for keyword in ReadingOptions.__annotations__]
    assert set(given) <= of_program and len(given) > 20
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
        (["--memory", "-1"], "--memory -1: expected GB above zero"),
        (["nothing/*"], "nothing/*: no such file"),
        (["--bogus"], "--bogus"),
    ],
)
def test_bad_input_is_refused_before_any_work(in_fleet, capsys, words, message):
    Path("foreign.parquet").write_text("a,b\n1,2\n")
    Path("bad.toml").write_text("[verdikt]\nmax_p = 0.1\n")
    # the latest of an option counts
    usual = ["--vehicle", "auriga-alpha", "--out", "bad.parquet"]
    if words[0].startswith("--"):
        words = ["logs/*/*", *usual, *words]
    else:
        words = [*words, *usual]
    status = status_of(main, words)
    said = capsys.readouterr().err
    assert status == 1 and message in said and "Traceback" not in said, said
    assert not list(in_fleet.glob("bad.parquet*")) and not list(in_fleet.glob("*.journal"))
