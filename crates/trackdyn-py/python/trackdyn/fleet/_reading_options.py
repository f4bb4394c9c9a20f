"""Options of how logs are read, by the names and units that the program `trackdyn` has for them."""

from __future__ import annotations

import argparse
import math
from typing import Any

from .._reading import ReadingOptions

#: Options in degrees, where keywords are in radians.
_DEGREES = "mount_yaw"


def option_of(keyword: str) -> str:
    """The option for a keyword: one that takes several is repeated, so its name has no plural."""
    is_plural = keyword.endswith(("_joints", "_signals"))
    return "--" + (keyword[:-1] if is_plural else keyword).replace("_", "-")


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add an option for each keyword of :func:`trackdyn.read_recording`."""
    title = "how logs are read, as by the program trackdyn (trackdyn diagnose --help says more)"
    add = parser.add_argument_group(title).add_argument
    for keyword, annotation in ReadingOptions.__annotations__.items():
        kind = str(annotation)
        if "Sequence" in kind:
            # argparse takes a value that begins with a dash for an option
            sign = f"repeatable; one that runs backwards: {option_of(keyword)}=-NAME"
            text = "repeatable" if keyword == "accept" else sign
            add(option_of(keyword), dest=keyword, action="append", metavar="TEXT", help=text)
        elif "float" in kind or "int" in kind:
            unit = "DEG" if keyword == _DEGREES else "NUMBER"
            add(option_of(keyword), type=float if "float" in kind else int, metavar=unit)
        else:
            add(option_of(keyword), metavar="TEXT")


def reading_of(given: argparse.Namespace) -> dict[str, Any]:
    """The keywords that were given."""
    keywords = ReadingOptions.__annotations__
    found = {one: getattr(given, one) for one in keywords if getattr(given, one) is not None}
    if _DEGREES in found:
        found[_DEGREES] = math.radians(found[_DEGREES])
    return found
