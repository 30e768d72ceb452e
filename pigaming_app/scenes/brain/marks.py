"""What the brain overlay draws on the floor: the rose round a robot, dotted lines to what it sees, where it is going.

All of it is light, none of it lies on a robot: the rose begins outside of the barrel, lines end before what they show.
"""

import math
from collections.abc import Sequence
from functools import cache, lru_cache
from typing import Any

import pygame

from pigaming_app.ai.thoughts import BULLET, GOAL, MATE, OPPONENT, PETALS, PRIZE, WALL, WAY, Sight, petal
from pigaming_app.scenes.ink import ALARM, FOCUS, LINE, THIN, Color, Ink, Points, dim
from pigaming_app.scenes.rose import tone
from pigaming_app.scenes.sprites import HEADINGS, Batch, Sprite, master, painted, put, step, trim, turned
from pigaming_app.scenes.views.ground import LEFT, TOP
from pigaming_app.scenes.views.picture import Pose
from pigaming_app.sim.sweep import meets_wall

INNER, OUTER = 68, 96  # px from a robot's middle to the ends of a petal's room
ARM = (INNER + OUTER) / 2
LEVELS = 5  # lengths of a petal, each way
TONES = 2  # levels of the colours of a rose for each of these
PITCH, SPEED = 22.0, 44.0  # px from dot to dot of a line, px/s at which they run
BEGIN = OUTER + 12.0  # px from a robot at which lines begin
ENDS = {OPPONENT: 52.0, MATE: 52.0, BULLET: 18.0, WALL: 12.0, PRIZE: 54.0, GOAL: 40.0, WAY: 0.0}  # px before the end
COLORS: dict[str, Color] = {OPPONENT: (255, 214, 80), WALL: (164, 186, 214), BULLET: ALARM, PRIZE: FOCUS}
SMALL, LARGE = 4.0, 6.0  # px: radius of the dots to what it sees, and on its way


def draw_rose(light: Batch, pose: Pose, rose: Sequence[float], sights: Sequence[Sight]) -> None:
    """Sixteen petals that turn with the robot; where something is, the petal's edge has its colour."""
    x, y, heading = pose
    for k, value in enumerate(rose):
        put(light, leaf(round(LEVELS * value), step(heading + math.tau * k / PETALS, HEADINGS)), x, y)
    for sight in sights:
        if sight.kind in COLORS:
            k = petal(math.atan2(TOP + sight.y - y, LEFT + sight.x - x) - heading)
            put(light, lamp(COLORS[sight.kind], step(heading + math.tau * k / PETALS, HEADINGS)), x, y)


def draw_sights(light: Batch, state: Any, pose: Pose, sights: Sequence[Sight], color: Color, clock: float) -> None:
    """Lines to what it sees; a cross where a wall is between. Its way, and two rings where it leads, in its colour."""
    x, y, _ = pose
    begin, at = BEGIN, (x, y)
    for sight in sights:
        there = LEFT + sight.x, TOP + sight.y
        if sight.kind in (WAY, GOAL, PRIZE):
            dots(light, at, there, begin, ENDS[sight.kind], color, LARGE, clock)
            begin, at = 0.0, there
            if sight.kind == GOAL:
                put(light, goal(color), *there)
            continue
        tint = COLORS.get(sight.kind, color)
        if sight.clear:
            dots(light, (x, y), there, BEGIN, ENDS[sight.kind], tint, SMALL, clock)
            continue
        wall = blocked(state, x - LEFT, y - TOP, sight.x, sight.y)
        meets = x + (there[0] - x) * wall, y + (there[1] - y) * wall
        dots(light, (x, y), meets, BEGIN, 20.0, tint, SMALL, clock)
        if math.dist((x, y), meets) > INNER:
            put(light, cross(tint), *meets)


def dots(
    light: Batch,
    a: tuple[float, float],
    b: tuple[float, float],
    begin: float,
    end: float,
    color: Color,
    r: float,
    clock: float,
) -> None:
    """Dots that run from a to b, from `begin` px after a to `end` px before b."""
    away = math.dist(a, b)
    at, sprite = begin + clock * SPEED % PITCH, dot(color, r)
    while at < away - end:
        share = at / away
        put(light, sprite, a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share)
        at += PITCH


def blocked(state: Any, x: float, y: float, to_x: float, to_y: float) -> float:
    """The share of the way to a point, arena px, after which the first wall that still stands is met; 1: none is."""
    walls = [wall for wall in state.walls[: state.wall_count] if wall.health]
    return min((meets_wall(x, y, to_x - x, to_y - y, wall, 0.0) for wall in walls), default=1.0)


# ---- sprites


@lru_cache(maxsize=(2 * LEVELS + 1) * HEADINGS)
def leaf(level: int, turn: int) -> Sprite:
    """A petal, -LEVELS (bad) to LEVELS (good), whose middle points to heading `turn` of HEADINGS."""
    return turned(painted(_leaf, (level,)), turn, HEADINGS, ARM)


def _leaf(level: int) -> pygame.Surface:
    ink = master(40, ARM)
    ink.line(_slice(INNER, OUTER), (34, 46, 66), 2, True)
    if level:
        reach = INNER + (OUTER - INNER) * (0.25 + 0.75 * abs(level) / LEVELS)
        color = tone(TONES * level)
        ink.fill(_slice(INNER, reach), dim(color, 0.55)).line(_slice(INNER, reach), color, 3, True)
    return ink.lit(0.7)


@lru_cache(maxsize=4 * HEADINGS)
def lamp(color: Color, turn: int) -> Sprite:
    """The outer edge of a petal, lit."""
    return turned(painted(_lamp, (color,)), turn, HEADINGS, ARM)


def _lamp(color: Color) -> pygame.Surface:
    half = math.pi / PETALS - 0.05
    return master(40, ARM).arc(0, 0, OUTER + 6, -half, half, color, 7).lit(0.8)


@cache
def dot(color: Color, r: float) -> Sprite:
    """One dot of a line."""
    return trim(Ink(48, 48, 3).disc(24, 24, r, color).lit(0.8), 24, 24)


@cache
def goal(color: Color) -> Sprite:
    """Where it is going."""
    ink = Ink(120, 120, 3).ring(60, 60, 30, color, LINE).ring(60, 60, 11, color, LINE)
    return trim(ink.lit(0.7), 60, 60)


@cache
def cross(color: Color) -> Sprite:
    """Where its sight ends."""
    ink = Ink(80, 80, 3).to(40, 40)
    for side in (-1, 1):
        ink.line([(-13, -13 * side), (13, 13 * side)], color, THIN + 3)
    return trim(ink.lit(0.7), 40, 40)


def _slice(inner: float, outer: float) -> Points:
    """The outline of a petal that points along +x."""
    half = math.pi / PETALS - 0.035
    angles = [half * i / 4 for i in range(-4, 5)]
    ends = [(inner * math.cos(a), inner * math.sin(a)) for a in angles]
    return [*ends, *((outer * math.cos(a), outer * math.sin(a)) for a in reversed(angles))]
