"""How the C library keeps memory that has been freed."""

import ctypes
import sys

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
