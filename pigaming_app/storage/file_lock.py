"""Exclusive access to a file that several instances of the program may write.

The lock is an operating system lock, released when its process ends, even if killed. The empty lock file remains, which
is harmless.
"""

import contextlib
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from pigaming_app.storage.safe_files import NotSaved

TIMEOUT = 2.0  # s
RETRY_INTERVAL = 0.01  # s

if sys.platform == "win32":
    import msvcrt

    BUSY: tuple[type[OSError], ...] = (OSError,)

    def _take(handle: int) -> None:
        """Lock the first byte; closing the handle or ending the process unlocks it. Raises OSError if locked."""
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
else:
    import fcntl

    BUSY = (BlockingIOError,)

    def _take(handle: int) -> None:
        """Lock the file; closing the handle or ending the process unlocks it. Raises BlockingIOError if locked."""
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextlib.contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold the lock of `path`, the file `.NAME.lock` in its folder. Raises NotSaved after TIMEOUT.

    If the lock file cannot be written, or the file system has no locks, the block runs without a lock.
    """
    with contextlib.ExitStack() as stack:
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            handle = os.open(path.with_name(f".{path.name}.lock"), os.O_RDWR | os.O_CREAT, 0o666)
            stack.callback(os.close, handle)
            _wait(handle, time.monotonic() + TIMEOUT)
        except TimeoutError:
            raise NotSaved(f"{path} was not saved: another copy of the arcade is using it.") from None
        except OSError:
            pass
        yield


def hold(path: Path) -> int | None:
    """Lock a file, which is created, until its handle is closed or this process ends. The handle; None: impossible."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
    except OSError:
        return None
    try:
        _take(handle)
    except OSError:
        os.close(handle)
        return None
    return handle


def is_held(path: Path) -> bool:
    """True if a process holds the lock of a file, see `hold`."""
    try:
        handle = os.open(path, os.O_RDWR)
    except OSError:
        return False
    try:
        _take(handle)
    except OSError as error:
        return isinstance(error, BUSY)
    finally:
        os.close(handle)
    return False


def _wait(handle: int, deadline: float) -> None:
    """Take the lock once it is free. Raises TimeoutError at `deadline`, OSError if locks are not supported."""
    while True:
        try:
            _take(handle)
            return
        except BUSY:
            if time.monotonic() >= deadline:
                raise TimeoutError from None
            time.sleep(RETRY_INTERVAL)
