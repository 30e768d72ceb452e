"""The file that an unattended arcade was busy with, so that it goes on there after a crash or a power cut."""

import os
from pathlib import Path

from pigaming_app.storage.parsing import read_text
from pigaming_app.storage.safe_files import write_atomic

FILE = "running.txt"  # in the data folder: one absolute path
MAX_BYTES = 10_000


def mark(data: Path, path: Path) -> None:
    """Note the file; the note is on the disk when this returns. Raises NotSaved."""
    write_atomic(data / FILE, os.fsencode(path.absolute()))


def marked(data: Path) -> Path | None:
    """The noted file; None without a note, or if it cannot be read."""
    try:
        text = read_text(data / FILE, MAX_BYTES)
    except (OSError, ValueError):
        return None
    return Path(text) if text and text.isprintable() else None


def clear(data: Path) -> None:
    """Delete the note. Raises OSError."""
    (data / FILE).unlink(missing_ok=True)
