"""The emulated arena for people: its time passes like the real one, but waits for those who look and drive.

A busy computer sees the arena slowed down, and never late: no picture is missed and no command comes too late because
the computer had other things to do. `Live` is the arena whose time waits for nobody.
"""

import time
from math import inf
from threading import Event, Thread
from typing import Self

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.robots import STEP

LOOK_EVERY = 0.002  # s
OVERDUE = 0.02  # s for which a picture may wait to be looked at
MOST = 0.1  # s that are caught up after a hold-up


class PacedArena:
    """Lets an arena's time pass in a thread until close(). Up to `limit` (s of its clock), and while it is `watched`
    no faster than its pictures are taken.
    """

    def __init__(self, arena: EmulatedArena) -> None:
        self.arena = arena
        self.limit = inf
        self.watched = False
        self._ended = Event()
        self._thread = Thread(target=self._run, name="emulated arena", daemon=True)

    def start(self) -> Self:
        """Begin."""
        self._thread.start()
        return self

    def close(self) -> None:
        """Stop time. May be called again."""
        self._ended.set()
        self._thread.join(timeout=1.0)

    def _run(self) -> None:
        last, owed = time.monotonic(), 0.0
        while not self._ended.wait(LOOK_EVERY):
            now = time.monotonic()
            owed, last = min(MOST, owed + now - last), now
            if self.watched and self.arena.camera.overdue > OVERDUE:
                owed = 0.0
            steps = int(min(owed, self.limit - self.arena.clock()) / STEP)
            for _ in range(steps):
                self.arena.advance(STEP)
                owed -= STEP
            if self.arena.clock() >= self.limit - STEP:
                owed = 0.0
