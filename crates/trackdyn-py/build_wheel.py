"""Builds the wheel: the program `trackdyn` first, which goes into it as a script, then maturin.

The program starts itself again for trials, and has signals and exit states of its own; so it lies
in the wheel as it is, and no Python stands between it and its user.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import maturin
from maturin import *  # noqa: F403

HERE = Path(__file__).resolve().parent

# Where maturin looks for scripts; metadata are asked for before there are any.
SCRIPTS = HERE / "trackdyn.data" / "scripts"
SCRIPTS.mkdir(parents=True, exist_ok=True)


def put_program() -> None:
    """Compile the program, with the features that the extension needs, and put it into the wheel.

    So program and extension share all crates, and those that the tests compiled.
    """
    packages = ["--package", "trackdyn-cli", "--package", "trackdyn-py"]
    command = ["cargo", "build", "--release", *packages, "--bin", "trackdyn"]
    print("$", " ".join(command), file=sys.stderr, flush=True)
    subprocess.run(command, cwd=HERE, check=True)
    target = Path(os.environ.get("CARGO_TARGET_DIR") or HERE.parent.parent / "target")
    name = "trackdyn.exe" if os.name == "nt" else "trackdyn"
    shutil.copy2(target / "release" / name, SCRIPTS / name)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Hook of PEP 517."""
    put_program()
    return maturin.build_wheel(wheel_directory, config_settings, metadata_directory)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """Hook of PEP 660."""
    put_program()
    return maturin.build_editable(wheel_directory, config_settings, metadata_directory)
