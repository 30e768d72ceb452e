"""Memory release: malloc thresholds and garbage collection."""

import ctypes
import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event

MMAP_THRESHOLD = -3  # M_MMAP_THRESHOLD in malloc.h
MANY = 20_000  # objects
LARGE = 128 * 1024  # bytes; glibc's initial value


def return_large_blocks() -> None:
    """Make glibc return each large block to the system when it is freed, as other C libraries do.

    By default it raises its mmap threshold to the largest block freed so far, up to 32 MB. Page rendering buffers then
    come from the heap, where smaller, longer-lived blocks keep up to 200 MB from being returned.
    """
    if sys.platform.startswith("linux"):
        try:
            ctypes.CDLL(None).mallopt(MMAP_THRESHOLD, LARGE)
        except (OSError, AttributeError):
            return  # another C library


def return_freed_blocks() -> None:
    """Return the free pages of the heap to the system; takes 6 to 10 ms after a match.

    By itself glibc returns only those at the end of the heap. Between blocks that live longer up to 110 MB stay, slowly
    more of them over the hours.
    """
    if sys.platform.startswith("linux"):
        try:
            ctypes.CDLL(None).malloc_trim(0)
        except (OSError, AttributeError):
            return  # another C library


_busy = Event()  # set while collection is paused


@contextmanager
def gc_paused() -> Iterator[None]:
    """Pause garbage collection in all threads: with this many new objects it would take long."""
    _busy.set()
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        _busy.clear()
        if enabled:
            gc.enable()


def settle() -> None:
    """Collect all garbage; exempt what is left from later collections where it is much, such as new modules.

    Traversing that would take 15 ms or more whenever a scene is freed.
    """
    if collect() and len(gc.get_objects()) > MANY:
        gc.freeze()


def collect() -> bool:
    """Collect all garbage, unless collection is paused; returns true if done."""
    if _busy.is_set():
        return False
    gc.collect()
    return True
