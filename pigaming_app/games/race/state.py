"""Robot Race: records of a match, and the parameters of the rules."""

from typing import Annotated

from pigaming_app.games.race.course import POINTS, Course, CoursePosition
from pigaming_app.sim.record import record
from pigaming_app.sim.world import HZ, ROBOTS, World

MAX_LAPS = 9
LINES = ROBOTS  # one for each seat, taken or not


@record
class Rules:
    """Tunable parameters. Speeds in px/s and rad/s, times in ticks."""

    ticks: int  # after which the race is stopped
    laps: int = 3
    speed: float = 325.0
    turn_rate: float = 3.0
    mud: float = 1.0 / 3.0  # speed factor off the course
    turbo_factor: float = 1.3
    turbo_drain: float = 1.0 / (2 * HZ)  # of the meter, per tick
    turbo_refill: float = 1.0 / (4 * HZ)
    patience: int = 30 * HZ  # left for the others after the first has finished
    roll_on: int = round(1.5 * HZ)  # for which a finisher may still drive, to clear the line
    carried: float = 40.0  # px in a tick: a robot that moved further was carried by hand, and has crossed nothing


@record
class TimingLine:
    """A line across the course: start and finish of the seat with the same number, checkpoint of the others."""

    along: float  # px along the course
    ax: float  # its left end, seen in driving direction
    ay: float
    bx: float  # its right end
    by: float


@record
class Racer:
    """State of a robot that only Robot Race has. Times are in ticks, interpolated to the crossing of a line."""

    place: CoursePosition  # current
    last_x: float  # position on the previous tick
    last_y: float
    passed: int  # lines crossed in order, its own first; 1 + 4 * laps: finished
    lines_reversed: int  # lines that it has gone back over since; crossing these again does not count
    missed: int  # 1 + the line that it must go back to, after crossing a later one; 0: none
    void: int  # laps that did not count: own line crossed while another was missing
    wrong: int  # ticks of driving in the wrong direction
    progress: float  # px from its own line, negative before it; never past a missed line
    rank: int  # 1: in the lead
    finished: int  # 1: all laps completed
    finish: float  # time of the finish
    lap_start: float  # time of its last crossing of its own line
    last_lap: float  # 0: none yet
    best_lap: float
    laps: Annotated[list[float], MAX_LAPS]
    splits: Annotated[list[float], LINES]  # of this lap: time from its beginning to each line, [0] is 0
    best_splits: Annotated[list[float], LINES]  # of its best lap
    delta: float  # the last split, or lap, less that of the best lap
    delta_at: int  # tick of the last change of `delta`; 0: none yet


@record
class Race(World):
    """The complete state of a match of Robot Race."""

    rules: Rules
    course: Course
    lines: Annotated[list[TimingLine], LINES]
    racers: Annotated[list[Racer], ROBOTS]
    first: int  # tick of the first finish; 0: none yet
    ideal: Annotated[list[float], POINTS]  # offset of the fastest line at each point of the course, px
    pace: Annotated[list[float], POINTS]  # speed there, as a share of full speed
