"""How real robots begin: each turns to and fro in a pattern of its own, so that a fault is found before they drive.

A robot whose lid, wires or wheels are wrong turns in another pattern than its commands; see motion_check.
"""

from collections.abc import Collection

from pigaming_app.sim.plant import Twist
from pigaming_app.sim.world import HZ

RATE = 2.4  # rad/s
SLOT = round(0.7 * HZ)  # ticks of a turn
PATTERNS = ((1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0))  # by robot


class StartPattern:
    """Lets every robot turn twice, from when it is first seen."""

    def __init__(self) -> None:
        self._ticks: dict[int, int] = {}  # by robot, since it began

    def twists(self, seen: Collection[int]) -> dict[int, Twist]:
        """One tick: what to ask of those robots that have not finished."""
        asked: dict[int, Twist] = {}
        for robot in seen:
            ticks = self._ticks.setdefault(robot, 0)
            if ticks < 2 * SLOT:
                self._ticks[robot] = ticks + 1
                asked[robot] = 0.0, RATE * PATTERNS[robot][ticks // SLOT]
        return asked
