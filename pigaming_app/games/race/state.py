"""Robot Race: records of a match, and the parameters of the rules."""

from typing import Annotated

from pigaming_app.games.race.course import POINTS, Course, CoursePosition
from pigaming_app.games.simple import MatchRules, MatchState
from pigaming_app.sim.record import record
from pigaming_app.sim.world import HZ, ROBOTS

MAX_LAPS = 9
LINES = ROBOTS  # one for each seat, taken or not
PADS = 3
PAD_HALF = 36.0  # px
BOXES = 4
OWN_OILS = 2
OILS = ROBOTS * OWN_OILS
NO_ITEM, TURBO, SHIELD, OIL = range(4)  # `Racer.item`
ITEMS = ("", "turbo", "shield", "oil")
OFF_COURSE, WRONG_WAY, MISSED_LINE, STUCK = range(1, 5)  # `Racer.lost`
LOST = ("", "off", "wrong", "missed", "stuck")


@record
class RaceRules(MatchRules):
    """Tunable parameters. Speeds in px/s and rad/s, times in ticks."""

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
    party: int  # 1: common start and finish line, slipstream, boost pads, items
    draft: int  # 1: slipstream and boost pads, for the last of several only
    slip_reach: float = 350.0  # px, length of the slipstream behind a robot's centre
    slip_width: float = 45.0  # px to either side of it
    slip_refill: float = 1.0 / (5 * HZ)  # of the meter, per tick, times the place: most for the last
    surge_factor: float = 1.3  # of speed, on a boost pad and after it
    pad_surge: int = round(1.0 * HZ)
    item_surge: int = round(1.4 * HZ)  # of the item `turbo`, which also fills the meter
    shield_life: int = 10 * HZ
    box_pause: int = HZ  # until an item box that was taken is back
    oil_life: int = 20 * HZ
    oil_radius: float = 30.0
    spin: int = round(1.05 * HZ)
    spin_rate: float = 6.0  # a turn of 360 degrees in `spin`


@record
class TimingLine:
    """A line across the course: start and finish of the racers with this `line`, checkpoint of the others."""

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
    progress: float  # px from its own line, negative before it; off its way, where it left it
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
    line: int  # index of its own line, its start and finish
    lost: int  # OFF_COURSE .. STUCK: FIRE now asks for the way back (see `Robot.recover`); 0: it is not lost
    left: float  # px along the course, where it was last on its way
    backward: int  # ticks of facing against the course
    still: int  # ticks of driving without getting anywhere
    still_x: float  # where that began, px
    still_y: float
    fire_held: int  # 1: FIRE was down in the previous tick
    item: int  # TURBO, SHIELD or OIL, which FIRE uses; NO_ITEM
    shield: int  # ticks left
    surge: int  # ticks left of the speed of a boost pad
    slip: int  # 1: in a slipstream
    spin: int  # ticks left of a spin on oil
    spin_way: int  # 1: clockwise, -1: anticlockwise


@record
class BoostPad:
    """A boost pad on the course: a square of 2 * PAD_HALF px, turned to the course."""

    x: float
    y: float
    heading: float
    along: float  # px along the course
    aside: float  # px right of its line


@record
class Box:
    """A place of item boxes on the course."""

    x: float
    y: float
    along: float
    aside: float
    pause: int  # ticks until it is back; 0: it is there


@record
class Oil:
    """An oil slick; those of robot k begin at index k * OWN_OILS."""

    alive: int  # ticks left; 0: none
    x: float
    y: float


@record
class Race(MatchState):
    """The complete state of a match of Robot Race."""

    rules: RaceRules
    course: Course
    lines: Annotated[list[TimingLine], LINES]
    racers: Annotated[list[Racer], ROBOTS]
    first: int  # tick of the first finish; 0: none yet
    ideal: Annotated[list[float], POINTS]  # offset of the fastest line at each point of the course, px
    pace: Annotated[list[float], POINTS]  # speed there, as a share of full speed
    pads: Annotated[list[BoostPad], PADS]  # party and draft
    boxes: Annotated[list[Box], BOXES]  # party only
    oils: Annotated[list[Oil], OILS]
    narrow: int  # 1: there are things, and robots pass them between these two offsets at each point, px
    low: Annotated[list[float], POINTS]
    high: Annotated[list[float], POINTS]
