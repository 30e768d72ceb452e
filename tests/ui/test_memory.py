"""Pausing and running the garbage collector; return of freed memory."""

import gc
import sys
import weakref

import pytest

from pigaming_app.jobs.bench.memory import resident_mb
from pigaming_app.ui import memory as heap


class Loop:
    """An object in a reference cycle."""

    itself: "Loop"


BLOCK, BLOCKS, KEPT = 60_000, 1600, 80  # bytes, below the threshold of a mapping of its own; one of so many is kept


def test_nothing_is_collected_while_many_objects_are_being_made() -> None:
    with heap.gc_paused():
        assert not gc.isenabled()
        assert not heap.collect()
    assert gc.isenabled()
    assert heap.collect()


@pytest.mark.parametrize("many", [1_000, 10**9])
def test_much_that_stays_is_not_traversed_again(many: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(heap, "MANY", many)
    loop = Loop()
    loop.itself, gone = loop, weakref.ref(loop)
    gc.unfreeze()  # what an earlier arcade in this process has frozen
    try:
        heap.settle()
        assert (gc.get_freeze_count() > 10_000) == (many == 1_000)
        del loop
        heap.collect()
        assert (gone() is None) == (many != 1_000)
    finally:
        gc.unfreeze()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="glibc")
def test_memory_between_blocks_that_live_longer_is_returned() -> None:
    blocks = [b"x" * BLOCK for _ in range(BLOCKS)]
    kept = blocks[::KEPT]
    heap.return_freed_blocks()
    full = resident_mb()
    del blocks
    heap.return_freed_blocks()
    left = resident_mb()
    assert full is not None
    assert left is not None
    assert full - left > 0.8 * BLOCK * (BLOCKS - len(kept)) / 2**20
