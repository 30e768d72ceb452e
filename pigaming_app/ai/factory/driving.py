"""Driving of the factory brain: reach a slot round walls, robots and people, and use the fork there."""

from math import cos, pi, sin, sqrt

from pigaming_app.ai.brain.steering import turn_stick
from pigaming_app.ai.factory.mind import FAR, PERIOD, Mind, keep_patience
from pigaming_app.games.factory.observation import OTHERS, FactoryObservation, SlotView
from pigaming_app.games.factory.state import WORKERS
from pigaming_app.sim.action import set_action
from pigaming_app.sim.grid import node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import CELL, Action

AT = 24.0  # px between fork and slot within which it presses fire
TURN_IN = 30.0  # px short of the slot, measured at the fork, at which it turns towards the slot
ASIDE = 120.0  # px; a waiting robot makes way for a person nearer than this
STAND_OFF = 150.0  # px from an occupied slot at which it waits
LOITER, LOITER_TURN = 0.25, 0.2  # stick while it waits
TO_AND_FRO = 1.6  # s in either direction
DRAW_BACK = 0.25  # stick while it thinks
LOOK = 130.0  # px ahead that must be free
LOOKS, LEAN = 11, 0.32  # candidate directions around the route, and rad between neighbours
ROBOT_ROOM = 78.0  # px between the centres of two passing robots
PERSON_ROOM = 70.0  # px between the centres of a robot and a person it passes


@kernel
def drive_to(obs: FactoryObservation, mind: Mind, action: Action) -> None:
    """Drive to the target slot; once there, turn to it and use the fork."""
    slot, route = obs.slots[mind.target], mind.senses.route
    moved = not route.active or route.goal_x != slot.x or route.goal_y != slot.y
    route.active, route.goal_x, route.goal_y = 1, slot.x, slot.y
    if moved:  # the next observation brings the new route
        set_action(action, 0.0, 0.0, 0, 0)
        return
    if mind.near and obs.goal_distance < STAND_OFF and obs.straight:
        make_way(obs, mind, action)
        return
    if obs.straight and obs.goal_distance < obs.fork + TURN_IN:
        handle(obs, mind, action, slot)
    else:
        follow_route(obs, mind, action)


@kernel
def make_way(obs: FactoryObservation, mind: Mind, action: Action) -> None:
    """Wait clear of people and of the slot, driving to and fro in arcs."""
    speed, turn = LOITER if obs.seconds_left % (2.0 * TO_AND_FRO) < TO_AND_FRO else -LOITER, LOITER_TURN
    if obs.goal_distance < STAND_OFF - 40.0:
        speed, turn = -0.5, 0.0
    elif free_distance(obs, 0.0 if speed > 0.0 else pi, ROBOT_ROOM) < 40.0:
        speed = -speed
    nearest = ASIDE
    for w in range(WORKERS):
        person = obs.people[w]
        if person.distance < nearest:
            nearest = person.distance
            speed, turn = -0.6 if abs(person.bearing) < 1.57 else 0.6, 0.0
    mind.stuck_ticks = 0
    set_action(action, speed, turn, 0, 0)


@kernel
def draw_back(obs: FactoryObservation, action: Action) -> None:
    """Draw back slowly, unless a person or a robot is close behind."""
    behind = free_distance(obs, pi, ROBOT_ROOM)
    set_action(action, -DRAW_BACK if behind > 40.0 else 0.0, 0.3, 0, 0)


@kernel
def handle(obs: FactoryObservation, mind: Mind, action: Action, slot: SlotView) -> None:
    """Turn to the slot, bring the fork over it and press fire."""
    dx, dy = obs.fork_x - slot.x, obs.fork_y - slot.y
    if dx * dx + dy * dy < AT * AT:
        set_action(action, 0.0, 0.0, 0 if action.fire else 1, 0)
        return
    speed = 0.0
    if abs(obs.goal_bearing) < 0.5:
        speed = (obs.goal_distance - obs.fork) / 40.0
        if speed > 0.0 and free_distance(obs, 0.0, 0.0) < 20.0:
            speed = 0.0
    set_action(action, speed, turn_stick(obs.goal_bearing, obs.angular, obs.turn_rate, PERIOD), 0, 0)


@kernel
def follow_route(obs: FactoryObservation, mind: Mind, action: Action) -> None:
    """Follow the route, or the free direction nearest to it if people or robots block it."""
    bearing = obs.waypoint_bearing
    free = False
    for i in range(LOOKS):
        lean = LEAN * ((i + 1) // 2)
        turn = bearing + (lean if i % 2 else -lean)  # right first, so robots that meet head-on both keep right
        if free_distance(obs, turn, ROBOT_ROOM) >= min(LOOK, obs.waypoint_distance):
            bearing, free = turn, True
            break
    ahead = free_distance(obs, 0.0, ROBOT_ROOM)
    speed = mind.speed
    if abs(bearing) > 1.1 or ahead < 40.0:
        speed = 0.0
    elif abs(bearing) > 0.5 or ahead < LOOK:
        speed *= 0.5
    if not free and ahead < 80.0:
        speed = 0.0
    dash = mind.dash and obs.goal_distance > 350.0 and obs.turbo > 0.4 and abs(bearing) < 0.25 and ahead > LOOK
    set_action(action, speed, turn_stick(bearing, obs.angular, obs.turn_rate, PERIOD), 0, 1 if dash else 0)


@kernel
def free_distance(obs: FactoryObservation, turn: float, robots: float) -> float:
    """Free distance in direction `turn` (rad, relative to the heading), px; 1000 if nothing is in the way.

    It ends PERSON_ROOM px from a person or `robots` px from a robot.
    """
    free = 1000.0
    for w in range(WORKERS):
        person = obs.people[w]
        if person.distance < 2.0 * LOOK:
            free = min(free, free_gap(person.distance, person.bearing - turn, PERSON_ROOM))
    for i in range(OTHERS):
        other = obs.others[i]
        if other.present and other.distance < LOOK:
            free = min(free, free_gap(other.distance, other.bearing - turn, robots))
    return free


@kernel
def free_gap(distance: float, bearing: float, clearance: float) -> float:
    """Distance along bearing 0 until an obstacle at (`distance`, `bearing`) is `clearance` px away; 1000 if never."""
    ahead, aside = distance * cos(bearing), distance * sin(bearing)
    if ahead <= 0.0 or aside >= clearance or aside <= -clearance:
        return 1000.0
    before = ahead - sqrt(clearance * clearance - aside * aside)
    return before if before > 0.0 else 0.0


@kernel
def update_patience(obs: FactoryObservation, mind: Mind) -> None:
    """`keep_patience`, with progress measured along the route."""
    left = obs.goal_distance
    if not obs.straight:
        left = CELL * mind.senses.route.reach[node_at(obs.x, obs.y)]
    keep_patience(obs, mind, left if left > 0.0 else FAR)


@kernel
def make_detour(obs: FactoryObservation, mind: Mind, action: Action) -> None:
    """Drive towards another slot for a while, so that the route to the target changes."""
    slot, route = obs.slots[mind.via], mind.senses.route
    moved = route.goal_x != slot.x or route.goal_y != slot.y
    route.active, route.goal_x, route.goal_y = 1, slot.x, slot.y
    mind.detour -= PERIOD
    if moved:
        set_action(action, 0.0, 0.0, 0, 0)
        return
    if obs.goal_distance < STAND_OFF:
        mind.detour = 0
    follow_route(obs, mind, action)
