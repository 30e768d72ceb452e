"""Things on the emulated mat as upright convex prisms, and the robots' contact with them: boxes, cups, books, tape.

Lengths are mm on the mat, as in `optics`. A ray is a line over the mat: its point at height z is `p + z v`, so a prism
cuts an interval of heights out of it.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import cos, hypot, inf, pi, sin

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.emulator.robots import RADIUS, EmulatedRobot

FACES = 32  # of a cylinder
TAPE = 0.2  # mm, thickness
CLEARANCE = 3.0  # mm, height of things that a robot drives over
TEXELS = 512  # mm, edge of a texture, one texel a mm

Floats = NDArray[np.float64]
Map = NDArray[np.float32]


@dataclass(frozen=True)
class Prism:
    """A thing. `outline`: convex, mm on the mat. `look`: name of its texture; `grey`: its mean reflectance."""

    outline: tuple[tuple[float, float], ...]
    height: float  # mm
    grey: float = 0.5
    look: str = "plain"
    seed: int = 0
    marker: int | None = None  # number of a marker of 50 mm in the middle of its top
    turn: float = 0.0  # rad, of the top's texture

    @cached_property
    def middle(self) -> Floats:
        """Centre of its corners, mm."""
        return np.asarray(np.array(self.outline).mean(axis=0))

    @cached_property
    def faces(self) -> tuple[Floats, Floats]:
        """Outward normals (n, 2) and offsets (n,) of its sides: a point inside has `normal @ point <= offset`."""
        corners = np.array(self.outline)
        ways = np.roll(corners, -1, axis=0) - corners
        normals = np.column_stack([ways[:, 1], -ways[:, 0]]) / np.hypot(ways[:, 0], ways[:, 1])[:, None]
        offsets = (normals * corners).sum(axis=1)
        outwards = np.where(normals @ self.middle <= offsets, 1.0, -1.0)
        return normals * outwards[:, None], offsets * outwards

    @cached_property
    def sides(self) -> list[tuple[float, float, float]]:
        """Normals and offsets of `faces`."""
        normals, offsets = self.faces
        return [(nx, ny, offset) for (nx, ny), offset in zip(normals.tolist(), offsets.tolist(), strict=True)]

    @cached_property
    def reach(self) -> float:
        """Radius of its footprint about the middle, mm."""
        away = np.array(self.outline) - self.middle
        return float(np.hypot(away[:, 0], away[:, 1]).max())


def box(
    x: float,
    y: float,
    long: float,
    wide: float,
    height: float,
    turn: float = 0.0,
    grey: float = 0.5,
    look: str = "plain",
    seed: int = 0,
    marker: int | None = None,
) -> Prism:
    """A box, a book or, with the height TAPE, a strip of tape. `turn`: rad, clockwise."""
    c, s = cos(turn), sin(turn)
    corners = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
    outline = tuple((x + c * u * long - s * v * wide, y + s * u * long + c * v * wide) for u, v in corners)
    return Prism(outline, height, grey, look, seed, marker, turn)


def cylinder(
    x: float, y: float, radius: float, height: float, grey: float = 0.5, look: str = "plain", seed: int = 0
) -> Prism:
    """A cup or a tin."""
    turns = [2.0 * pi * i / FACES for i in range(FACES)]
    return Prism(tuple((x + radius * cos(a), y + radius * sin(a)) for a in turns), height, grey, look, seed)


def cut(prism: Prism, x: Map, y: Map, vx: Map, vy: Map) -> tuple[Map, Map, NDArray[np.int32]]:
    """The part of each ray (x, y) + z (vx, vy) over the prism's footprint: lowest z, highest z, and the face there."""
    low, high = np.full(x.shape, -np.inf, np.float32), np.full(x.shape, np.inf, np.float32)
    face = np.full(x.shape, -1, np.int32)
    for i, ((nx, ny), offset) in enumerate(zip(*prism.faces, strict=True)):
        room = np.float32(offset) - np.float32(nx) * x - np.float32(ny) * y
        slope = np.float32(nx) * vx + np.float32(ny) * vy
        slope = np.where(np.abs(slope) < 1e-9, np.float32(1e-9), slope)
        at = room / slope
        lower = (slope > 0.0) & (at < high)
        high, face = np.where(lower, at, high), np.where(lower, i, face)
        low = np.where((slope < 0.0) & (at > low), at, low)
    return low, high, face


