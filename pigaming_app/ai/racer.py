"""The hand-written driver of Robot Race.

It drives for a point ahead on the fastest line (pure pursuit), shifted aside where another robot is in the way, as fast
as the line allows; turbo goes where the way is straight. Held up it backs out; past a line that it has not crossed it
goes back to before it.

The strengths differ in speed, in how much of the fastest line they use and how steadily they keep it, in turbo, and in
how late they see others.
"""

from math import atan2, cos, pi, sin, sqrt
from typing import Any

from pigaming_app.ai.brain import Kind
from pigaming_app.games.race.view import OTHERS, Eyes, View, see
from pigaming_app.sim.action import press
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.chance import chance, seeded
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.robots import RADIUS

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
LANES = 9  # ways to pass that are thought of, from one edge to the other
CLEAR = 2.0 * RADIUS + 2.0  # px between the middles of two robots that pass each other
SLACK = 25.0  # px past a line: nearer the rules may just not have said yet that it is crossed
OWN, STEADY = 0.08, 0.1  # what a px costs away from the own line, and from the lane chosen last
FAR = 300.0  # px from which others matter
SOON = 2.5  # s in which it would run into another, from which on that is in the way
SLOW = 0.5  # of full speed: whoever is slower is in the way, others are overtaken
LEEWAY = 32.0  # px of two robots that it takes for granted when they pass
RUNWAY = 300.0  # px of about straight course in which it begins to overtake
FUEL = 0.6  # of the turbo meter for that
REACH = 110.0  # px that the other may be ahead
QUICKER = 110.0  # px/s by which turbo must be faster than the other
PASSING = 160  # ticks after which it leaves off
INSIDE = 45.0  # px that another must leave on the inside of a bend: it is shorter there, and who is beside makes way
SPARE = 2.0  # px more than it takes to pass
SWING = 50.0  # px that a lane may be changed for it while it drives to the point ahead
SAVE = 120.0  # px to somebody ahead, for whom it saves its turbo
TAIL = 12.0  # px behind another at which it drives no faster than that
SHIFT = 60.0  # px that a lane may be changed while it drives to the point ahead
OUT = 30.0  # px from the edge for which it makes when it is off the course
EDGE = 2.0  # px that a lane keeps from the edge
NEW_ERROR = 30  # ticks after which the error of the line is drawn anew
HELD_UP = 20.0  # px; less than this in HELD_UP_TICKS is getting nowhere
HELD_UP_TICKS = 40
FREEING = 20  # ticks of backing out, one way or the other

LOOK = 115.0  # px along the course to the point that it drives for
LATE = 0.05  # s until the motors follow
GRIP = 1.8  # of the full turn rate that is asked for before it slows down

RACE, GO_BACK, BREAK_FREE = range(3)


@record
class RacerMind:
    """What the driver remembers."""

    eyes: Eyes
    sight: View  # numba takes no field named view
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
    target: int  # which of the others it overtakes now; -1: none
    side: float  # on which side: 1: to the right of it
    target_for: int  # ticks for which it has been at it
    anchor_x: float  # where it was when it last got anywhere
    anchor_y: float
    held_up: int  # ticks since
    escape: float  # the stick while it breaks free
    escape_turn: float


@kernel
def think(match: Any, seat: int, mind: Any) -> None:
    """Look and decide every PERIOD ticks; in between the stick stays as it is."""
    if (match.tick + seat) % PERIOD:
        return
    see(match, seat, mind.eyes, mind.sight)
    act(mind.sight, mind, match.actions[seat])


@kernel
def act(view: Any, mind: Any, action: Any) -> None:
    """Remember, choose the state, let the state act."""
    mind.since += PERIOD
    err(mind)
    mind.eyes.look = look_ahead(view)
    feel_held_up(view, mind, action)
    if mind.state == BREAK_FREE:
        after = break_free(view, mind, action)
    elif mind.state == GO_BACK:
        after = go_back(view, action)
    else:
        after = race(view, mind, action)
    if after != mind.state:
        mind.state, mind.since = after, 0


# ------------------------------------------------------------------------------------------------------------- states


@kernel
def race(view: Any, mind: Any, action: Any) -> int:
    """Drive the line, past whoever is in the way."""
    if view.past > SLACK:
        return go_back(view, action)
    mark = view.ahead
    choose_target(view, mind)
    if mind.target >= 0:
        other = view.others[mind.target]
        mind.lane = other.aside + mind.side * (CLEAR + SPARE)
    else:
        choose_lane(view, mind)
    room = mark.half - (EDGE if view.on else OUT)
    lane = mind.lane + mind.stray
    keep = view.aside - view.ideal + mark.ideal  # the lane that leads along beside the fastest line
    shift = SHIFT if mind.target < 0 else SWING
    lane = keep + shift if lane > keep + shift else keep - shift if lane < keep - shift else lane
    lane = room if lane > room else -room if lane < -room else lane
    x, y = mark.x + (lane - mark.ideal) * mark.right_x, mark.y + (lane - mark.ideal) * mark.right_y
    pursue(view, mind, action, x, y)
    return RACE


