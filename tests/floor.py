"""Test arenas: walls and robots at given places, without an arena file."""

from collections.abc import Sequence
from math import cos, hypot, sin

from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.pitanks import GAME as PITANKS
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.games.starts import in_order, take_starts
from pigaming_app.sim.arena import Arena, StartPose, WallSpec, build
from pigaming_app.sim.world import RADIUS, Wall, World

CORNERS = ((110.0, 110.0, 0.0), (1490.0, 790.0, 3.0), (110.0, 790.0, 0.0), (1490.0, 110.0, 3.0))
Line = tuple[float, float, float, float]
Pose = tuple[float, float, float]


def arena(
    walls: Sequence[Line] = (),
    poses: Sequence[Pose] = CORNERS,
    health: int = 5,
    half: float = 15.0,
    radius: float = RADIUS,
) -> Arena:
    """An arena with these walls, each from (ax, ay) to (bx, by); robots beyond `poses` wait in the corners."""
    places = (*poses, *CORNERS[len(poses) :])
    specs = tuple(WallSpec(*line, half, health) for line in walls)
    starts = tuple(StartPose(*pose) for pose in places)
    return Arena("test", {"en": "Test", "pt": "Teste"}, specs, starts, "", radius=radius)


def floor(
    walls: Sequence[Line] = (),
    poses: Sequence[Pose] = CORNERS,
    health: int = 5,
    half: float = 15.0,
    radius: float = RADIUS,
) -> World:
    """A floor on which the robots of `poses` are present."""
    world = World()
    build(world, arena(walls, poses, health, half, radius))
    for robot in world.robots[: len(poses)]:
        robot.present = 1
    return world


def pitanks(
    poses: Sequence[Pose],
    walls: Sequence[Line] = (),
    variant: str = "plain",
    teams: Sequence[int] = (0, 1, 2, 3),
    health: int = 5,
    minutes: float = 1.0,
    half: float = 15.0,
) -> PiTanks:
    """A match of PiTanks before its first tick, with one robot for each pose, in the order of seats."""
    match = PiTanks()
    one, two, three, four = (Seat("random" if i < len(poses) else "off", teams[i]) for i in range(4))
    setup = Setup("pitanks", "test", (one, two, three, four), minutes, 1, variant)
    place = arena(walls, poses, health, half)
    PITANKS.start(match, place, setup)
    take_starts(match, place, in_order(match))
    return match


def from_segment(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> float:
    """Distance from a point to a segment, px: for oracles, which share no code with the rules."""
    ex, ey = bx - ax, by - ay
    length2 = ex * ex + ey * ey
    t = min(1.0, max(0.0, ((x - ax) * ex + (y - ay) * ey) / length2)) if length2 else 0.0
    return hypot(x - ax - t * ex, y - ay - t * ey)


def from_wall(wall: Wall | WallSpec, x: float, y: float) -> float:
    """Distance from a point to a wall's centre line, px."""
    return from_segment(x, y, wall.ax, wall.ay, wall.bx, wall.by)


def box(x: float, y: float, w: float, h: float, angle: float = 0.0) -> tuple[tuple[float, float], ...]:
    """The outline of a thing with four corners round (x, y)."""
    c, s = cos(angle), sin(angle)
    corners = ((-w / 2, -h / 2), (w / 2, -h / 2), (w / 2, h / 2), (-w / 2, h / 2))
    return tuple((x + c * u - s * v, y + s * u + c * v) for u, v in corners)
