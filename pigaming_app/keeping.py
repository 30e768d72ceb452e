"""Files that must survive a pulled plug: written whole or not at all, and never lost in silence.

`keep` writes one, with the version before it beside it as `.bak`. `recall` reads one; a file that cannot be read is
put aside under another name, the `.bak` takes its place, and a sentence says so.
"""

import contextlib
import errno
import os
import tempfile
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import TypeVar

T = TypeVar("T")


class NotSaved(Exception):
    """A file was not written; the one before it is intact. The text is one sentence for the operator."""


def keep(path: Path, text: str) -> None:
    """Write `text` (UTF-8) to `path`, whole or not at all; what stood there becomes `.bak`. Raises NotSaved."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with contextlib.suppress(FileNotFoundError):
            _write_whole(_backup(path), path.read_bytes())
        _write_whole(path, text.encode())
    except OSError as error:
        raise NotSaved(f"{path} was not saved: {_reason(error)}.") from error


def recall(path: Path, parse: Callable[[str], T]) -> tuple[T | None, list[str]]:
    """What `parse` (which raises ValueError) makes of the file, and what to tell the operator. No file: None."""
    try:
        return parse(_text(path)), []
    except FileNotFoundError:
        return None, []
    except (OSError, ValueError) as error:
        said = f"{path} cannot be read ({_reason(error)}); {_put_aside(path)}"
    backup = _backup(path)
    try:
        restored = parse(_text(backup))
    except (OSError, ValueError):
        return None, [f"{said}; starting afresh."]
    with contextlib.suppress(OSError):
        _write_whole(path, backup.read_bytes())
    return restored, [f"{said}; the version before it is back."]


def _write_whole(path: Path, raw: bytes) -> None:
    handle, name = tempfile.mkstemp(prefix=f".{path.name}-", dir=path.parent)
    try:
        with open(handle, "wb") as file:
            file.write(raw)
            file.flush()
            os.fsync(file.fileno())
        os.replace(name, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(name)
        raise


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8-sig")  # Notepad writes the mark


def _backup(path: Path) -> Path:
    return path.with_name(f"{path.name}.bak")


def _put_aside(path: Path) -> str:
    aside = path.with_name(f"{path.name}.broken-{datetime.now():%Y-%m-%d-%H%M%S}")
    try:
        os.replace(path, aside)
    except OSError as error:
        return f"it stays where it is ({_reason(error)})"
    return f"kept as {aside.name}"


def _reason(error: Exception) -> str:
    if isinstance(error, UnicodeDecodeError):
        return "it is not text in UTF-8"
    if not isinstance(error, OSError):
        return str(error)
    match error.errno:
        case errno.ENOSPC | errno.EDQUOT:
            return "the disk is full"
        case errno.EROFS | errno.EACCES | errno.EPERM:
            return "no permission"
        case _:
            return error.strerror or str(error)
