"""Work that takes long: interrupts, progress, threads, seeds."""

import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import trackdyn as td

#: Time within which Ctrl-C is heard, s.
HEARD = 0.2

INTERRUPTED = """
import signal, sys, threading, time, os
import trackdyn as td

# also where the tests run in the background, whose interrupts a shell ignores
signal.signal(signal.SIGINT, signal.default_int_handler)
model = td.Vehicle("auriga-alpha").with_inertia()
log = td.simulate(model.with_effect("directional-lugs"), runs=4, seed=2).recording
jobs = {
    "diagnose": lambda: td.diagnose(log, model),
    "map": lambda: td.icr_map(model.with_effect("centripetal"), points=2001),
    "identify": lambda: td.IcrKinematics(model, population=20000, generations=2000).fit(log),
    "simulate": lambda: td.simulate(model, runs=800),
}
sent = []
def interrupt():
    time.sleep(1.0)
    sent.append(time.monotonic())
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt, daemon=True).start()
try:
    jobs[sys.argv[1]]()
except KeyboardInterrupt:
    print(time.monotonic() - sent[0])
else:
    print("finished")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("job", ["diagnose", "map", "identify", "simulate"])
def test_an_interrupt_is_heard_at_once(job):
    words = [sys.executable, "-c", INTERRUPTED, job]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False)
    assert done.stdout.strip() not in ("", "finished"), done.stdout + done.stderr
    assert float(done.stdout) < HEARD
    # and the process ends by itself
    assert done.returncode in (0, -signal.SIGINT), done.stderr


def test_progress_is_told_by_the_thread_that_called(robot):
    told = []
    here = threading.get_ident()

    def progress(stage, done, total):
        assert threading.get_ident() == here
        told.append((stage, done, total))

    td.icr_map(robot.with_effect("centripetal"), points=101, progress=progress)
    assert told[-1] == ("map", 101 * 101, 101 * 101)
    assert [done for _, done, _ in told] == sorted(done for _, done, _ in told)


def test_progress_as_a_bar(robot, capsys):
    td.icr_map(robot.with_effect("centripetal"), points=101, progress=True)
    assert "map" in capsys.readouterr().err


def test_python_goes_on_meanwhile(robot):
    ticks = []
    is_done = threading.Event()

    def tick():
        while not is_done.wait(0.01):
            ticks.append(time.monotonic())

    ticker = threading.Thread(target=tick)
    ticker.start()
    begin = time.monotonic()
    td.icr_map(robot.with_effect("centripetal"), points=151)
    taken = time.monotonic() - begin
    is_done.set()
    ticker.join()
    # a held interpreter gives none
    assert len(ticks) > 0.2 * taken / 0.01


def test_results_do_not_depend_on_threads_or_order(robot, recording):
    expected = [td.simulate(robot, runs=1, duration=10.0, seed=k) for k in range(6)]
    found = [None] * 6

    def simulate(k):
        found[k] = td.simulate(robot, runs=1, duration=10.0, seed=k)

    threads = [threading.Thread(target=simulate, args=(k,)) for k in reversed(range(6))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    prints = [one.recording.fingerprint for one in expected]
    assert [one.recording.fingerprint for one in found] == prints
    assert len(set(prints)) == 6


def test_a_batch_is_its_members(robot):
    height = np.array([0.0, 0.05, 0.1])
    place = "effect.load-transfer.cog_height_m"
    batch = td.simulate_batch(
        robot, "designed", parameters={place: height}, seed=3, runs=1, duration=10.0
    )
    for one, value in zip(batch, height):
        alone = td.simulate(
            robot.with_values({place: value}), "designed", seed=3, runs=1, duration=10.0
        )
        assert one.recording.fingerprint == alone.recording.fingerprint
        assert np.array_equal(one.truth["x"], alone.truth["x"])
    assert len({one.recording.fingerprint for one in batch}) == 3
    seeds = td.simulate_batch([robot, robot], seed=[1, 2], runs=1, duration=5.0)
    assert seeds[0].recording.fingerprint != seeds[1].recording.fingerprint
    tall = {place: [0.1, 2.0]}
    with pytest.raises(td.SimulateError, match="tips over"):
        td.simulate_batch(robot, parameters=tall, runs=1, duration=10.0)
    stands, tips = td.simulate_batch(robot, parameters=tall, runs=1, duration=10.0, errors="none")
    assert stands is not None and tips is None
    with pytest.raises(td.SettingError, match="expected one for each of 2"):
        td.simulate_batch([robot, robot], seed=[1, 2, 3])
    with pytest.raises(td.SettingError, match="expected as many of each"):
        td.simulate_batch(robot, parameters={"mass_kg": [1.0, 2.0], "gauge_m": [0.4, 0.5, 0.6]})


def test_a_seed_is_a_drive(robot):
    one, same, other = (td.simulate(robot, runs=1, seed=seed).recording for seed in (1, 1, 2))
    assert one.fingerprint == same.fingerprint != other.fingerprint
