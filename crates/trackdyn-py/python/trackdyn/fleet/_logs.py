"""Logs of a fleet: which there are, whose they are, and when they were recorded."""

from __future__ import annotations

import glob
import os
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path, PurePath
from typing import Union

from .. import _values
from .._errors import SettingError

#: A regular expression with the group ``robot``, or a function from a path to a name.
RobotLike = Union[str, Callable[[str], str], None]

#: A format of ``datetime.strptime``, or a function from a path to a time or to Unix seconds.
TimeLike = Union[str, Callable[[str], Union[datetime, float]], None]


@dataclass(frozen=True)
class Log:
    """A log by the name that its row has.

    Attributes
    ----------
    name : str
        Its path as it was asked for.
    robot : str
        Whose it is.
    time_ns : int or None
        When it began, Unix time in ns; None: its first stamp tells.
    """

    name: str
    robot: str
    time_ns: int | None


def find(logs: str | os.PathLike[str] | Iterable[str | os.PathLike[str]]) -> list[str]:
    """Paths of all logs, sorted, each once. Patterns have ``*``, ``?``, ``[...]`` and ``**``."""
    is_one = isinstance(logs, (str, os.PathLike)) or _values.is_single(logs)
    patterns: list[object] = [logs] if is_one else list(logs)  # type: ignore[arg-type]
    found: set[str] = set()
    for pattern in [_values.path("logs", one) for one in patterns]:
        paths = [pattern] if os.path.exists(pattern) else glob.glob(pattern, recursive=True)
        if not paths:
            raise SettingError(f"logs {pattern}: no such file: expected paths or patterns", "logs")
        found.update(PurePath(os.path.normpath(path)).as_posix() for path in paths)
    if not found:
        raise SettingError("logs: none given: expected a path or a pattern", "logs")
    return sorted(found)


def name_all(paths: Iterable[str], robot: RobotLike, time: TimeLike) -> list[Log]:
    """The logs with robot and time.

    Raises
    ------
    SettingError
        For a path that `robot` or `time` does not fit.
    """
    if callable(robot):
        of_robot = robot
        pattern = None
    else:
        of_robot = None
        pattern = None if robot is None else _compiled(_values.text("robot", robot))
    if time is not None and not callable(time):
        _values.text("time", time)
    if isinstance(time, str) and (pattern is None or "time" not in pattern.groupindex):
        raise SettingError(f"time {time}: expected a group (?P<time>...) in robot", "time")
    paths = list(paths)
    others = [path for path in paths if pattern and not _robot_in(pattern, path)]
    if pattern and others:
        found = f"does not match {len(others)} of {len(paths)} logs, such as {others[0]}"
        raise SettingError(f"robot {pattern.pattern}: {found}", "robot")
    return [_named(path, of_robot, pattern, time) for path in paths]


def _robot_in(pattern: re.Pattern[str], path: str) -> str | None:
    match = pattern.search(path)
    return match["robot"] if match else None


def _compiled(robot: str) -> re.Pattern[str]:
    try:
        pattern = re.compile(robot)
    except re.error as error:
        raise SettingError(f"robot {robot}: not a regular expression: {error}", "robot") from None
    if "robot" not in pattern.groupindex:
        expected = r"expected a group (?P<robot>...), such as (?P<robot>robot\d+)"
        raise SettingError(f"robot {robot}: {expected}", "robot")
    return pattern


def _named(
    path: str,
    of_robot: Callable[[str], str] | None,
    pattern: re.Pattern[str] | None,
    time: TimeLike,
) -> Log:
    text = None
    if of_robot is not None:
        robot = str(of_robot(path))
    elif pattern is not None and (match := pattern.search(path)):
        robot = match["robot"]
        text = match.groupdict().get("time")
    else:
        robot = Path(path).absolute().parent.name
    if callable(time):
        return Log(path, robot, _nanoseconds(time(path)))
    return Log(path, robot, None if text is None else _parsed(path, text, time))


def _parsed(path: str, text: str, form: str | None) -> int:
    """The time that a text says, in UTC where it names no zone."""
    try:
        at = datetime.strptime(text, form) if form else datetime.fromisoformat(text)
    except ValueError:
        expected = form or "a time such as 2026-05-17T09:30:00; another format is named by time"
        raise SettingError(f"time {text} of the log {path}: expected {expected}", "time") from None
    return _nanoseconds(at)


def _nanoseconds(at: datetime | float) -> int:
    if isinstance(at, datetime):
        at = at if at.tzinfo else at.replace(tzinfo=timezone.utc)
        # whole microseconds: a float of 1.8e9 s has 2e-7 s
        since = at - datetime(1970, 1, 1, tzinfo=timezone.utc)
        return (since.days * 86_400 + since.seconds) * 10**9 + since.microseconds * 1000
    return round(float(at) * 1e9)
