"""The hand-written brain of Robot Race: pure pursuit of a point ahead on the fastest line.

The point is shifted sideways where another robot is in the way (see `overtaking`). Speed is as high as the curvature
allows, with turbo on straights. A stuck robot backs out; one that has missed a line returns to before it.

The strengths differ in speed, in how closely and steadily they keep the fastest line, in turbo (easy never uses it) and
in reaction time. Those below hard stay nearer to the middle of the course, which leaves room inside to overtake them.
"""

from math import atan2, cos, pi, sin, sqrt
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.brain.unstick import STUCK_DISTANCE, choose_escape, escape, ticks_stuck
from pigaming_app.ai.race.overtaking import EDGE, choose_lane, leader_speed
from pigaming_app.games.race.observation import OTHERS, Observation, Senses, observe
from pigaming_app.sim.action import set_action
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import bell, seeded

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
LOOK = 115.0  # lookahead along the course, px
LATE = 0.05  # latency of the motors, s
GRIP = 1.8  # commanded turn rate, as a share of the highest, above which it slows down
SHIFT = 20.0  # px of lane change within one lookahead
OUT = 30.0  # px inside the edge at which it aims when off the course
SLACK = 25.0  # px past a line before it counts as missed: the rules may not have registered the crossing yet
SAVE = 80.0  # px to a robot ahead within which it saves its turbo
NEW_ERROR = 30  # ticks between draws of the line error
STUCK_TICKS = 40  # ticks of driving without moving that count as stuck

RACE, GO_BACK, BREAK_FREE = range(3)


@record
class RacerMind:
    """Memory of the driver."""

    senses: Senses
    obs: Observation
    speed: float  # share of full speed
    line: float  # 0: middle of the course, 1: fastest line
    spread: float  # standard deviation of the line error, px
    boost: float  # share of the turbo meter needed to start turbo; above 1: never
    random: int
    state: int
    since: int  # ticks in this state
    stray: float  # present line error, px
    stray_left: int  # ticks until the next draw
    lane: float  # present lane, px right of the middle
    anchor_x: float  # position at the last progress, px
    anchor_y: float
    stuck_ticks: int  # ticks since then
    escape: float  # forward stick while backing out
    escape_turn: float


@kernel
def think(match: Any, seat: int, mind: Any, weights: Any) -> None:
    """Observe and decide every PERIOD ticks; the action holds in between."""
    if (match.tick + seat) % PERIOD:
        return
    observe(match, seat, mind.senses, mind.obs)
    act(mind.obs, mind, match.actions[seat])


@kernel
def act(obs: Any, mind: Any, action: Any) -> None:
    """One step of the state machine: update memory, run the state, change state if it returns another one."""
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
    """Follow the line, overtaking robots in the way."""
    if obs.past > SLACK:
        return go_back(obs, action)
    mark = obs.ahead
    choose_lane(obs, mind)
    room = mark.half - (EDGE if obs.on else OUT)
    lane = mind.lane + mind.stray
    keep = obs.aside - obs.ideal + mark.ideal  # the lane that keeps the present distance to the fastest line
    lane = keep + SHIFT if lane > keep + SHIFT else keep - SHIFT if lane < keep - SHIFT else lane
    lane = room if lane > room else -room if lane < -room else lane
    x, y = mark.x + (lane - mark.ideal) * mark.right_x, mark.y + (lane - mark.ideal) * mark.right_y
    pursue(obs, mind, action, x, y)
    return RACE


@kernel
def go_back(obs: Any, action: Any) -> int:
    """Drive back to before a missed line, in reverse where that saves a long turn."""
    bearing, ahead = turn_to(atan2(obs.return_y - obs.y, obs.return_x - obs.x) - obs.heading), 1.0
    if abs(bearing) > 0.6 * pi and obs.past < 200.0:
        bearing, ahead = turn_to(bearing + pi), -1.0
    if abs(bearing) > 0.9:
        ahead = 0.0
    set_action(action, ahead, 2.0 * bearing, 0, 0)
    return GO_BACK if obs.past > -SLACK else RACE


@kernel
def break_free(obs: Any, mind: Any, action: Any) -> int:
    """Back out with a turn until the robot is free."""
    if not escape(mind, obs.x, obs.y, action):
        return BREAK_FREE
    return RACE


