"""Contact of the emulated robots with things: a robot that runs into a box stops there, with its wheels slipping."""

from collections.abc import Iterable, Sequence
from math import hypot, inf
from typing import NamedTuple

from pigaming_app.hardware.emulator.robots import RADIUS, EmulatedRobot
from pigaming_app.hardware.emulator.things.prism import Prism

CLEARANCE = 3.0  # mm, height of things that a robot drives over


class Obstacle(NamedTuple):
    """A tall thing. Lengths are mm on the mat."""

    x: float
    y: float
    reach: float  # of its corners from (x, y)
    corners: tuple[tuple[float, float], ...]
    faces: tuple[tuple[float, float, float], ...]  # outward normals and offsets


def obstacles(things: Iterable[Prism]) -> list[Obstacle]:
    """The things that robots cannot drive over."""
    return [
        Obstacle(
            float(thing.middle[0]),
            float(thing.middle[1]),
            thing.reach,
            thing.outline,
            tuple((nx, ny, offset) for (nx, ny), offset in zip(*(part.tolist() for part in thing.faces), strict=True)),
        )
        for thing in things
        if thing.height > CLEARANCE
    ]


def push_off(robots: Sequence[EmulatedRobot], things: Sequence[Obstacle]) -> None:
    """Move robots that overlap a thing out of it; the thing stays."""
    for robot in robots:
        if robot.height > 0.0:
            continue
        for thing in things:
            if hypot(robot.x - thing.x, robot.y - thing.y) < RADIUS + thing.reach:
                gap, nx, ny = distance(thing, robot.x, robot.y)
                if gap < RADIUS:
                    robot.x += (RADIUS - gap) * nx
                    robot.y += (RADIUS - gap) * ny


def distance(thing: Obstacle, x: float, y: float) -> tuple[float, float, float]:
    """Distance of a point from a thing, mm, negative inside, and the unit vector away from it."""
    depth, nx, ny = max((fx * x + fy * y - offset, fx, fy) for fx, fy, offset in thing.faces)
    if depth <= 0.0:
        return depth, nx, ny
    nearest, away = inf, (nx, ny)
    for (ax, ay), (bx, by) in zip(thing.corners, (*thing.corners[1:], thing.corners[0]), strict=True):
        ex, ey = bx - ax, by - ay
        share = max(0.0, min(1.0, ((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey)))
        dx, dy = x - ax - share * ex, y - ay - share * ey
        gap = hypot(dx, dy)
        if gap < nearest:
            nearest, away = gap, (dx, dy) if gap > 1e-9 else (nx * 1e-9, ny * 1e-9)
    length = hypot(*away)
    return nearest, away[0] / length, away[1] / length
