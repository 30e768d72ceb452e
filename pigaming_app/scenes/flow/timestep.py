"""Real time becomes ticks of the world.

A slow machine makes a match slow, never jumpy: what cannot be caught up within one frame is dropped, so neither a
dragged window nor a sleeping laptop is followed by a burst of ticks.
"""

import math

from pigaming_app.sim.world import DT

MOST = 4  # ticks in one frame at normal speed: full speed down to 12.5 frames a second


class FixedTimestep:
    """How many ticks are due in this frame, and how far between two ticks the picture is."""

    def __init__(self) -> None:
        self.owed = 0.0  # seconds

    def due(self, seconds: float, speed: float = 1.0) -> int:
        """The ticks to make now that `seconds` of real time have passed, at `speed` times the pace of the world."""
        self.owed += seconds * speed
        most = math.ceil(MOST * max(1.0, speed))
        ticks = int(self.owed / DT + 1e-9)
        if ticks > most:
            ticks, self.owed = most, most * DT
        self.owed = max(0.0, self.owed - ticks * DT)
        return ticks

    @property
    def blend(self) -> float:
        """0: the picture shows the tick before the last one, 1: the last one."""
        return min(1.0, self.owed / DT)
