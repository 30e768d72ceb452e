"""Exclusive access to a file that several copies of the program may write.

The lock is the operating system's: it ends with the process that holds it, even if that is killed. Only the empty lock
file stays, and means nothing by itself.
"""

import contextlib
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from pigaming_app.storage.safe_files import NotSaved

TIMEOUT = 2.0  # seconds
RETRY_INTERVAL = 0.01  # seconds

if sys.platform == "win32":
    import msvcrt

    BUSY: tuple[type[OSError], ...] = (OSError,)

    def _take(handle: int) -> None:
        """Lock the first byte; the end of the process or of the handle unlocks it. Raises OSError if it is taken."""
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
else:
    import fcntl

    BUSY = (BlockingIOError,)

    def _take(handle: int) -> None:
        """Lock the file; the end of the process or of the handle unlocks it. Raises BlockingIOError if it is taken."""
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextlib.contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold the lock of `path`, the file `.NAME.lock` beside it. Raises NotSaved after TIMEOUT seconds of waiting.

    Where a lock file cannot be written, or the file system has no locks, the block runs without one.
    """
    with contextlib.ExitStack() as held:
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            handle = os.open(path.with_name(f".{path.name}.lock"), os.O_RDWR | os.O_CREAT, 0o666)
            held.callback(os.close, handle)
            _wait(handle, time.monotonic() + TIMEOUT)
        except TimeoutError:
            raise NotSaved(f"{path} was not saved: another copy of the arcade is using it.") from None
        except OSError:
            pass
        yield


def _wait(handle: int, until: float) -> None:
    """Take the lock as soon as it is free. Raises TimeoutError at `until`, OSError where there are no locks."""
    while True:
        try:
            _take(handle)
            return
        except BUSY:
            if time.monotonic() >= until:
                raise TimeoutError from None
            time.sleep(RETRY_INTERVAL)
