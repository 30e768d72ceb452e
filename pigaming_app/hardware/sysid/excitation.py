"""Excitation for identification: random twists of all speeds and curvatures, each held for a moment."""

from collections.abc import Sequence
from math import atan2, cos, sin, sqrt
from random import Random

from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.plant import Sighting, Twist
from pigaming_app.sim.world import HEIGHT, ROBOTS, WIDTH

SHORT, LONG = 0.3, 1.0  # s for which a step is held
FAST, SPIN = 320.0, 3.0  # px/s, rad/s
SLOW = 0.3  # share of slow steps
ROOM = 170.0  # px from an edge or another robot within which a step leads away


class ExcitationPattern:
    """Random twists for all robots; equal seeds draw equal steps."""

    def __init__(self, seed: int = 1) -> None:
        self._random = Random(f"dance {seed}")
        self._until = [0.0] * ROBOTS
        self._step: list[Twist] = [(0.0, 0.0)] * ROBOTS

    def twists(self, now: float, sightings: Sequence[Sighting]) -> list[Twist]:
        """Twist of each robot at time `now` (s), px/s and rad/s."""
        for robot, seen in enumerate(sightings):
            if now < self._until[robot]:
                continue
            self._until[robot] = now + self._random.uniform(SHORT, LONG)
            self._step[robot] = self._drawn(seen, _repelled(robot, sightings))
        return self._step

    def _drawn(self, seen: Sighting, away: tuple[float, float]) -> Twist:
        """A random step; near an edge or another robot, one that leads away from it."""
        random = self._random
        scale = 0.2 if random.random() < SLOW else 1.0
        speed, turn = scale * random.uniform(-FAST, FAST), scale * random.uniform(-SPIN, SPIN)
        if away != (0.0, 0.0):
            ahead = away[0] * cos(seen.heading) + away[1] * sin(seen.heading)
            speed = abs(speed) if ahead > 0.0 else -abs(speed)
            wanted = turn_to(atan2(away[1], away[0]) - seen.heading - (0.0 if ahead > 0.0 else 3.14159))
            turn = abs(turn) if wanted > 0.0 else -abs(turn)
        return speed, turn


def _repelled(robot: int, sightings: Sequence[Sighting]) -> tuple[float, float]:
    """Direction away from close edges and robots, px; (0, 0) if there are none."""
    own = sightings[robot]
    x = max(0.0, ROOM - own.x) - max(0.0, own.x - (WIDTH - ROOM))
    y = max(0.0, ROOM - own.y) - max(0.0, own.y - (HEIGHT - ROOM))
    for i, other in enumerate(sightings):
        dx, dy = own.x - other.x, own.y - other.y
        apart = sqrt(dx * dx + dy * dy)
        if i != robot and 0.0 < apart < ROOM:
            x, y = x + dx / apart * (ROOM - apart), y + dy / apart * (ROOM - apart)
    return x, y