@kernel
def go_back(view: Any, action: Any) -> int:
    """Drive to before a line that was missed, backwards where that saves a long turn."""
    bearing, ahead = turn_to(atan2(view.return_y - view.y, view.return_x - view.x) - view.heading), 1.0
    if abs(bearing) > 0.6 * pi and view.past < 200.0:
        bearing, ahead = turn_to(bearing + pi), -1.0
    if abs(bearing) > 0.9:
        ahead = 0.0
    press(action, ahead, 2.0 * bearing, 0, 0)
    return GO_BACK if view.past > -SLACK else RACE


@kernel
def break_free(view: Any, mind: Any, action: Any) -> int:
    """Back out the way it came, with a turn, else the other way, until it has got somewhere."""
    press(action, mind.escape, mind.escape_turn, 0, 0)
    if mind.since < FREEING:
        return BREAK_FREE
    dx, dy = view.x - mind.anchor_x, view.y - mind.anchor_y
    if dx * dx + dy * dy < HELD_UP * HELD_UP:  # that way is blocked too
        mind.since, mind.escape, mind.escape_turn = 0, -mind.escape, 2.0 * chance(mind) - 1.0
        return BREAK_FREE
    mind.held_up, mind.anchor_x, mind.anchor_y = 0, view.x, view.y
    return RACE


# ------------------------------------------------------------------------------------------------------- what they use


@kernel
def err(mind: Any) -> None:
    """Draw the error of the line anew now and then: the sum of three even draws is near enough to a bell."""
    mind.stray_left -= PERIOD
    if mind.stray_left <= 0:
        mind.stray_left = NEW_ERROR
        mind.stray = 2.0 * mind.spread * (chance(mind) + chance(mind) + chance(mind) - 1.5)


@kernel
def look_ahead(view: Any) -> float:
    """How far to look next time: off the course not past the next line, so as to cross it and not drive round it."""
    look = LOOK if view.on else 0.5 * LOOK
    if not view.on and -view.past - SLACK < look:
        look = -view.past - SLACK
    return 20.0 if look < 20.0 else look


@kernel
def feel_held_up(view: Any, mind: Any, action: Any) -> None:
    """Notice that it wants to move and gets nowhere."""
    dx, dy = view.x - mind.anchor_x, view.y - mind.anchor_y
    if mind.state == BREAK_FREE:
        return
    if dx * dx + dy * dy > HELD_UP * HELD_UP or (action.linear == 0.0 and action.angular == 0.0):
        mind.held_up, mind.anchor_x, mind.anchor_y = 0, view.x, view.y
        return
    mind.held_up += PERIOD
    if mind.held_up > HELD_UP_TICKS:
        mind.state, mind.since = BREAK_FREE, 0
        back = -1.0 if action.linear >= 0.0 else 1.0
        mind.escape = back if chance(mind) < 0.75 else -back  # the way back may be blocked too
        mind.escape_turn = 2.0 * chance(mind) - 1.0


@kernel
def choose_target(view: Any, mind: Any) -> None:
    """Begin to overtake whoever is close ahead where turbo will do; leave off when past it, or late."""
    if mind.target >= 0:
        mind.target_for += PERIOD
        other = view.others[mind.target]
        if other.ahead < -CLEAR or other.distance > FAR or mind.target_for > PASSING or not view.on:
            mind.target = -1
        return
    if view.turbo < FUEL or mind.boost > 1.0:
        return
    for i in range(OTHERS):
        other = view.others[i]
        if other.present and 0.0 < other.ahead < REACH and other.distance < REACH:
            side = free_side(view, other)
            if side and 1.3 * view.speed - other.speed > QUICKER:
                mind.target, mind.target_for, mind.side = i, 0, side


@kernel
def free_side(view: Any, other: Any) -> float:
    """On which side another can be overtaken: in a bend only on the inside; 1: to the right of it, 0: on neither."""
    side = 1.0 if view.aside > other.aside else -1.0
    room = view.ahead.half - EDGE
    if view.straight < RUNWAY:
        side = 1.0 if view.turn > 0.0 else -1.0
        return side if room - side * other.aside > INSIDE else 0.0
    if room - side * other.aside < CLEAR + SPARE:
        side = -side
    return side if room - side * other.aside > CLEAR + SPARE else 0.0


