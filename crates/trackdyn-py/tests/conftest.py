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
def program() -> Callable[..., subprocess.CompletedProcess[str]]:
    """The program trackdyn that the wheel installed; TRACKDYN_PROGRAM stands for another."""
    scripts = Path(sysconfig.get_path("scripts"))
    path = os.environ.get("TRACKDYN_PROGRAM") or shutil.which("trackdyn", path=str(scripts))
    assert path, f"no program trackdyn in {scripts}: the wheel brings it"

    def call(*arguments: object) -> subprocess.CompletedProcess[str]:
        words = [path, *map(str, arguments)]
        return subprocess.run(words, capture_output=True, text=True, check=False)

    return call
