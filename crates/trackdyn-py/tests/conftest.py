"""What tests share: a robot, recordings of it, and the program of the wheel."""

from __future__ import annotations

import os
import shutil
import subprocess
import sysconfig
from collections.abc import Callable
from pathlib import Path

import matplotlib
import pytest

import trackdyn as td

matplotlib.use("Agg")


@pytest.fixture(scope="session")
def robot() -> td.Vehicle:
    return td.Vehicle("auriga-alpha")


@pytest.fixture(scope="session")
def drive(robot: td.Vehicle) -> td.Simulation:
    """Three runs driven by hand, seen by sensors of a laboratory."""
    return td.simulate(robot, runs=3, seed=4)


@pytest.fixture(scope="session")
def recording(drive: td.Simulation) -> td.Recording:
    return drive.recording


@pytest.fixture(scope="session")
def model(robot):
    return robot.with_inertia()


@pytest.fixture(scope="session")
def told():
    return []


@pytest.fixture(scope="session")
def diagnosis(model, told):
    """A short drive of a robot whose lugs grip better one way than its model knows."""
    lugs = model.with_effect("directional-lugs", excess=0.15)
    log = td.simulate(lugs, runs=1, duration=25.0, seed=3).recording
    progress = lambda *at: told.append(at)  # noqa: E731
    settings = {"verdict": {"max_p": 0.008}}
    return td.diagnose(
        log, model, draws=1000, held_out="none", settings=settings, progress=progress
    )


@pytest.fixture(scope="session")
def program() -> Callable[..., subprocess.CompletedProcess[str]]:
    """The program trackdyn that the wheel installed; TRACKDYN_PROGRAM stands for another."""
    scripts = Path(sysconfig.get_path("scripts"))
    path = os.environ.get("TRACKDYN_PROGRAM") or shutil.which("trackdyn", path=str(scripts))
    assert path, f"no program trackdyn in {scripts}: the wheel brings it"

    def call(*arguments: object) -> subprocess.CompletedProcess[str]:
        words = [path, *map(str, arguments)]
        return subprocess.run(words, capture_output=True, text=True, check=False)

    call.path = path
    return call


@pytest.fixture(scope="session")
def fleet_logs(robot, tmp_path_factory):
    """Six logs of three robots, and one that is none, in a folder to work in."""
    folder = tmp_path_factory.mktemp("fleet")
    for number in range(6):
        drive = td.simulate(robot, "designed", runs=1, duration=15.0, seed=number)
        drive.write(folder / "logs" / f"robot{number // 2}" / f"2026-05-0{number + 1}")
    (folder / "logs" / "robot2" / "broken.mcap").write_bytes(b"not a bag")
    return folder


@pytest.fixture
def in_fleet(fleet_logs, monkeypatch):
    monkeypatch.chdir(fleet_logs)
    return fleet_logs


@pytest.fixture(scope="session")
def expected(fleet_logs):
    """The bytes of the table, made by threads."""
    before = Path.cwd()
    os.chdir(fleet_logs)
    try:
        td.fleet.run("logs/*/*", "auriga-alpha", "expected.parquet", diagnose=False, workers=2)
    finally:
        os.chdir(before)
    return (fleet_logs / "expected.parquet").read_bytes()
