"""An end for code of others that does not end, such as an endless loop at import or in a frame."""

import ctypes
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic
from types import FrameType
from typing import NoReturn, Self

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
        self._raised = False  # since then; it may still be pending

    def __enter__(self) -> Self:
        self._watched, self._ended = threading.get_ident(), threading.Event()
        self.beat()
        threading.Thread(target=self._watch, args=(self._ended,), name="watchdog", daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self.beat()

    def beat(self) -> None:
        """Begin anew. For the watched thread only."""
        with self._lock:
            if self._raised:
                self._raised = False
                try:  # noqa: SIM105, a pending one would be raised within `suppress`
                    _raise_here()
                except TookTooLong:
                    pass
            self._last = monotonic()

    def _watch(self, ended: threading.Event) -> None:
        while not ended.wait(self._limit / 10):
            with self._lock:
                if monotonic() - self._last > self._limit and self._in_foreign_code():
                    self._raised = True
                    raise_in(self._watched)

    def _in_foreign_code(self) -> bool:
        """The frame is kept no longer than this takes: its variables live as long, as a view that locks a surface."""
        frame = sys._current_frames().get(self._watched)
        return frame is not None and self._is_foreign(frame)


@contextmanager
def time_limit(seconds: float) -> Iterator[None]:
    """Raises TimeoutError after so long, at the next Python instruction of this thread, not within a blocking call."""
    thread, lock, done = threading.get_ident(), threading.Lock(), threading.Event()
    raised = False

    def watch() -> None:
        nonlocal raised
        wait = seconds
        while not done.wait(wait):
            with lock:
                if not done.is_set():
                    raised = True
                    raise_in(thread)
            wait = AGAIN

    try:
        try:
            threading.Thread(target=watch, name="time limit", daemon=True).start()
            yield
        finally:
            with lock:
                done.set()
                if raised:
                    try:  # noqa: SIM105, as above
                        _raise_here()
                    except TookTooLong:
                        pass
    except TookTooLong as error:
        done.set()
        raise TimeoutError(f"not done after {seconds:g} s").with_traceback(error.__traceback__) from None


def _raise_here() -> NoReturn:
    """Raise the pending exception, or another one, so that none is pending afterwards.

    Withdrawing it by NULL would leave the interpreter looking for one at every jump and call: up to a sixth
    slower, and endless under a profiler.
    """
    raise_in(threading.get_ident())
    while True:
        pass


def raise_in(thread: int) -> None:
    """Raise TookTooLong in a thread at its next instruction."""
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(TookTooLong))
