"""Standard streams that may be closed, full, or of a narrow encoding: a job neither raises nor writes elsewhere."""

import contextlib
import io
import os
import sys
from typing import Any

from pigaming_app.storage.parsing import describe_error, one_line


class _Lossy(io.RawIOBase):
    """A file descriptor that takes what it can; the rest is lost."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor

    def writable(self) -> bool:
        return True

    def fileno(self) -> int:
        return self._descriptor

    def isatty(self) -> bool:
        return os.isatty(self._descriptor)

    def write(self, raw: Any) -> int:
        with contextlib.suppress(OSError):
            os.write(self._descriptor, raw)
        return len(raw)


def prepare() -> None:
    """Make standard error lossy, and keep files that are opened later off the numbers of streams that are closed."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
    if sys.__stderr__ is not None and sys.stderr is sys.__stderr__:
        raw = io.BufferedWriter(_Lossy(sys.__stderr__.fileno()))
        sys.stderr = io.TextIOWrapper(raw, sys.__stderr__.encoding, "backslashreplace", line_buffering=True)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")


def flushed(code: int) -> int:
    """The exit code of a job whose output has been written: 1 if its reader has gone, 2 if the disk is full."""
    if sys.stdout is None:
        return code
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        _mute()
        return code or 1
    except OSError as error:
        _mute()
        say(f"the output cannot be written: {describe_error(error)}")
        return 2
    return code


def say(sentence: str) -> None:
    """One line on standard error; standard output belongs to the job."""
    with contextlib.suppress(OSError):
        print(f"PiGaming: {one_line(sentence)}", file=sys.stderr, flush=True)


def _mute() -> None:
    """Let what is still to be written vanish, so that the interpreter can end in silence."""
    with contextlib.suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
