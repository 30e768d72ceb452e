"""An end for code of others that does not end, such as an endless loop at import."""

import ctypes
import threading
from collections.abc import Iterator
from contextlib import contextmanager

AGAIN = 1.0  # s after which the exception is raised once more, if the code has caught it


class TookTooLong(BaseException):
    """Raised within the code, whose handlers of `Exception` do not catch it."""


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
