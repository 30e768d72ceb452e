"""Standard streams that may be closed, full, or of a narrow encoding: none of that raises or misplaces output."""

import contextlib
import io
import os
import sys
from typing import Any

from pigaming_app.storage.parsing import describe_error, one_line


class _Lossy(io.RawIOBase):
    """A file descriptor whose failed writes are dropped."""

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
    """Make standard error lossy, and occupy the descriptors of closed streams, so that no later file gets one."""
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
        print_error(f"the output cannot be written: {describe_error(error)}")
        return 2
    return code


def print_error(line: str) -> None:
    """Print a line on standard error; standard output is reserved for the job."""
    with contextlib.suppress(OSError):
        print(f"PiGaming: {one_line(line)}", file=sys.stderr, flush=True)


def sentence(error: OSError) -> str:
    """An error of the system as one line: the file, or the output, and the reason."""
    if error.strerror is None:  # NotSaved
        return str(error)
    return f"{error.filename or 'the output cannot be written'}: {describe_error(error)}"


def _mute() -> None:
    """Discard unwritten output, so that the interpreter can exit silently."""
    with contextlib.suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
