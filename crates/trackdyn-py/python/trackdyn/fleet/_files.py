"""Look and content of a log, which is a file or a folder."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any


def look(path: Path) -> dict[str, Any]:
    """How a log looks without being read: its size, and a fingerprint of the name, the size and the
    time of change of each of its files."""
    found = {file.relative_to(path).as_posix(): file.stat() for file in _files(path)}
    sizes = [(name, one.st_size, one.st_mtime_ns) for name, one in found.items()]
    return {
        "size_bytes": sum(size for _, size, _ in sizes),
        "look": hashlib.sha256(json.dumps(sizes).encode()).hexdigest()[:16],
    }


def content(path: Path) -> str:
    """SHA-256 of the bytes of a file, or of names and bytes of all files of a folder."""
    digest = hashlib.sha256()
    for file in _files(path):
        if file != path:
            digest.update(file.relative_to(path).as_posix().encode() + b"\0")
        with file.open("rb") as stream:
            while block := stream.read(1 << 20):
                digest.update(block)
    return digest.hexdigest()


def _files(path: Path) -> list[Path]:
    return sorted(one for one in path.rglob("*") if one.is_file()) if path.is_dir() else [path]
