"""What a worker is told of a log: plain values, so that every executor can carry them."""

from __future__ import annotations

import base64
import hashlib
import json
import os
import pickle
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Union

from .. import _trackdyn, _values
from .._arguments import plain, vehicle_of
from .._diagnosis import keywords_of
from .._errors import DocumentError, RecordingError, SettingError
from .._kinematics import IcrKinematics
from .._laws import Law, carried, of_ids, several_of
from .._reading import reading as reading_of
from .._vehicle import Vehicle, VehicleLike
from ._logs import Log

#: A vehicle for all robots; or a path or name with ``{robot}`` where the name of a robot stands.
FleetVehicle = VehicleLike

#: Whether to diagnose, or how.
DiagnoseLike = Union[bool, Mapping[str, Any]]

#: Options of reading that are paths: workers may run elsewhere.
_PATHS = ("tracks", "msg_dir")

_DIAGNOSE = ("settings", "held_out", "draws", "seed", "gyroscope", "tau", "laws")
_NOT_IDENTIFY = ("vehicle", "alphas", "progress")


@dataclass(frozen=True)
class Options:
    """How rows are made; what of it counts for their content has a fingerprint."""

    reading: dict[str, Any]
    identify: dict[str, Any]
    diagnose: dict[str, Any] | None
    timeout: float
    memory: int | None
    #: Suspects beside the catalogue.
    laws: tuple[Law, ...] = ()

    @property
    def fingerprint(self) -> str:
        """Fingerprint of what counts for rows."""
        counts: list[Any] = [self.reading, self.identify, self.diagnose]
        if self.laws:
            counts.append([law.fingerprint for law in self.laws])
        text = json.dumps(counts, sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(text.encode()).hexdigest()[:16]


def options_of(
    reading_options: Mapping[str, Any],
    identify: Mapping[str, Any] | None,
    diagnose: DiagnoseLike,
    timeout: float,
    memory: float | None,
) -> Options:
    """The options, checked before any log is read.

    Raises
    ------
    SettingError
        For a value that is not accepted.
    DocumentError
        For settings of the diagnosis that are not.
    """
    if not _values.finite("timeout", timeout) > 0.0:
        raise SettingError(f"timeout {timeout}: expected seconds above zero", "timeout")
    if memory is not None and not _values.finite("memory", memory) > 0.0:
        raise SettingError(f"memory {memory}: expected bytes above zero", "memory")
    if memory is not None and os.name == "nt":
        raise SettingError(f"memory {memory}: Windows bounds no process: expected none", "memory")
    read = reading_of(reading_options)
    try:
        _trackdyn.Recording.open(os.devnull + ".no-recording", read)
    # all but the options is well
    except RecordingError:
        pass
    return Options(
        reading={key: _carried(value) for key, value in read.items() if value not in (None, [])},
        identify=_identify({} if identify is None else identify),
        diagnose=_diagnose(diagnose),
        laws=_laws(diagnose),
        timeout=float(timeout),
        memory=None if memory is None else int(memory),
    )


def _carried(value: Any) -> Any:
    return os.fspath(value) if isinstance(value, os.PathLike) else plain(value)


def _identify(keywords: Mapping[str, Any]) -> dict[str, Any]:
    known = [name for name in IcrKinematics().get_params() if name not in _NOT_IDENTIFY]
    for name in _values.mapping("identify", keywords, "keywords of IcrKinematics as a dict"):
        if name not in known:
            expected = f"expected one of {', '.join(known)}"
            raise SettingError(f"identify {name}: {expected}", "identify")
    return {name: plain(value) for name, value in sorted(keywords.items())}


def _diagnose(diagnose: DiagnoseLike) -> dict[str, Any] | None:
    if diagnose is False:
        return None
    expected = "True, False, or keywords of diagnose as a dict"
    given = {} if diagnose is True else _values.mapping("diagnose", diagnose, expected)
    keywords = dict(given)
    for name in keywords:
        if name not in _DIAGNOSE:
            expected = f"expected one of {', '.join(_DIAGNOSE)}"
            raise SettingError(f"diagnose {name}: {expected}", "diagnose")
    try:
        full = keywords_of(**keywords)
    except DocumentError as error:
        raise SettingError(f"settings {error}", "settings") from None
    try:
        _trackdyn.diagnose([], Vehicle(Vehicle.names()[0])._inner, full, None)
    # all but the recordings is well
    except RecordingError:
        pass
    if full["settings"] is not None:
        keywords["settings"] = _trackdyn.from_toml(full["settings"][1])
    if "laws" in keywords:
        keywords["laws"] = full["laws"]
    return {name: plain(value) for name, value in sorted(keywords.items())}


def _laws(diagnose: DiagnoseLike) -> tuple[Law, ...]:
    """Laws among the keywords of a diagnosis."""
    return tuple(several_of(diagnose.get("laws"))) if isinstance(diagnose, Mapping) else ()


def fingerprint_of(vehicle: Vehicle) -> str:
    """Fingerprint of a vehicle with the code of its laws."""
    laws = of_ids(vehicle._inner.laws)
    return "+".join([vehicle.fingerprint, *(law.fingerprint for law in laws)])


def carried_laws(vehicle: Vehicle, options: Options) -> list[str]:
    """The laws that a vehicle and its diagnosis need, as texts that a job can hold.

    Raises
    ------
    SettingError
        For a law that cannot be sent to another process.
    """
    laws = {law.id: law for law in (*of_ids(vehicle._inner.laws), *options.laws)}
    try:
        return [base64.b64encode(carried(law)).decode() for law in laws.values()]
    except pickle.PicklingError as error:
        raise SettingError(f"diagnose: {error}", "diagnose") from None


def vehicles_of(vehicle: FleetVehicle, robots: Iterable[str]) -> dict[str, Vehicle]:
    """The vehicle of each robot.

    Raises
    ------
    InputError
        For one that cannot be read.
    """
    if isinstance(vehicle, (str, os.PathLike)) and "{robot}" in os.fspath(vehicle):
        path = os.fspath(vehicle)
        return {robot: vehicle_of(path.replace("{robot}", robot)) for robot in robots}
    same = vehicle_of(vehicle)
    return {robot: same for robot in robots}


def job_of(
    log: Log, vehicle: Vehicle, laws: list[str], options: Options, unless: str | None
) -> dict[str, Any]:
    """What a worker is told; `unless` is the SHA-256 of the log whose row is there already."""
    reading = dict(options.reading)
    for key in _PATHS:
        if key in reading:
            reading[key] = os.path.abspath(reading[key])
    return {
        "log": log.name,
        "path": os.path.abspath(log.name),
        "vehicle": vehicle.to_toml(),
        "vehicle_name": vehicle.name,
        "laws": laws,
        "reading": reading,
        "identify": options.identify,
        "diagnose": options.diagnose,
        "timeout": options.timeout,
        "memory": options.memory,
        "unless": unless,
    }
