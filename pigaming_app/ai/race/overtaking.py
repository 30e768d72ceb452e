"""Overtaking of the race brain: choice of lane, and speed behind another robot.

Standing and slow robots are obstacles to drive round. Racing robots are followed until they leave room on the fastest
line, and then overtaken there, mostly on the inside of a bend, where the way is shorter. A robot beside another gives
way. In `party`, and last in `draft`, a robot with charge in its meter pulls out of the slipstream to pass, steers for
boost pads and item boxes, stays in a slipstream while its meter is low, and avoids oil.
"""

from typing import Protocol

from pigaming_app.games.race.observation import OTHERS, RaceObservation
from pigaming_app.sim.kernel import kernel

CLEAR = 2.0  # px between two passing robots
EDGE = 2.0  # px between a lane and the edge of the course
LANES = 9  # candidate lanes from one edge to the other
OWN, STEADY = 0.08, 0.1  # cost per px of leaving its own line, and of leaving the present lane
FAR = 300.0  # px beyond which others are ignored
SOON = 2.5  # s to a collision below which a slower robot is in the way
SLOW = 0.5  # share of full speed below which a robot is an obstacle to drive round
TAIL = 12.0  # px behind another robot at which it matches that robot's speed
LEEWAY = 32.0  # px by which the lanes of two robots may overlap without a need to follow
CHARGED = 0.3  # of the meter, from which it pulls out to pass in `party`
PULL_OUT = 170.0  # px to a robot ahead, within which it does
PASSING, STRAIGHT = 120.0, 0.3  # cost of staying behind then, on a straight; sine of the turn ahead from which it waits
TOW, TOW_REACH = 25.0, 340.0  # worth of a slipstream, px, and its length
PAD, PAD_HALF = 90.0, 30.0  # worth of a boost pad, px, and px aside of its middle that still reach it
BOX, BOX_HALF = 35.0, 48.0  # the same of an item box
SLICK, SLICK_HALF = 300.0, 46.0  # cost of oil, and px to either side that it wants to keep
CLOSE = 20.0  # px ahead, below which it is too late to steer for something


class Overtaker(Protocol):
    """The part of a driver's memory that chooses its lane; see `RacerMind`."""

    speed: float
    line: float
    lane: float
    foresight: float
    alert: float
    clear: float


@kernel
def choose_lane(obs: RaceObservation, mind: Overtaker) -> None:
    """Set `mind.lane` to the cheapest lane: px lost behind others, plus px of a longer way round the bend."""
    mark = obs.ahead
    wanted = mind.line * mark.ideal
    best, least = wanted, lane_cost(obs, mind, wanted)
    if least != 0.0 or has_features(obs, mind):
        least += STEADY * abs(wanted - mind.lane)
        room, away = mark.half - EDGE, OWN + abs(obs.turn)
        for i in range(LANES):
            lane = room * (2.0 * i / (LANES - 1) - 1.0)
            if mark.narrow and (lane < mark.low or lane > mark.high):
                continue
            cost = lane_cost(obs, mind, lane) + away * abs(lane - wanted) + STEADY * abs(lane - mind.lane)
            if cost < least:
                best, least = lane, cost
    mind.lane = best


@kernel
def lane_cost(obs: RaceObservation, mind: Overtaker, lane: float) -> float:
    """Cost of the robots and features on a lane, px; 0 if there are none. `lane`: px right of the middle."""
    cost = feature_cost(obs, mind, lane) if obs.boosts else 0.0
    passing = eagerness(obs)
    for i in range(OTHERS):
        other = obs.others[i]
        if not other.present or other.ahead < -mind.clear or other.distance > FAR:
            continue
        gap = abs(other.aside - lane)
        if other.ahead < mind.clear:
            if (other.aside - obs.aside) * (other.aside - lane) < 0.0:
                cost += 400.0  # the lane lies on the far side of a robot alongside
            if gap < mind.clear:
                cost += 3.0 * (mind.clear - gap)
        elif gap < mind.clear:
            closing = mind.speed * obs.speed - other.speed
            if other.speed < SLOW * obs.speed and other.distance - mind.clear < SOON * closing:
                cost += 150.0 * (1.0 + (mind.clear - gap) / mind.clear)
            elif passing > 0.0 and other.distance < PULL_OUT:
                cost += passing * (1.0 - gap / mind.clear)
    return cost


@kernel
def eagerness(obs: RaceObservation) -> float:
    """Cost of staying behind a robot right ahead, px: where slipstreams work, with a charged meter, on a straight."""
    if not obs.boosts or (obs.turbo < CHARGED and not obs.surge):
        return 0.0
    cost: float = PASSING * (1.0 - abs(obs.turn) / STRAIGHT)
    return cost if cost > 0.0 else 0.0


@kernel
def has_features(obs: RaceObservation, mind: Overtaker) -> bool:
    """True if something on the course, or a slipstream, may be worth another lane."""
    near = obs.pad.present or obs.box.present or obs.oils[0].present
    return bool(obs.boosts and mind.alert > 0.0 and (near or obs.turbo < CHARGED))


@kernel
def feature_cost(obs: RaceObservation, mind: Overtaker, lane: float) -> float:
    """Cost, px, of oil on a lane, less the worth of a boost pad, an item box and a slipstream."""
    cost = 0.0
    if not obs.shield:
        for oil in obs.oils:
            gap = abs(oil.aside - lane)
            if oil.present and oil.ahead < mind.foresight and gap < SLICK_HALF:
                cost += SLICK * (1.5 - gap / SLICK_HALF)
    if obs.pad.present and CLOSE < obs.pad.ahead < mind.foresight:
        gap = abs(obs.pad.aside - lane)
        cost -= PAD if gap < PAD_HALF else 0.0
    if obs.box.present and not obs.item and CLOSE < obs.box.ahead < mind.foresight:
        gap = abs(obs.box.aside - lane)
        cost -= BOX if gap < BOX_HALF else 0.0
    if obs.turbo < CHARGED:
        for i in range(OTHERS):
            other = obs.others[i]
            ahead = other.present and mind.clear < other.ahead < TOW_REACH and other.speed > SLOW * obs.speed
            if ahead and abs(other.aside - lane) < LEEWAY:
                cost -= TOW
    return cost


@kernel
def leader_speed(obs: RaceObservation, mind: Overtaker) -> float:
    """Speed of a robot right ahead on the present lane, as a share of full speed; above 1 if there is none."""
    share = 2.0
    tail = 0.0 if obs.boosts else TAIL
    for i in range(OTHERS):
        other = obs.others[i]
        near = other.present and other.ahead > 15.0 and other.distance < mind.clear + tail
        if near and other.speed > 100.0 and abs(other.aside - mind.lane) < mind.clear - LEEWAY:
            limit = 0.98 * other.speed / obs.speed
            share = limit if limit < share else share
    return share
