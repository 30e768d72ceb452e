"""How a driver gets past others: which lane it takes, whom it overtakes, and whom it follows.

Robots that stand or crawl are driven round like any obstacle. Those that race are followed until turbo will do: on a
straight it takes the free side, in a bend only the inside: the way is shorter there. Who is beside another makes way.
"""

from typing import Any

from pigaming_app.games.race.view import OTHERS
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robots import RADIUS

CLEAR = 2.0 * RADIUS + 2.0  # px between the middles of two robots that pass each other
SPARE = 2.0  # px more than it takes to pass
EDGE = 2.0  # px that a lane keeps from the edge
LANES = 9  # lanes that are thought of, from one edge to the other
OWN, STEADY = 0.08, 0.1  # what a px costs away from the own line, and from the lane chosen last
FAR = 300.0  # px from which others matter
SOON = 2.5  # s in which it would run into another, from which on that is in the way
SLOW = 0.5  # of full speed: whoever is slower is in the way, others are overtaken
REACH = 110.0  # px that the other may be ahead when it begins to overtake
FUEL = 0.6  # of the turbo meter for that
QUICKER = 110.0  # px/s by which turbo must be faster than the other
RUNWAY = 300.0  # px of about straight course; with less it is a bend
INSIDE = 45.0  # px that the other must leave on the inside of a bend
PASSING = 160  # ticks after which it leaves off
TAIL = 12.0  # px behind another at which it drives no faster than that
LEEWAY = 32.0  # px by which two robots may overlap on their lanes and still get past each other


@kernel
def choose_target(view: Any, mind: Any, ticks: int) -> None:
    """Begin to overtake whoever is close ahead where turbo will do; leave off when past it, or late.

    `ticks` since it was last asked.
    """
    if mind.target >= 0:
        mind.target_for += ticks
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
            if side and view.turbo_factor * view.speed - other.speed > QUICKER:
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
    """The lane that costs the fewest px: those lost behind others, and those of a longer way round a bend.

    Whoever overtakes takes the one beside the other.
    """
    if mind.target >= 0:
        mind.lane = view.others[mind.target].aside + mind.side * (CLEAR + SPARE)
        return
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
    """The speed of a robot right ahead on the own lane, as a share of full speed; above 1 if it need not mind."""
    share = 2.0
    if mind.target >= 0:
        return share
    for i in range(OTHERS):
        other = view.others[i]
        near = other.present and other.ahead > 15.0 and other.distance < CLEAR + TAIL
        if near and other.speed > 100.0 and abs(other.aside - mind.lane) < CLEAR - LEEWAY:
            ahead = 0.98 * other.speed / view.speed
            share = ahead if ahead < share else share
    return share
