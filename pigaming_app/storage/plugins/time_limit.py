"""An end for code of others that does not end, such as an endless loop at import or in a frame."""

import ctypes
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic
from types import FrameType
from typing import Self

AGAIN = 1.0  # s after which the exception is raised once more, if the code has caught it


class TookTooLong(BaseException):
    """Raised within the code, whose handlers of `Exception` do not catch it."""

    def __str__(self) -> str:
        return "it did not end"


class Watchdog:
    """Within this context, raises TookTooLong in its thread `limit` s after a `beat`, if `is_foreign(frame)` then.

    Like `time_limit` for each frame of a loop, with one thread for all.
    """

    def __init__(self, limit: float, is_foreign: Callable[[FrameType], bool]) -> None:
        self._limit, self._is_foreign = limit, is_foreign
        self._lock, self._ended = threading.Lock(), threading.Event()
        self._watched, self._last = 0, 0.0  # thread, and time of its last beat

    def __enter__(self) -> Self:
        self._watched, self._ended = threading.get_ident(), threading.Event()
        self.beat()
        threading.Thread(target=self._watch, args=(self._ended,), name="watchdog", daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self.beat()

    def beat(self) -> None:
        """Begin anew."""
        with self._lock:
            self._last = monotonic()
            _raise_in(self._watched, None)

    def _watch(self, ended: threading.Event) -> None:
        while not ended.wait(self._limit / 10):
            with self._lock:
                if monotonic() - self._last > self._limit and self._in_foreign_code():
                    _raise_in(self._watched, TookTooLong)

    def _in_foreign_code(self) -> bool:
        """The frame is kept no longer than this takes: its variables live as long, as a view that locks a surface."""
        frame = sys._current_frames().get(self._watched)
        return frame is not None and self._is_foreign(frame)


@contextmanager
def time_limit(seconds: float) -> Iterator[None]:
    """Raises TimeoutError after so long, at the next Python instruction of this thread, not within a blocking call."""
    thread, lock, done = threading.get_ident(), threading.Lock(), threading.Event()

    def watch() -> None:
        wait = seconds
        while not done.wait(wait):
            with lock:
                if not done.is_set():
                    _raise_in(thread, TookTooLong)
            wait = AGAIN

    try:
        try:
            threading.Thread(target=watch, name="time limit", daemon=True).start()
            yield
        finally:
            with lock:
                done.set()
                _raise_in(thread, None)
    except TookTooLong as error:
        done.set()
        raise TimeoutError(f"not done after {seconds:g} s").with_traceback(error.__traceback__) from None


def _raise_in(thread: int, error: type[BaseException] | None) -> None:
    """Raise an exception in a thread at its next instruction; None: withdraw one that is not raised yet."""
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(error) if error else None)
