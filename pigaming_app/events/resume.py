"""The file that an unattended arcade was busy with, so that it goes on there after a crash or a power cut."""

import os
from pathlib import Path

from pigaming_app.storage.parsing import read_text
from pigaming_app.storage.safe_files import write_atomic

FILE = (
    "running.txt"  # in the data folder: one absolute path, and in a second line the name of the arcade, if it has one
)
MAX_BYTES = 10_000


def mark(data: Path, path: Path, arcade: str = "") -> None:
    """Note the file; the note is on the disk when this returns. Raises NotSaved."""
    write_atomic(data / FILE, os.fsencode(path.absolute()) + (f"\n{arcade}".encode() if arcade else b""))


def marked(data: Path) -> Path | None:
    """The noted file; None without a note, or if it cannot be read."""
    path = _lines(data)[0]
    return Path(path) if path else None


def marked_arcade(data: Path) -> str:
    """The noted name of the arcade; empty without one."""
    return _lines(data)[1]


def _lines(data: Path) -> tuple[str, str]:
    """Path and name; empty if the note cannot be read."""
    try:
        path, _, arcade = read_text(data / FILE, MAX_BYTES).partition("\n")
    except (OSError, ValueError):
        return "", ""
    return (path, arcade) if path.isprintable() and arcade.isprintable() else ("", "")


def clear(data: Path) -> None:
    """Delete the note. Raises OSError."""
    (data / FILE).unlink(missing_ok=True)
