"""The paced arena waits for the reader of its pictures."""

import time
from collections.abc import Callable

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.realtime import OVERDUE, PacedArena
from pigaming_app.hardware.emulator.robots import STEP


def eventually(true: Callable[[], bool]) -> bool:
    end = time.monotonic() + 60.0
    while not true() and time.monotonic() < end:
        time.sleep(0.01)
    return true()


def test_time_passes_up_to_what_is_allowed_and_no_further():
    arena = EmulatedArena(refresh=1000)
    passing = PacedArena(arena)
    passing.limit = 0.2
    passing.start()
    try:
        assert eventually(lambda: arena.clock() > 0.2 - 2 * STEP)
        time.sleep(0.1)
        assert arena.clock() <= 0.2 + STEP
        passing.limit = 0.4
        assert eventually(lambda: arena.clock() > 0.3)
    finally:
        passing.close()
    ended = arena.clock()
    time.sleep(0.05)
    assert arena.clock() == ended


def test_time_waits_until_its_pictures_are_taken():
    arena = EmulatedArena(refresh=1000)
    passing = PacedArena(arena)
    passing.watched = True
    passing.start()
    try:
        assert eventually(lambda: arena.camera.overdue > OVERDUE)
        waited = arena.clock()
        time.sleep(0.1)
        assert arena.clock() - waited <= 2 * STEP
        assert arena.camera.newest() is not None
        assert eventually(lambda: [arena.camera.newest()] and arena.clock() > waited + 0.05)
    finally:
        passing.close()