# ------------------------------------------------------------------------------------------------------------- helpers


@kernel
def draw_error(mind: Any) -> None:
    """Draw a new line error every NEW_ERROR ticks."""
    mind.stray_left -= PERIOD
    if mind.stray_left <= 0:
        mind.stray_left = NEW_ERROR
        mind.stray = 2.0 * mind.spread * bell(mind)


@kernel
def look_ahead(obs: Any) -> float:
    """Lookahead for the next observation, px; off the course not past the next line, to cross and not bypass it."""
    look = LOOK if obs.on else 0.5 * LOOK
    if not obs.on and -obs.past - SLACK < look:
        look = -obs.past - SLACK
    return 20.0 if look < 20.0 else look


@kernel
def detect_stuck(obs: Any, mind: Any, action: Any) -> None:
    """Enter BREAK_FREE if the robot drives without moving for STUCK_TICKS."""
    if mind.state == BREAK_FREE:
        return
    idle = action.linear == 0.0 and action.angular == 0.0
    if ticks_stuck(mind, obs.x, obs.y, idle, STUCK_DISTANCE, PERIOD) > STUCK_TICKS:
        mind.state, mind.since = BREAK_FREE, 0
        choose_escape(mind, -1.0 if action.linear >= 0.0 else 1.0, 0.75)


@kernel
def pursue(obs: Any, mind: Any, action: Any, x: float, y: float) -> None:
    """Drive the arc to the point (x, y), as fast as its curvature allows.

    To compensate for the latency of the motors the arc begins at the pose predicted LATE s ahead. Source of pure
    pursuit: Coulter, CMU-RI-TR-92-01, 1992.
    """
    heading = obs.heading + LATE * obs.angular
    middle = obs.heading + 0.5 * LATE * obs.angular
    dx = x - obs.x - LATE * obs.linear * cos(middle)
    dy = y - obs.y - LATE * obs.linear * sin(middle)
    bearing = turn_to(atan2(dy, dx) - heading)
    if abs(bearing) > 1.2:
        set_action(action, 0.0, 3.0 * bearing, 0, 0)
        return
    bend = 2.0 * sin(bearing) / (sqrt(dx * dx + dy * dy) + 1.0)  # curvature, rad/px
    held = leader_speed(obs, mind)
    dash = wants_turbo(obs, mind, bend) if held > 1.0 else 0
    full = obs.speed * (obs.turbo_factor if dash else 1.0)
    speed, limit = mind.speed * obs.pace, GRIP * obs.turn_rate / (abs(bend) * full + 1e-9)
    speed = speed if speed < limit else limit
    speed = speed if speed < held else held
    set_action(action, speed, bend * speed * full / obs.turn_rate, 0, dash)


@kernel
def wants_turbo(obs: Any, mind: Any, bend: float) -> int:
    """1 if the way is straight enough, the meter full enough to start, and no robot is close ahead."""
    if not obs.on or abs(bend) * obs.turbo_factor * obs.speed > 0.8 * obs.turn_rate or obs.pace < 1.0:
        return 0
    for i in range(OTHERS):
        other = obs.others[i]
        if other.present and other.ahead > 0.0 and other.distance < SAVE:
            return 0
    return 1 if obs.boosting or obs.turbo > mind.boost else 0


def make_reset(speed: float, line: float, spread: float, boost: float, delay: float) -> Any:
    """A `reset` for a strength: `delay` is the reaction time to others, s; the rest as in RacerMind."""

    def fill(mind: RacerMind, seed: int) -> None:
        mind.senses.delay, mind.senses.look = delay, LOOK
        mind.speed, mind.line, mind.spread, mind.boost = speed, line, spread, boost
        mind.random = seeded(seed)

    return fill


HAND1 = BrainKind("hand1", RacerMind, think, make_reset(speed=0.93, line=0.2, spread=10.0, boost=2.0, delay=0.35))
HAND2 = BrainKind("hand2", RacerMind, think, make_reset(speed=1.0, line=0.35, spread=5.0, boost=0.5, delay=0.2))
HAND3 = BrainKind("hand3", RacerMind, think, make_reset(speed=1.0, line=1.0, spread=0.0, boost=0.12, delay=0.05))
