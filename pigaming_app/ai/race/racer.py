"""The hand-written driver of Robot Race.

It drives for a point ahead on the fastest line (pure pursuit), shifted aside where another robot is in the way (see
`passing`), as fast as the line allows; turbo goes where the way is straight. Held up it backs out; past a line that it
has not crossed it goes back to before it.

The strengths differ in speed, in how much of the fastest line they use and how steadily they keep it, in turbo (easy
leaves it alone), and in how late they see others. Those below hard keep nearer to the middle, so that there is room
inside to pass them.
"""

from math import atan2, cos, pi, sin, sqrt
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.brain.unstick import HELD_UP, choose_escape, escape, held_up
from pigaming_app.ai.race.overtaking import EDGE, choose_lane, held_to
from pigaming_app.games.race.observation import OTHERS, Observation, Senses, observe
from pigaming_app.sim.action import set_action
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import bell, seeded

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
LOOK = 115.0  # px along the course to the point that it drives for
LATE = 0.05  # s until the motors follow
GRIP = 1.8  # of the full turn rate that is asked for before it slows down
SHIFT = 20.0  # px that a lane may be changed while it drives to that point
OUT = 30.0  # px from the edge for which it makes when it is off the course
SLACK = 25.0  # px past a line: nearer the rules may just not have said yet that it is crossed
SAVE = 80.0  # px to somebody ahead, for whom it saves its turbo
NEW_ERROR = 30  # ticks after which the error of the line is drawn anew
HELD_UP_TICKS = 40

RACE, GO_BACK, BREAK_FREE = range(3)


@record
class RacerMind:
    """What the driver remembers."""

    senses: Senses
    obs: Observation
    speed: float  # share of full speed that it dares
    line: float  # share of the way from the middle of the course to the fastest line that it uses
    spread: float  # px, how far it strays from the line that it means
    boost: float  # least share of the turbo meter with which it starts turbo; above 1: never
    random: int
    state: int
    since: int  # ticks in this state
    stray: float  # px, the present error of its line
    stray_left: int
    lane: float  # px aside of the middle, where it wants to be
    anchor_x: float  # where it was when it last got anywhere
    anchor_y: float
    held_up: int  # ticks since
    escape: float  # the stick while it breaks free
    escape_turn: float


@kernel
def think(match: Any, seat: int, mind: Any, weights: Any) -> None:
    """Look and decide every PERIOD ticks; in between the stick stays as it is."""
    if (match.tick + seat) % PERIOD:
        return
    observe(match, seat, mind.senses, mind.obs)
    act(mind.obs, mind, match.actions[seat])


@kernel
def act(obs: Any, mind: Any, action: Any) -> None:
    """Remember, choose the state, let the state act."""
    mind.since += PERIOD
    draw_error(mind)
    mind.senses.look = look_ahead(obs)
    detect_stuck(obs, mind, action)
    if mind.state == BREAK_FREE:
        after = break_free(obs, mind, action)
    elif mind.state == GO_BACK:
        after = go_back(obs, action)
    else:
        after = race(obs, mind, action)
    if after != mind.state:
        mind.state, mind.since = after, 0


# ------------------------------------------------------------------------------------------------------------- states


@kernel
def race(obs: Any, mind: Any, action: Any) -> int:
    """Drive the line, past whoever is in the way."""
    if obs.past > SLACK:
        return go_back(obs, action)
    mark = obs.ahead
    choose_lane(obs, mind)
    room = mark.half - (EDGE if obs.on else OUT)
    lane = mind.lane + mind.stray
    keep = obs.aside - obs.ideal + mark.ideal  # the lane that leads along beside the fastest line
    lane = keep + SHIFT if lane > keep + SHIFT else keep - SHIFT if lane < keep - SHIFT else lane
    lane = room if lane > room else -room if lane < -room else lane
    x, y = mark.x + (lane - mark.ideal) * mark.right_x, mark.y + (lane - mark.ideal) * mark.right_y
    pursue(obs, mind, action, x, y)
    return RACE


@kernel
def go_back(obs: Any, action: Any) -> int:
    """Drive to before a line that was missed, backwards where that saves a long turn."""
    bearing, ahead = turn_to(atan2(obs.return_y - obs.y, obs.return_x - obs.x) - obs.heading), 1.0
    if abs(bearing) > 0.6 * pi and obs.past < 200.0:
        bearing, ahead = turn_to(bearing + pi), -1.0
    if abs(bearing) > 0.9:
        ahead = 0.0
    set_action(action, ahead, 2.0 * bearing, 0, 0)
    return GO_BACK if obs.past > -SLACK else RACE


