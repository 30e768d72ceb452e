"""Fading tread marks of robots, stamped according to the direction of travel."""

import math
from collections import deque

from pigaming_app.scenes.views.sprites.effects import TREAD_LEVELS, TURNS, tread
from pigaming_app.ui.draw.sprites import Batch, put, step

APART = 13.0  # px between two marks
OVER = 10.0  # px, minimum distance to any mark: moving to and fro would draw crosses
LASTS = 3.0  # s
MAX_MARKS = 30  # limit per robot


class TreadMarks:
    """Tread marks of one robot, in canvas px."""

    def __init__(self, player: int) -> None:
        self.player = player
        self.marks: deque[tuple[float, float, float, int]] = deque(maxlen=MAX_MARKS)
        self.last: tuple[float, float] | None = None

    def add(self, x: float, y: float, heading: float, now: float) -> None:
        """Record the robot's position at time `now`, s."""
        if self.last is None or math.dist(self.last, (x, y)) > 10 * APART:
            self.last = x, y
            return
        dx, dy = x - self.last[0], y - self.last[1]
        if dx * dx + dy * dy >= APART * APART:
            self.last = x, y
            if not any(abs(x - mx) + abs(y - my) < OVER for _, mx, my, _ in self.marks):
                ahead = dx * math.cos(heading) + dy * math.sin(heading) >= 0.0
                self.marks.append((now, x, y, step(heading if ahead else heading + math.pi, TURNS)))

    def draw(self, batch: Batch, now: float) -> None:
        """Draw the live marks."""
        marks = self.marks
        while marks and now - marks[0][0] >= LASTS:
            marks.popleft()
        for born, x, y, turn in marks:
            put(batch, tread(self.player, turn, math.ceil(TREAD_LEVELS * (1.0 - (now - born) / LASTS))), x, y)
