"""Robot Race: the records of a match and the numbers of its rules."""

from typing import Annotated

from pigaming_app.games.race.course import POINTS, Course, CoursePosition
from pigaming_app.sim.record import record
from pigaming_app.sim.world import HZ, ROBOTS, World

MOST_LAPS = 9
LINES = ROBOTS  # one for each seat, whoever drives


@record
class Rules:
    """Every number of the game that can be tuned. Speeds in px/s and rad/s, times in ticks."""

    ticks: int  # after which the race is stopped
    laps: int = 3
    speed: float = 325.0
    turn_rate: float = 3.0
    mud: float = 1.0 / 3.0  # factor of speed off the course
    turbo_factor: float = 1.3
    turbo_drain: float = 1.0 / (2 * HZ)  # of the meter, per tick
    turbo_refill: float = 1.0 / (4 * HZ)
    patience: int = 30 * HZ  # for which the others race on after the first has finished
    roll_on: int = round(1.5 * HZ)  # for which whoever has finished may still drive, so as not to stand in the way
    carried: float = 40.0  # px in a tick: a robot that moved further was carried, and has crossed nothing


@record
class TimingLine:
    """A line across the course, of the seat with the same number: its start and finish, the others' checkpoint."""

    along: float  # px along the course
    ax: float  # its end on the left hand of the way
    ay: float
    bx: float  # its end on the right
    by: float


@record
class Racer:
    """What Robot Race adds to a robot. Times are in ticks, with the share of a tick at which a line was crossed."""

    place: CoursePosition  # where it is now
    last_x: float  # where it was on the tick before
    last_y: float
    passed: int  # lines crossed in order, its own first; 1 + 4 * laps: finished
    back: int  # lines that it has gone back over since: crossing these again is no news
    missed: int  # 1 + the line that it must go back to, since it has crossed a later one; 0: none
    void: int  # laps that did not count: its own line crossed while another was missing
    wrong: int  # ticks for which it has been driving the wrong way
    progress: float  # px along the way from its own line; below 0 before it, what a missed line hides does not count
    rank: int  # 1: leads
    finished: int  # 1: all laps driven
    finish: float  # when, since the start
    lap_began: float  # when its own line was last passed
    last_lap: float  # 0: none yet
    best_lap: float
    laps: Annotated[list[float], MOST_LAPS]
    splits: Annotated[list[float], LINES]  # of this lap: from its beginning to each of its lines, [0] is 0
    best_splits: Annotated[list[float], LINES]  # those of its best lap
    delta: float  # the last split, or lap, less that of the best lap
    delta_at: int  # the tick at which `delta` came; 0: there is none yet


@record
class Race(World):
    """A match of Robot Race, whole."""

    rules: Rules
    course: Course
    lines: Annotated[list[TimingLine], LINES]
    racers: Annotated[list[Racer], ROBOTS]
    first: int  # the tick on which the first finished; 0: nobody has
    ideal: Annotated[list[float], POINTS]  # px that the fastest line lies aside of each point of the course
    pace: Annotated[list[float], POINTS]  # speed there, as a share of full speed
