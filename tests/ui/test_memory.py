"""Pausing and running the garbage collector."""

import gc

from pigaming_app.ui import memory as heap


def test_nothing_is_collected_while_many_objects_are_being_made() -> None:
    with heap.gc_paused():
        assert not gc.isenabled()
        assert not heap.collect()
    assert gc.isenabled()
    assert heap.collect()
