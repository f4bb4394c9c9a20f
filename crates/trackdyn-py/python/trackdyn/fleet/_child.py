"""The process that makes rows: one log after another, told by lines of JSON.

It shares nothing with its parent but two pipes, so a log that crashes or hangs costs no other.
"""

from __future__ import annotations

import base64
import json
import os
import queue
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from .._diagnosis import diagnose
from .._kinematics import IcrKinematics
from .._laws import received
from .._reading import read_recording
from .._recording import Recording
from .._trackdyn import VERSION as __version__
from .._vehicle import Vehicle
from ._files import content, look

#: Stamps before 2000 or after 2100 are not dates: clocks that count from the start of a robot.
_DATES_NS = (946_684_800 * 10**9, 4_102_444_800 * 10**9)

#: Address space beyond what is there that a process needs to begin with a log, bytes.
_ROOM = 128 * 2**20

_Tell = Callable[[dict[str, Any]], None]


def serve(memory: int | None = None) -> None:
    """Answer jobs from the standard input until it ends; then end at once.

    With `memory`, the process has so many bytes of address space. Where it does not start in them,
    it says how many it needs.
    """
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    # whatever else is printed is no answer
    os.dup2(2, 1)
    if memory is not None and memory < _needed_memory():
        answers.write(json.dumps({"needs": _needed_memory()}) + "\n")
        answers.flush()
        return
    limit_memory(memory)
    jobs: queue.SimpleQueue[str] = queue.SimpleQueue()

    def listen() -> None:
        for line in sys.stdin:
            jobs.put(line)
        # the parent is gone, and with it who would take the answer
        os._exit(1)

    threading.Thread(target=listen, daemon=True).start()

    def tell(said: dict[str, Any]) -> None:
        answers.write(json.dumps(said) + "\n")
        answers.flush()

    while True:
        answer(json.loads(jobs.get()), tell)


def limit_memory(size: int | None) -> None:
    """Bound the address space of this process, bytes."""
    if size is not None:
        import resource

        _, most = resource.getrlimit(resource.RLIMIT_AS)
        size = min(size, sys.maxsize if most == resource.RLIM_INFINITY else most)
        resource.setrlimit(resource.RLIMIT_AS, (size, size))


def _needed_memory() -> int:
    """Address space that this process has before it reads a log, bytes, with room to begin."""
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[0])
    except (OSError, ValueError):  # a system that does not tell
        return 0
    return pages * os.sysconf("SC_PAGE_SIZE") + _ROOM


def answer(job: dict[str, Any], tell: _Tell) -> None:
    """Make the row of a job; tell it after each stage, so that what is known outlives the next."""
    said: dict[str, Any] = {"row": {"version": __version__}}
    said["seconds"] = {}
    row = said["row"]

    @contextmanager
    def stage(name: str) -> Iterator[None]:
        row["stage"] = name
        tell(said)
        begin = time.perf_counter()
        try:
            yield
        finally:
            said["seconds"][name] = time.perf_counter() - begin

    try:
        with warnings.catch_warnings():
            # the row has them
            warnings.simplefilter("ignore")
            _fill(job, said, stage)
        row.update(status="ok", stage=None)
    # a panic of the library is a BaseException
    except BaseException as error:
        text = str(error) or type(error).__name__
        row.update(status="error", error_kind=type(error).__name__)
        row["error"] = text.replace(job["path"], job["log"])
    tell({**said, "done": True})


def _fill(job: dict[str, Any], said: dict[str, Any], stage: Callable[[str], Any]) -> None:
    row = said["row"]
    for sent in job["laws"]:
        received(base64.b64decode(sent))
    vehicle = Vehicle.from_toml(job["vehicle"], job["vehicle_name"])
    path = Path(job["path"])
    with stage("fingerprint"):
        said["look"] = look(path)
        row["sha256"] = content(path)
    if row["sha256"] == job["unless"]:
        said["is_same"] = True
        return
    with stage("read"):
        recording = read_recording(path, **job["reading"])
        row.update(
            fingerprint=recording.fingerprint,
            runs=len(recording.runs),
            duration_s=recording._inner.duration,
            first_stamp=first_stamp(recording),
            warnings=[text.replace(job["path"], job["log"]) for text in recording.warnings],
        )
    with stage("identify"):
        row.update(_identified(IcrKinematics(vehicle, **job["identify"]).fit(recording)))
    if job["diagnose"] is not None:
        with stage("diagnose"):
            row.update(_diagnosed(recording, vehicle, job["diagnose"]))


def _identified(fitted: IcrKinematics) -> dict[str, Any]:
    chi = fitted.steering_efficiency_
    row: dict[str, Any] = {"x_l_m": fitted.x_l_, "x_r_m": fitted.x_r_, "y_m": fitted.y_, "chi": chi}
    covariance = fitted.covariance_
    if covariance is not None:
        # d = x_r - x_l,  var d = Σ_ll + Σ_rr - 2 Σ_lr,  χ = L/d,  σ_χ = χ σ_d/d
        variance = covariance[0, 0] + covariance[1, 1] - 2.0 * covariance[0, 1]
        distance = fitted.x_r_ - fitted.x_l_
        row["covariance_m2"] = [float(one) for one in covariance[:3, :3].ravel()]
        row["chi_se"] = float(chi * np.sqrt(max(variance, 0.0)) / distance)
    return row


def _diagnosed(recording: Recording, vehicle: Vehicle, keywords: dict[str, Any]) -> dict[str, Any]:
    found = diagnose(recording, vehicle, **keywords)
    claims = [
        {
            "effect": claim.effect,
            "one_of": list(claim.one_of),
            "kind": claim.kind,
            "p": claim.p,
            "ln_bayes_factor": claim.ln_bayes_factor,
            "held_out_gain": claim.held_out_gain,
            "sizes": [vars(size) for size in claim.sizes],
        }
        for claim in found.claims
    ]
    refusals = [{"one_of": list(of.one_of), "reason": of.reason} for of in found.refusals]
    return {"diagnosis": found.status, "claims": claims, "refusals": refusals}


def first_stamp(recording: Recording) -> int | None:
    """Unix time of the first reading, ns; None where the stamps are no dates."""
    inner = recording._inner
    if inner.is_of_points:
        return None
    # the first second alone: columns are copies
    beginning = inner.part(None, (0.0, 1.0))
    columns = [beginning.columns(series)["t"] for series in ("tracks", "poses")]
    stamps = [float(t.min()) for t in columns if len(t)]
    if not stamps:
        return None
    first = (inner.epoch_ns or 0) + round(min(stamps) * 1e9)
    return first if _DATES_NS[0] <= first < _DATES_NS[1] else None
