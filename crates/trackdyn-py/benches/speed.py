"""What Python adds to the program and the library: prints a table, and fails nothing.

``python crates/trackdyn-py/benches/speed.py``, with the wheel installed, on a machine at rest.
"""

from __future__ import annotations

import shutil
import statistics
import subprocess
import sysconfig
import tempfile
import time
from collections.abc import Callable

import numpy as np

import trackdyn as td
from trackdyn import _trackdyn

PROGRAM = shutil.which("trackdyn", path=sysconfig.get_path("scripts")) or "trackdyn"


def median(job: Callable[[], object], repeats: int = 15) -> float:
    """Median time of a job, s."""
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        job()
        times.append(time.perf_counter() - begin)
    return statistics.median(times)


def call(*arguments: object) -> None:
    """A run of the program."""
    subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True)


def main() -> None:
    """Measure and print."""
    robot = td.Vehicle("auriga-alpha")
    with tempfile.TemporaryDirectory() as folder:
        minute = ("--run-count", 1, "--duration", 60)
        program = median(lambda: call("simulate", *minute, "--out", f"{folder}/minute"))
        python = median(lambda: td.simulate(robot, runs=1, duration=60.0))
        print(f"simulate a minute: program {1e3 * program:.1f} ms, td.simulate {1e3 * python:.1f} ms")

        def written() -> None:
            td.simulate(robot, runs=1, duration=60.0).write(f"{folder}/python")

        both = median(written)
        print(f"  with its files: {1e3 * both:.1f} ms, {both / program:.2f} of the program")

        drive = td.simulate(robot)
        drive.write(f"{folder}/drive")
        log = drive.recording
        program = median(
            lambda: call("identify", f"{folder}/drive", "--gauge", 0.42, "--out", f"{folder}/found")
        )
        fit = median(lambda: td.IcrKinematics(0.42).fit(log))
        keywords = {
            "tau": None,
            "settle": None,
            "nuisances": [],
            "gyroscope": False,
            "force": False,
            "seed": 1,
            "population": None,
            "generations": None,
        }
        library = median(lambda: _trackdyn.identify(log._inner, 0.42, keywords, None))
        print(
            f"identify, nine paths of the paper: program {1e3 * program:.1f} ms, library "
            f"{1e3 * library:.1f} ms, fit {1e3 * fit:.1f} ms, {fit / library:.2f} of the library"
        )

    # a map of four pairs is next to no work: this is what a call costs, there and back
    raw = robot._inner
    nothing = median(lambda: _trackdyn.icr_map(raw, 2, 1.0, (0.0, 0.0), 0.0, 0.0, None), 2000)
    print(f"a call with next to no work: {1e6 * nothing:.0f} us")
    commands = np.array([[0.0, 0.1, 0.1], [0.2, 0.0, 0.0]])
    short = median(lambda: td.simulate(robot, commands, sensors="perfect"), 1000)
    print(f"a drive of 0.2 s: {1e6 * short:.0f} us")
    fitted = td.IcrKinematics(0.42).fit(log)
    print(f"predict of one pair: {1e6 * median(lambda: fitted.predict(0.3, 0.9), 2000):.1f} us")
    pairs = np.random.default_rng(1).uniform(-1.0, 1.0, (2, 100_000))
    ns = 1e9 * median(lambda: fitted.predict(*pairs)) / pairs.shape[1]
    print(f"predict of 100,000 pairs: {ns:.1f} ns each")
    heights = np.linspace(0.0, 0.1, 64)
    place = "effect.load-transfer.cog_height_m"
    options = {"runs": 1, "duration": 60.0}
    batch = median(lambda: td.simulate_batch(robot, parameters={place: heights}, **options), 5)
    print(f"simulate_batch of 64 minutes: {1e3 * batch / 64:.1f} ms each")


if __name__ == "__main__":
    main()
