"""What every game has: a clock, a random generator, robots, walls, and what each seat asks for in this tick."""

from typing import Annotated

from pigaming_app.sim.record import record

HZ = 50
DT = 1.0 / HZ
WIDTH, HEIGHT = 1600.0, 900.0
ROBOTS = 4
WALLS = 24
CELL = 50.0  # px between the nodes of the grid
COLUMNS, ROWS = 33, 19  # nodes at 0, 50 .. 1600 and 0, 50 .. 900; those on the rim are never free
NODES = COLUMNS * ROWS
NODES_KEPT = NODES + 1  # fills whole 8 bytes


@record
class Robot:
    """A circle of radius 36 px on two wheels. Positions in px, angles in rad, times in s."""

    present: int
    team: int
    score: int
    boosting: int  # 1 while turbo is on
    x: float
    y: float
    heading: float
    linear: float  # px/s, as the motors turn now
    angular: float  # rad/s
    ask_linear: float  # what the game asks the plant for
    ask_angular: float
    gain: float  # share of the way to the asked speed that the motors go in one tick
    turbo: float  # what is left in the meter, 0..1


@record
class Wall:
    """A thick segment from (ax, ay) to (bx, by): everything nearer to it than `half` px is wall."""

    ax: float
    ay: float
    bx: float
    by: float
    half: float
    health: int  # bullets it still takes; SOLID: it takes any number; 0: gone
    whole: int  # the health it began with
    left: float  # the box outside which no robot's centre touches it
    right: float
    top: float
    bottom: float


SOLID = -1


@record
class Action:
    """What a seat asks for: stick and buttons. The stick comes in 64ths of full, so that a file holds it exactly."""

    linear: float  # -1..1, ahead positive
    angular: float  # -1..1, clockwise positive
    fire: int
    turbo: int
    aim: int  # what it says it makes for, as its game counts that from 1, up to 63; 0: it does not say


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
    grid: Annotated[list[int], NODES_KEPT, "h"]  # see navigate: walls that block a node, and walls near it
