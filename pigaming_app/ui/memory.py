"""When memory is given back: by the C library, and by the collection of garbage."""

import ctypes
import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event

MMAP_THRESHOLD = -3  # M_MMAP_THRESHOLD in malloc.h
LARGE = 128 * 1024  # bytes; where glibc begins


def return_large_blocks() -> None:
    """Let glibc return each large block to the system as soon as it is freed, as other C libraries do.

    By itself it raises its limit to the largest block freed so far, up to 32 MB. Then the buffers in which pages are
    painted come from the heap, and smaller blocks that outlive them keep up to 200 MB of it from being returned.
    """
    if sys.platform.startswith("linux"):
        try:
            ctypes.CDLL(None).mallopt(MMAP_THRESHOLD, LARGE)
        except (OSError, AttributeError):
            return  # another C library


_busy = Event()  # set while nothing may be collected


@contextmanager
def uncollected() -> Iterator[None]:
    """Collect no garbage meanwhile, in any thread: so many new objects are being made that it would take long."""
    _busy.set()
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        _busy.clear()
        if enabled:
            gc.enable()


def collect() -> bool:
    """Collect all garbage now, unless it would take long; whether it was done."""
    if _busy.is_set():
        return False
    gc.collect()
    return True
