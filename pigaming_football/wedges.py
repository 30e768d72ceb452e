"""Wedges: two sides of walls, or of the rim, between which a ball rolls deeper than a robot gets."""

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import hypot
from typing import NamedTuple

from pigaming_app.api.rules import HEIGHT, WIDTH, Wall

from .state import MIDDLE

LEAST = 1.0  # px, length of a side
PARALLEL = 0.999  # cosine of an angle that is none


class Side(NamedTuple):
    """A straight side from (ax, ay) to (bx, by), px; the unit vector (nx, ny) points away from it into the free."""

    ax: float
    ay: float
    bx: float
    by: float
    nx: float
    ny: float


class Wedge(NamedTuple):
    """The deepest place (x, y) of a disc between two sides, px, and the unit vector that leads out."""

    x: float
    y: float
    out_x: float
    out_y: float


def wedges(walls: Sequence[Wall], mouth: float, radius: float, cosine: float) -> Iterator[Wedge]:
    """All wedges in which a disc touches both sides, and which are sharper than the angle of this cosine."""
    for one, other in combinations([*_rim(mouth), *(side for wall in walls for side in _sides(wall))], 2):
        cosine_here = -one.nx * other.nx - one.ny * other.ny
        if cosine < cosine_here < PARALLEL:
            x, y = _touching(one, other, radius)
            out_x, out_y = one.nx + other.nx, one.ny + other.ny
            length = hypot(out_x, out_y)
            if all(_is_beside(side, x, y) for side in (one, other)):
                yield Wedge(x, y, out_x / length, out_y / length)


def _touching(one: Side, other: Side, radius: float) -> tuple[float, float]:
    """The point `radius` px from the lines of both sides."""
    c = one.nx * one.ax + one.ny * one.ay + radius
    d = other.nx * other.ax + other.ny * other.ay + radius
    area = one.nx * other.ny - one.ny * other.nx
    return (c * other.ny - d * one.ny) / area, (d * one.nx - c * other.nx) / area


def _is_beside(side: Side, x: float, y: float) -> bool:
    """True if the foot of the perpendicular from (x, y) lies on a side."""
    ex, ey = side.bx - side.ax, side.by - side.ay
    return 0.0 <= (x - side.ax) * ex + (y - side.ay) * ey <= ex * ex + ey * ey


def _sides(wall: Wall) -> Iterator[Side]:
    """Both straight sides of a wall."""
    ex, ey = wall.bx - wall.ax, wall.by - wall.ay
    length = hypot(ex, ey)
    for way in (1, -1) if length >= LEAST else ():
        nx, ny = -way * ey / length, way * ex / length
        dx, dy = wall.half * nx, wall.half * ny
        yield Side(wall.ax + dx, wall.ay + dy, wall.bx + dx, wall.by + dy, nx, ny)


def _rim(mouth: float) -> Iterator[Side]:
    """The rim between the goals."""
    yield Side(0.0, 0.0, WIDTH, 0.0, 0.0, 1.0)
    yield Side(0.0, HEIGHT, WIDTH, HEIGHT, 0.0, -1.0)
    for x, way in ((0.0, 1.0), (WIDTH, -1.0)):
        yield Side(x, 0.0, x, MIDDLE - mouth, way, 0.0)
        yield Side(x, MIDDLE + mouth, x, HEIGHT, way, 0.0)
