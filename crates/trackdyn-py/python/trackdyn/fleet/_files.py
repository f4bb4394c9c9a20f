"""Size, time and content of a log, which is a file or a folder."""

from __future__ import annotations

import hashlib
from pathlib import Path


def stat(path: Path) -> dict[str, int]:
    """Size (bytes) and latest change (ns) of a file, or of all files of a folder."""
    found = [file.stat() for file in _files(path)]
    return {
        "size_bytes": sum(one.st_size for one in found),
        "changed_ns": max((one.st_mtime_ns for one in found), default=0),
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
