"""Start pattern: each real robot first turns in a distinct pattern, so that faults are detected before it drives.

With a wrong lid, wiring or wheel the observed turns contradict the commands; see motion_check.
"""

from collections.abc import Collection

from pigaming_app.sim.plant import Twist
from pigaming_app.sim.world import HZ

RATE = 2.4  # rad/s
SLOT = round(0.7 * HZ)  # ticks of a turn
PATTERNS = ((1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0))  # by robot


class StartPattern:
    """Two turns of every robot, from when it is first seen."""

    def __init__(self) -> None:
        self._ticks: dict[int, int] = {}  # by robot, since its start

    def twists(self, seen: Collection[int]) -> dict[int, Twist]:
        """One tick: the twists (px/s, rad/s) of those robots that have not finished."""
        twists: dict[int, Twist] = {}
        for robot in seen:
            ticks = self._ticks.setdefault(robot, 0)
            if ticks < 2 * SLOT:
                self._ticks[robot] = ticks + 1
                twists[robot] = 0.0, RATE * PATTERNS[robot][ticks // SLOT]
        return twists
