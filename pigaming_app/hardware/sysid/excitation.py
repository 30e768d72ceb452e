"""A dance that tells much about a robot's wheels: all speeds, all bends, slow and fast, each held for a moment."""

from collections.abc import Sequence
from math import atan2, cos, sin, sqrt
from random import Random

from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.plant import Sighting, Twist
from pigaming_app.sim.world import HEIGHT, ROBOTS, WIDTH

SHORT, LONG = 0.3, 1.0  # s for which a step is held
FAST, SPIN = 320.0, 3.0  # px/s, rad/s
SLOW = 0.3  # share of the steps that are slow
ROOM = 170.0  # px from the edge, or from another robot, at which it turns back


class ExcitationPattern:
    """What the robots are asked, by the clock; the same seed dances the same steps."""

    def __init__(self, seed: int = 1) -> None:
        self._random = Random(f"dance {seed}")
        self._until = [0.0] * ROBOTS
        self._step: list[Twist] = [(0.0, 0.0)] * ROBOTS

    def twists(self, now: float, sightings: Sequence[Sighting]) -> list[Twist]:
        """What to ask of each robot now."""
        for robot, seen in enumerate(sightings):
            if now < self._until[robot]:
                continue
            self._until[robot] = now + self._random.uniform(SHORT, LONG)
            self._step[robot] = self._drawn(seen, _repelled(robot, sightings))
        return self._step

    def _drawn(self, seen: Sighting, away: tuple[float, float]) -> Twist:
        """Any step; near an edge or another robot, one that leads away from it."""
        random = self._random
        scale = 0.2 if random.random() < SLOW else 1.0
        speed, turn = scale * random.uniform(-FAST, FAST), scale * random.uniform(-SPIN, SPIN)
        if away != (0.0, 0.0):
            ahead = away[0] * cos(seen.heading) + away[1] * sin(seen.heading)
            speed = abs(speed) if ahead > 0.0 else -abs(speed)
            wished = turn_to(atan2(away[1], away[0]) - seen.heading - (0.0 if ahead > 0.0 else 3.14159))
            turn = abs(turn) if wished > 0.0 else -abs(turn)
        return speed, turn


def _repelled(robot: int, sightings: Sequence[Sighting]) -> tuple[float, float]:
    """The direction away from what is near; (0, 0) if nothing is."""
    own = sightings[robot]
    x = max(0.0, ROOM - own.x) - max(0.0, own.x - (WIDTH - ROOM))
    y = max(0.0, ROOM - own.y) - max(0.0, own.y - (HEIGHT - ROOM))
    for i, other in enumerate(sightings):
        dx, dy = own.x - other.x, own.y - other.y
        apart = sqrt(dx * dx + dy * dy)
        if i != robot and 0.0 < apart < ROOM:
            x, y = x + dx / apart * (ROOM - apart), y + dy / apart * (ROOM - apart)
    return x, y
