"""Floor marks of the brain overlay: the rose round a robot, dotted lines to its percepts, its path and destination.

All marks are additive light and none lies on a robot: the rose begins outside the barrel, lines end short of their
target, and marks that would cover another robot (a camera may be reading its marker) are omitted.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import pygame

from pigaming_app.ai.brain.thoughts import (
    BULLET,
    GOAL,
    MATE,
    OPPONENT,
    PERSON,
    PETALS,
    PRIZE,
    WALL,
    WAY,
    Percept,
    petal,
)
from pigaming_app.scenes.brain.rose import tone
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.view import Pose
from pigaming_app.sim.sweep import wall_contact
from pigaming_app.ui.draw import ALARM, FOCUS, LINE, THIN, Color, GlowCanvas, Points, dim
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, Sprite, master, painted, put, step, trim, turned
from pigaming_app.ui.draw.surface_cache import cached

INNER, OUTER = 68, 96  # px from a robot's middle to the inner and outer radius of the petals
ARM = (INNER + OUTER) / 2
LEVELS = 5  # petal lengths in each direction of the scale
TONES = 2  # colour levels of a rose for each of these
PITCH, SPEED = 22.0, 44.0  # px between the dots of a line; px/s of their motion
BEGIN = OUTER + 12.0  # px from a robot to the start of its lines
ENDS = {
    OPPONENT: 52.0,
    MATE: 52.0,
    PERSON: 40.0,
    BULLET: 18.0,
    WALL: 12.0,
    PRIZE: 54.0,
    GOAL: 40.0,
    WAY: 0.0,
}  # px by which lines end before their target
COLORS: dict[str, Color] = {
    OPPONENT: (255, 214, 80),
    PERSON: (255, 214, 80),
    WALL: (164, 186, 214),
    BULLET: ALARM,
    PRIZE: FOCUS,
}
CLEARANCE = 58.0  # px kept free round the middle of another robot
GOAL_R = 30  # px: outer ring of the destination
SMALL, LARGE = 4.0, 6.0  # px: radius of the dots to percepts and on the path


class FloorMarks:
    """The marks of the robot at `pose` for one picture; `others`: poses of the other robots, canvas px."""

    def __init__(self, pose: Pose, others: Sequence[Pose], color: Color, clock: float) -> None:
        self.x, self.y, self.heading = pose
        self.others, self.color, self.clock = others, color, clock
        self.light: Batch = []

    def rose(self, rose: Sequence[float], sights: Sequence[Percept]) -> None:
        """Sixteen petals that turn with the robot; a percept colours the edge of the petal in its direction."""
        for k, value in enumerate(rose):
            self._turned(leaf, round(LEVELS * value), k)
        for sight in sights:
            if sight.kind in COLORS:
                bearing = math.atan2(TOP + sight.y - self.y, LEFT + sight.x - self.x) - self.heading
                self._turned(lamp, COLORS[sight.kind], petal(bearing))

    def sights(self, state: Any, sights: Sequence[Percept]) -> None:
        """Lines to all percepts, with a cross at an occluding wall; the path, and two rings at its destination."""
        here = self.x, self.y
        begin, at = BEGIN, here
        for sight in sights:
            there = LEFT + sight.x, TOP + sight.y
            if sight.kind in (WAY, GOAL, PRIZE):
                self._dots(at, there, begin, ENDS[sight.kind], self.color, LARGE)
                begin, at = 0.0, there
                if sight.kind == GOAL and math.dist(here, there) > OUTER + GOAL_R:
                    self._put(goal(self.color), *there)
                continue
            tint = COLORS.get(sight.kind, self.color)
            if sight.clear:
                self._dots(here, there, BEGIN, ENDS[sight.kind], tint, SMALL)
                continue
            part = blocked(state, self.x - LEFT, self.y - TOP, sight.x, sight.y)
            meets = self.x + (there[0] - self.x) * part, self.y + (there[1] - self.y) * part
            self._dots(here, meets, BEGIN, 20.0, tint, SMALL)
            if math.dist(here, meets) > BEGIN:
                self._put(cross(tint), *meets)

    def _dots(
        self, a: tuple[float, float], b: tuple[float, float], begin: float, end: float, color: Color, r: float
    ) -> None:
        """Moving dots from a to b, from `begin` px after a to `end` px before b."""
        away = math.dist(a, b)
        at, sprite = begin + self.clock * SPEED % PITCH, dot(color, r)
        while at < away - end:
            part = at / away
            self._put(sprite, a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part)
            at += PITCH

    def _turned(self, sprite: Callable[..., Sprite], value: object, k: int) -> None:
        """Draw part `k` of the rose."""
        angle = self.heading + math.tau * k / PETALS
        if self._free(self.x + ARM * math.cos(angle), self.y + ARM * math.sin(angle)):
            put(self.light, sprite(value, step(angle, HEADINGS)), self.x, self.y)

    def _put(self, sprite: Sprite, x: float, y: float) -> None:
        if self._free(x, y):
            put(self.light, sprite, x, y)

    def _free(self, x: float, y: float) -> bool:
        """True if no other robot is there."""
        return all(math.hypot(x - other[0], y - other[1]) > CLEARANCE for other in self.others)


def blocked(state: Any, x: float, y: float, to_x: float, to_y: float) -> float:
    """The share of the line to a point, arena px, up to the first standing wall; 1 if there is none."""
    walls = [wall for wall in state.walls[: state.wall_count] if wall.health]
    return min((wall_contact(x, y, to_x - x, to_y - y, wall, 0.0) for wall in walls), default=1.0)


# ---- sprites


@cached
def leaf(level: int, turn: int) -> Sprite:
    """A petal, -LEVELS (bad) to LEVELS (good), turned to heading `turn` of HEADINGS."""
    return turned(painted(_leaf, (level,)), turn, HEADINGS, ARM)


def _leaf(level: int) -> pygame.Surface:
    ink = master(40, ARM)
    ink.line(_slice(INNER, OUTER), (34, 46, 66), 2, True)
    if level:
        reach = INNER + (OUTER - INNER) * (0.25 + 0.75 * abs(level) / LEVELS)
        color = tone(TONES * level)
        ink.fill(_slice(INNER, reach), dim(color, 0.55)).line(_slice(INNER, reach), color, 3, True)
    return ink.lit(0.7)


@cached
def lamp(color: Color, turn: int) -> Sprite:
    """The lit outer edge of a petal."""
    return turned(painted(_lamp, (color,)), turn, HEADINGS, ARM)


def _lamp(color: Color) -> pygame.Surface:
    half = math.pi / PETALS - 0.05
    return master(40, ARM).arc(0, 0, OUTER + 6, -half, half, color, 7).lit(0.8)


@cached
def dot(color: Color, r: float) -> Sprite:
    return trim(GlowCanvas(48, 48, 3).disc(24, 24, r, color).lit(0.8), 24, 24)


@cached
def goal(color: Color) -> Sprite:
    """The destination mark."""
    ink = GlowCanvas(120, 120, 3).ring(60, 60, GOAL_R, color, LINE).ring(60, 60, 11, color, LINE)
    return trim(ink.lit(0.7), 60, 60)


@cached
def cross(color: Color) -> Sprite:
    """The mark of an occluded line of sight."""
    ink = GlowCanvas(80, 80, 3).set_transform(40, 40)
    for side in (-1, 1):
        ink.line([(-13, -13 * side), (13, 13 * side)], color, THIN + 3)
    return trim(ink.lit(0.7), 40, 40)


def _slice(inner: float, outer: float) -> Points:
    """The outline of a petal that points along +x."""
    half = math.pi / PETALS - 0.035
    angles = [half * i / 4 for i in range(-4, 5)]
    ends = [(inner * math.cos(a), inner * math.sin(a)) for a in angles]
    return [*ends, *((outer * math.cos(a), outer * math.sin(a)) for a in reversed(angles))]
