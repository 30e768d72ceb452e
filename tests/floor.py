"""Test arenas: walls and robots at given places, without an arena file."""

from collections.abc import Sequence

from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.pitanks import GAME as PITANKS
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.arena import Arena, StartPose, WallSpec, build
from pigaming_app.sim.world import World

CORNERS = ((110.0, 110.0, 0.0), (1490.0, 790.0, 3.0), (110.0, 790.0, 0.0), (1490.0, 110.0, 3.0))
Line = tuple[float, float, float, float]
Pose = tuple[float, float, float]


def arena(walls: Sequence[Line] = (), poses: Sequence[Pose] = CORNERS, health: int = 5, half: float = 15.0) -> Arena:
    """An arena with these walls, each from (ax, ay) to (bx, by); robots beyond `poses` wait in the corners."""
    places = (*poses, *CORNERS[len(poses) :])
    specs = tuple(WallSpec(*line, half, health) for line in walls)
    return Arena("test", {"en": "Test", "pt": "Teste"}, specs, tuple(StartPose(*pose) for pose in places), "")


def floor(walls: Sequence[Line] = (), poses: Sequence[Pose] = CORNERS, health: int = 5, half: float = 15.0) -> World:
    """A floor on which the robots of `poses` are present."""
    world = World()
    build(world, arena(walls, poses, health, half))
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
    """A match of PiTanks before its first tick, with one robot for each pose."""
    match = PiTanks()
    one, two, three, four = (Seat("random" if i < len(poses) else "off", teams[i]) for i in range(4))
    setup = Setup("pitanks", "test", (one, two, three, four), minutes, 1, variant)
    PITANKS.start(match, arena(walls, poses, health, half), setup)
    return match