@lru_cache(maxsize=32)
def texture(look: str, grey: float, seed: int) -> Map:
    """Reflectance of a surface, (TEXELS, TEXELS), one texel a mm.

    `plain`: almost uniform; `cloudy`: blotches; `printed`: a label with lines of text; `striped`: stripes; `glossy`:
    reflections of a lamp and a window.
    """
    import cv2

    random = np.random.default_rng(seed)
    fine = random.normal(0.0, 0.03, (TEXELS, TEXELS))
    light = grey * (1.0 + fine)
    if look == "cloudy":
        light *= 1.0 + cv2.resize(random.normal(0.0, 0.25, (20, 20)), (TEXELS, TEXELS), interpolation=cv2.INTER_CUBIC)
    elif look == "printed":
        other = 0.85 if grey < 0.5 else 0.15
        left, top = random.integers(200, 250, 2)
        light[top : top + 45, left : left + 60] = other
        for row in range(int(top) + 4, int(top) + 40, 9):
            light[row : row + 4, left + 5 : left + int(random.integers(25, 55))] = grey
    elif look == "glossy":
        for at, size in (((250, 240), (14, 9)), ((268, 275), (22, 6))):
            cv2.ellipse(light, at, size, 30.0, 0.0, 360.0, 0.8, -1)
        light = np.asarray(cv2.GaussianBlur(light, (0, 0), 2.0), dtype=np.float64)
    elif look == "striped":
        wide = int(random.integers(8, 20))
        light[:, (np.arange(TEXELS) // wide) % 2 == 0] *= 0.55
    return np.asarray(light.clip(0.03, 0.95), dtype=np.float32)


def obstacles(things: Iterable[Prism]) -> list[Prism]:
    """The things that robots cannot drive over."""
    return [thing for thing in things if thing.height > CLEARANCE]


def push_off(robots: Sequence[EmulatedRobot], things: Sequence[Prism]) -> None:
    """Move robots that overlap a thing out of it, with their wheels slipping; the thing stays."""
    for robot in robots:
        if robot.height > 0.0:
            continue
        for thing in things:
            if hypot(robot.x - thing.middle[0], robot.y - thing.middle[1]) < RADIUS + thing.reach:
                gap, nx, ny = distance(thing, robot.x, robot.y)
                if gap < RADIUS:
                    robot.x += (RADIUS - gap) * nx
                    robot.y += (RADIUS - gap) * ny


def distance(thing: Prism, x: float, y: float) -> tuple[float, float, float]:
    """Distance of a point from a thing, mm, negative inside, and the unit vector away from it."""
    depth, nx, ny = max((fx * x + fy * y - offset, fx, fy) for fx, fy, offset in thing.sides)
    if depth <= 0.0:
        return depth, nx, ny
    nearest, away = inf, (nx, ny)
    for (ax, ay), (bx, by) in zip(thing.outline, (*thing.outline[1:], thing.outline[0]), strict=True):
        ex, ey = bx - ax, by - ay
        share = max(0.0, min(1.0, ((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey)))
        dx, dy = x - ax - share * ex, y - ay - share * ey
        gap = hypot(dx, dy)
        if gap < nearest:
            nearest, away = gap, (dx, dy) if gap > 1e-9 else (nx * 1e-9, ny * 1e-9)
    length = hypot(*away)
    return nearest, away[0] / length, away[1] / length