@kernel
def break_free(obs: Any, mind: Any, action: Any) -> int:
    """Back out the way it came, with a turn, else the other way, until it has got somewhere."""
    if not escape(mind, obs.x, obs.y, action):
        return BREAK_FREE
    return RACE


# ------------------------------------------------------------------------------------------------------- what they use


@kernel
def draw_error(mind: Any) -> None:
    """Draw the error of the line anew now and then."""
    mind.stray_left -= PERIOD
    if mind.stray_left <= 0:
        mind.stray_left = NEW_ERROR
        mind.stray = 2.0 * mind.spread * bell(mind)


@kernel
def look_ahead(obs: Any) -> float:
    """How far to look next time: off the course not past the next line, so as to cross it and not drive round it."""
    look = LOOK if obs.on else 0.5 * LOOK
    if not obs.on and -obs.past - SLACK < look:
        look = -obs.past - SLACK
    return 20.0 if look < 20.0 else look


@kernel
def detect_stuck(obs: Any, mind: Any, action: Any) -> None:
    """Notice that it wants to move and gets nowhere."""
    if mind.state == BREAK_FREE:
        return
    idle = action.linear == 0.0 and action.angular == 0.0
    if held_up(mind, obs.x, obs.y, idle, HELD_UP, PERIOD) > HELD_UP_TICKS:
        mind.state, mind.since = BREAK_FREE, 0
        choose_escape(mind, -1.0 if action.linear >= 0.0 else 1.0, 0.75)


@kernel
def pursue(obs: Any, mind: Any, action: Any, x: float, y: float) -> None:
    """Drive the arc that leads to a point, as fast as it can be turned along.

    The motors are late, so the arc begins where the robot will be when they follow.
    """
    heading = obs.heading + LATE * obs.angular
    middle = obs.heading + 0.5 * LATE * obs.angular
    dx = x - obs.x - LATE * obs.linear * cos(middle)
    dy = y - obs.y - LATE * obs.linear * sin(middle)
    bearing = turn_to(atan2(dy, dx) - heading)
    if abs(bearing) > 1.2:
        set_action(action, 0.0, 3.0 * bearing, 0, 0)
        return
    bend = 2.0 * sin(bearing) / (sqrt(dx * dx + dy * dy) + 1.0)  # rad per px
    held = held_to(obs, mind)
    dash = wants_turbo(obs, mind, bend) if held > 1.0 else 0
    full = obs.speed * (obs.turbo_factor if dash else 1.0)
    speed, most = mind.speed * obs.pace, GRIP * obs.turn_rate / (abs(bend) * full + 1e-9)
    speed = speed if speed < most else most
    speed = speed if speed < held else held
    set_action(action, speed, bend * speed * full / obs.turn_rate, 0, dash)


@kernel
def wants_turbo(obs: Any, mind: Any, bend: float) -> int:
    """1 where the way is straight enough, the meter full enough to begin, and it is not wanted for somebody ahead."""
    if not obs.on or abs(bend) * obs.turbo_factor * obs.speed > 0.8 * obs.turn_rate or obs.pace < 1.0:
        return 0
    for i in range(OTHERS):
        other = obs.others[i]
        if other.present and other.ahead > 0.0 and other.distance < SAVE:
            return 0
    return 1 if obs.boosting or obs.turbo > mind.boost else 0


def make_reset(speed: float, line: float, spread: float, boost: float, delay: float) -> Any:
    """A function that fills a fresh mind: see RacerMind; seeing others `delay` s late."""

    def fill(mind: RacerMind, seed: int) -> None:
        mind.senses.delay, mind.senses.look = delay, LOOK
        mind.speed, mind.line, mind.spread, mind.boost = speed, line, spread, boost
        mind.random = seeded(seed)

    return fill


EASY = BrainKind("easy", RacerMind, think, make_reset(speed=0.93, line=0.2, spread=10.0, boost=2.0, delay=0.35))
NORMAL = BrainKind("normal", RacerMind, think, make_reset(speed=1.0, line=0.35, spread=5.0, boost=0.5, delay=0.2))
HARD = BrainKind("hard", RacerMind, think, make_reset(speed=1.0, line=1.0, spread=0.0, boost=0.12, delay=0.05))