@kernel
def choose_lane(view: Any, mind: Any) -> None:
    """The lane that costs the fewest px: those lost behind others, and those of a longer way round a bend."""
    mark = view.ahead
    wanted = mind.line * mark.ideal
    best, least = wanted, blocked(view, mind, wanted)
    if least > 0.0:
        least += STEADY * abs(wanted - mind.lane)
        room, away = mark.half - EDGE, OWN + abs(view.turn)
        for i in range(LANES):
            lane = room * (2.0 * i / (LANES - 1) - 1.0)
            cost = blocked(view, mind, lane) + away * abs(lane - wanted) + STEADY * abs(lane - mind.lane)
            if cost < least:
                best, least = lane, cost
    mind.lane = best


@kernel
def blocked(view: Any, mind: Any, lane: float) -> float:
    """The px that others on a lane cost; 0: nobody is in the way."""
    cost = 0.0
    for i in range(OTHERS):
        other = view.others[i]
        if not other.present or other.ahead < -CLEAR or other.distance > FAR:
            continue
        gap = abs(other.aside - lane)
        if other.ahead < CLEAR:
            if (other.aside - view.aside) * (other.aside - lane) < 0.0:
                cost += 400.0  # through it
            if gap < CLEAR:
                cost += 3.0 * (CLEAR - gap)
        elif gap < CLEAR:
            closing = mind.speed * view.speed - other.speed
            if other.speed < SLOW * view.speed and other.distance - CLEAR < SOON * closing:
                cost += 150.0 * (1.0 + (CLEAR - gap) / CLEAR)
    return cost


@kernel
def held_to(view: Any, mind: Any) -> float:
    """The speed of a robot right ahead on the own lane, as a share of full speed; above 1 if there is none."""
    share = 2.0
    for i in range(OTHERS):
        other = view.others[i]
        near = other.present and other.ahead > 15.0 and other.distance < CLEAR + TAIL
        if near and other.speed > 100.0 and abs(other.aside - mind.lane) < CLEAR - LEEWAY:
            ahead = 0.98 * other.speed / view.speed
            share = ahead if ahead < share else share
    return share


@kernel
def pursue(view: Any, mind: Any, action: Any, x: float, y: float) -> None:
    """Drive the arc that leads to a point, as fast as it can be turned along.

    The motors are late, so the arc begins where the robot will be when they follow.
    """
    heading = view.heading + LATE * view.angular
    middle = view.heading + 0.5 * LATE * view.angular
    dx = x - view.x - LATE * view.linear * cos(middle)
    dy = y - view.y - LATE * view.linear * sin(middle)
    bearing = turn_to(atan2(dy, dx) - heading)
    if abs(bearing) > 1.2:
        press(action, 0.0, 3.0 * bearing, 0, 0)
        return
    bend = 2.0 * sin(bearing) / (sqrt(dx * dx + dy * dy) + 1.0)  # rad per px
    held = held_to(view, mind)
    if mind.target >= 0:
        held = 2.0
    dash = use_turbo(view, mind, bend) if held > 1.0 else 0
    full = view.speed * (1.3 if dash else 1.0)
    speed, most = mind.speed * view.pace, GRIP * view.turn_rate / (abs(bend) * full + 1e-9)
    speed = speed if speed < most else most
    speed = speed if speed < held else held
    press(action, speed, bend * speed * full / view.turn_rate, 0, dash)


@kernel
def use_turbo(view: Any, mind: Any, bend: float) -> int:
    """1 where the way is straight enough, the meter full enough to begin, and it is not wanted for somebody ahead."""
    if not view.on or abs(bend) * 1.3 * view.speed > 0.8 * view.turn_rate or view.pace < 1.0:
        return 0
    if mind.target >= 0:
        return 1
    for i in range(OTHERS):
        other = view.others[i]
        if other.present and other.ahead > 0.0 and other.distance < SAVE:
            return 0
    return 1 if view.boosting or view.turbo > mind.boost else 0


def wake(speed: float, line: float, spread: float, boost: float, delay: float) -> Any:
    """A function that fills a fresh mind: see RacerMind; seeing others `delay` s late."""

    def fill(mind: RacerMind, seed: int) -> None:
        mind.eyes.delay, mind.eyes.look = delay, LOOK
        mind.speed, mind.line, mind.spread, mind.boost = speed, line, spread, boost
        mind.random, mind.target = seeded(seed), -1

    return fill


EASY = Kind("easy", RacerMind, think, wake(speed=0.98, line=0.2, spread=10.0, boost=0.9, delay=0.35))
NORMAL = Kind("normal", RacerMind, think, wake(speed=1.0, line=0.45, spread=5.0, boost=0.5, delay=0.2))
HARD = Kind("hard", RacerMind, think, wake(speed=1.0, line=1.0, spread=0.0, boost=0.12, delay=0.05))
