"""Restarts of an unattended arcade, one line of JSON each, in the data folder.

A line has `time` (ISO 8601), `reason` ("crash" or "hang"), `detail`, `seconds` (how long the arcade had been running)
and `report` (its crash report, relative to the data folder; empty if there is none).
"""

import os
from dataclasses import dataclass
from pathlib import Path

from pigaming_app.storage.log import require_file
from pigaming_app.storage.parsing import ParseError, read_text
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.schema import from_json, to_json

FILE = "restarts.jsonl"
MAX_BYTES = 400_000  # size of the file above which its older half is dropped


@dataclass(frozen=True)
class Restart:
    """One restart; `time` is a local time with its offset from UTC."""

    time: str
    reason: str
    detail: str = ""
    seconds: float = 0.0
    report: str = ""


def append_restart(data: Path, restart: Restart) -> None:
    """Append a line, which is on the disk before this returns. Raises OSError or NotSaved."""
    path = data / FILE
    data.mkdir(parents=True, exist_ok=True)
    require_file(path)
    with path.open("a+b") as file:
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - 1))
        torn = file.read(1) not in (b"", b"\n")  # by a power cut
        file.write(b"\n" * torn + to_json(restart).encode() + b"\n")
        file.flush()
        os.fsync(file.fileno())
    if size > MAX_BYTES:
        kept = restarts(data)
        write_atomic(path, "".join(f"{to_json(one)}\n" for one in kept[len(kept) // 2 :]).encode())


def restarts(data: Path) -> list[Restart]:
    """All restarts, oldest first; damaged lines are left out. Empty if there are none or the file cannot be read."""
    try:
        lines = read_text(data / FILE, 2 * MAX_BYTES).splitlines()
    except (OSError, ValueError):
        return []
    return [found for line in lines if (found := _parsed(line))]


def _parsed(line: str) -> Restart | None:
    try:
        return from_json(line, Restart)
    except ParseError:
        return None
