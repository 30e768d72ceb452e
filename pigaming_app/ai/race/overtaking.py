"""How a driver gets past others: which lane it takes, and whom it follows.

Robots that stand or crawl are driven round like any obstacle. Those that race are followed until they leave room on the
fastest line: then it goes by there, mostly on the inside of a bend, where the way is shorter. Who is beside another
makes way.
"""

from typing import Any

from pigaming_app.games.race.observation import OTHERS
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import RADIUS

CLEAR = 2.0 * RADIUS + 2.0  # px between the middles of two robots that pass each other
EDGE = 2.0  # px that a lane keeps from the edge
LANES = 9  # lanes that are thought of, from one edge to the other
OWN, STEADY = 0.08, 0.1  # what a px costs away from the own line, and from the lane chosen last
FAR = 300.0  # px from which others matter
SOON = 2.5  # s in which it would run into another, from which on that is in the way
SLOW = 0.5  # of full speed: whoever is slower is driven round
TAIL = 12.0  # px behind another at which it drives no faster than that
LEEWAY = 32.0  # px by which two robots may overlap on their lanes and still get past each other


@kernel
def choose_lane(obs: Any, mind: Any) -> None:
    """The lane that costs the fewest px: those lost behind others, and those of a longer way round a bend."""
    mark = obs.ahead
    wanted = mind.line * mark.ideal
    best, least = wanted, blocked(obs, mind, wanted)
    if least > 0.0:
        least += STEADY * abs(wanted - mind.lane)
        room, away = mark.half - EDGE, OWN + abs(obs.turn)
        for i in range(LANES):
            lane = room * (2.0 * i / (LANES - 1) - 1.0)
            cost = blocked(obs, mind, lane) + away * abs(lane - wanted) + STEADY * abs(lane - mind.lane)
            if cost < least:
                best, least = lane, cost
    mind.lane = best


@kernel
def blocked(obs: Any, mind: Any, lane: float) -> float:
    """The px that others on a lane cost; 0: nobody is in the way."""
    cost = 0.0
    for i in range(OTHERS):
        other = obs.others[i]
        if not other.present or other.ahead < -CLEAR or other.distance > FAR:
            continue
        gap = abs(other.aside - lane)
        if other.ahead < CLEAR:
            if (other.aside - obs.aside) * (other.aside - lane) < 0.0:
                cost += 400.0  # through it
            if gap < CLEAR:
                cost += 3.0 * (CLEAR - gap)
        elif gap < CLEAR:
            closing = mind.speed * obs.speed - other.speed
            if other.speed < SLOW * obs.speed and other.distance - CLEAR < SOON * closing:
                cost += 150.0 * (1.0 + (CLEAR - gap) / CLEAR)
    return cost


@kernel
def held_to(obs: Any, mind: Any) -> float:
    """The speed of a robot right ahead on the own lane, as a share of full speed; above 1 if there is none."""
    share = 2.0
    for i in range(OTHERS):
        other = obs.others[i]
        near = other.present and other.ahead > 15.0 and other.distance < CLEAR + TAIL
        if near and other.speed > 100.0 and abs(other.aside - mind.lane) < CLEAR - LEEWAY:
            ahead = 0.98 * other.speed / obs.speed
            share = ahead if ahead < share else share
    return share
