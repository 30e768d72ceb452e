"""Fixed timestep: real time to simulation ticks.

A slow machine makes a match slow, never jumpy: ticks that exceed one frame's limit are dropped, so neither a dragged
window nor a suspended laptop causes a burst of ticks.
"""

import math

from pigaming_app.sim.world import DT

MAX_TICKS = 4  # ticks per frame at normal speed: full speed down to 12.5 frames a second


class FixedTimestep:
    """Accumulates real time into ticks; `blend` interpolates between the last two."""

    def __init__(self) -> None:
        self.pending = 0.0  # seconds not yet simulated

    def due(self, seconds: float, speed: float = 1.0) -> int:
        """The number of ticks due after `seconds` of real time, at `speed` times the simulation rate."""
        self.pending += seconds * speed
        max_ticks = math.ceil(MAX_TICKS * max(1.0, speed))
        ticks = int(self.pending / DT + 1e-9)
        if ticks > max_ticks:
            ticks, self.pending = max_ticks, max_ticks * DT
        self.pending = max(0.0, self.pending - ticks * DT)
        return ticks

    @property
    def blend(self) -> float:
        """Interpolation between the last two ticks, 0..1."""
        return min(1.0, self.pending / DT)
