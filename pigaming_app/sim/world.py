"""Records shared by every game: clock, random generator, robots, walls, and each seat's action in this tick."""

from typing import Annotated

from pigaming_app.sim.record import LATE, record

HZ = 50  # ticks per second
DT = 1.0 / HZ  # s
WIDTH, HEIGHT = 1600.0, 900.0  # px, of the arena
RADIUS = 36.0  # px, of a robot, unless real ones are wider on their surface
ROBOTS = 4  # seats of a match; some may be empty
WALLS = 63  # what six bits of the grid count
MUDS = 16
CELL = 50.0  # px between the nodes of the grid
COLUMNS, ROWS = 33, 19  # nodes at 0, 50 .. 1600 and 0, 50 .. 900 px; those on the rim are never free
NODES = COLUMNS * ROWS
NODES_PADDED = NODES + 1  # length of the arrays, padded to a multiple of 8 bytes


@record
class Robot:
    """A circle on two wheels, as wide as all others of a match. Positions in px, angles in rad, times in s."""

    present: int
    team: int
    score: int
    boosting: int  # 1 while turbo is on
    x: float
    y: float
    heading: float
    linear: float  # px/s, current speed
    angular: float  # rad/s
    requested_linear: float  # speeds that the game requests of the plant
    requested_angular: float
    gain: float  # share of the speed error that the motors remove in one tick
    turbo: float  # charge of the meter, 0..1
    recover: int  # 1: the game asks to have it put at rest at the pose below; real robots drive there
    recover_x: float
    recover_y: float
    recover_heading: float


@record
class Capsule:
    """All points within `half` px of the segment from (ax, ay) to (bx, by)."""

    ax: float
    ay: float
    bx: float
    by: float
    half: float


@record
class Wall(Capsule):
    """An inner wall."""

    health: int  # bullets it still takes; SOLID: indestructible; 0: gone
    initial_health: int  # SOLID: indestructible
    left: float  # bounding box, expanded by a robot's radius
    right: float
    top: float
    bottom: float


SOLID = -1


@record
class Action:
    """Input of one seat: stick and buttons. The stick has steps of 1/64, which a replay file stores exactly."""

    linear: float  # -1..1, forward positive
    angular: float  # -1..1, clockwise positive
    fire: int
    turbo: int
    aim: int  # target that the seat declares, numbered 1 to 63 by its game; 0: none


@record
class World:
    """The part of a match that every game shares."""

    tick: int
    over: int
    random: int
    robots: Annotated[list[Robot], ROBOTS]
    actions: Annotated[list[Action], ROBOTS]
    wall_count: int
    walls: Annotated[list[Wall], WALLS]
    grid: Annotated[list[int], NODES_PADDED, "h"]  # see grid.py: walls that block a node, and walls near it
    mud_count: int
    muds: Annotated[list[Capsule], MUDS]  # ground on which robots are slow
    shifts: int  # how often walls were replaced during the match (real things that are moved)
    radius: Annotated[float, LATE] = RADIUS  # px, of every robot; set before any wall
