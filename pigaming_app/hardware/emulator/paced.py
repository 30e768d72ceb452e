"""Emulated arena at the user's pace: its time follows real time, but waits for the reader of its pictures.

On a busy computer the arena slows down instead of losing pictures or delaying commands. `RealtimeArena` does not wait.
"""

import time
from math import inf
from threading import Event, Thread
from typing import Self

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.robots import STEP

LOOK_EVERY = 0.002  # s
OVERDUE = 0.02  # s for which a picture may wait to be read
MAX_LAG = 0.1  # s to catch up after a delay


class PacedArena:
    """Advances an arena in a thread until `close`, up to `limit` (s of its clock).

    While `watched`, it advances no faster than its pictures are read.
    """

    def __init__(self, arena: EmulatedArena) -> None:
        self.arena = arena
        self.limit = inf
        self.watched = False
        self._ended = Event()
        self._thread = Thread(target=self._run, name="emulated arena", daemon=True)

    def start(self) -> Self:
        self._thread.start()
        return self

    def close(self) -> None:
        """Stop time. Idempotent."""
        self._ended.set()
        self._thread.join(timeout=1.0)

    def _run(self) -> None:
        last, owed = time.monotonic(), 0.0
        while not self._ended.wait(LOOK_EVERY):
            now = time.monotonic()
            owed, last = min(MAX_LAG, owed + now - last), now
            if self.watched and self.arena.camera.overdue > OVERDUE:
                owed = 0.0
            steps = int(min(owed, self.limit - self.arena.clock()) / STEP)
            for _ in range(steps):
                self.arena.advance(STEP)
                owed -= STEP
            if self.arena.clock() >= self.limit - STEP:
                owed = 0.0
