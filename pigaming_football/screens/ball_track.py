"""Where the ball is between two ticks, how it has rolled, and its trail."""

import math

from pigaming_app.api.rules import HZ

from ..state import Ball
from . import sprites

FAST, TAIL = 260.0, 0.016  # px/s from which the ball has a trail; s between its spots
JUMP = 120.0  # px in a tick: the ball was placed, not rolled
FADES = 0.22  # s in which the trail fades


class BallTrack:
    """The ball of a match or of a replay, px in the arena."""

    def __init__(self, ball: Ball) -> None:
        self.was = self.now = (ball.x, ball.y)
        self.rolled, self.direction, self.out = 0.0, 0.0, ball.out
        self.tail: list[tuple[float, float, float]] = []  # x, y, time

    def follow(self, ball: Ball, time: float) -> None:
        """Record where the ball is after a tick, `time` s on the clock of the pictures."""
        self.was, self.now = self.now, (ball.x, ball.y)
        dx, dy = self.now[0] - self.was[0], self.now[1] - self.was[1]
        way, placed = math.hypot(dx, dy), ball.out or self.out
        self.out = ball.out
        if way > JUMP or placed:
            self.was, self.tail = self.now, []
            return
        if way > 0.3:
            self.direction = math.atan2(dy, dx)
            self.rolled += way / sprites.RADIUS
        if way > FAST / HZ and not ball.holder and (not self.tail or time - self.tail[-1][2] >= TAIL):
            self.tail.append((ball.x, ball.y, time))
        self.tail = [spot for spot in self.tail if time - spot[2] < FADES]

    def at(self, blend: float) -> tuple[float, float]:
        """Where the ball is between the last two ticks."""
        (x, y), (to_x, to_y) = self.was, self.now
        return x + (to_x - x) * blend, y + (to_y - y) * blend

    def phase(self) -> int:
        """The position, of PHASES, of the rolled ball."""
        return sprites.phase_of(self.rolled)
