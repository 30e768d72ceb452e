"""What a brain sees of a match of Robot Factory: named numbers, as from the robot's own seat.

Bearings are relative to the own heading, in (-pi, pi], clockwise positive. Others and people are seen as they were
`delay` seconds ago, by their speed; the own pose is never delayed.
"""

from math import atan2, cos, sin, sqrt
from typing import Annotated, Any

from pigaming_app.games.factory.rules import may_lift, may_set_down
from pigaming_app.games.factory.state import INPUT, SLOTS, WORKERS
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.flow_field import Route, update_route
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.world import ROBOTS

OTHERS = ROBOTS - 1


@record
class Senses:
    """Parameters of the observation of one seat, and its route."""

    delay: float  # s by which others are seen late
    route: Route


@record
class Other:
    """Another robot, in the order of the seats after one's own."""

    present: int
    mate: int
    x: float
    y: float
    distance: float
    bearing: float
    speed: float  # px/s, ahead positive
    heading: float  # relative to the own heading
    carries: int  # 1 + the state of what it carries, 0: nothing
    frozen: int
    aim: int  # 1 + the slot that it makes for, 0: it does not say


@record
class Person:
    """A worker."""

    x: float
    y: float
    distance: float
    bearing: float
    walking: int
    goal_x: float  # where it walks to
    goal_y: float


@record
class SlotView:
    """A slot."""

    kind: int
    mine: int  # 1: of the own team, 0: of a machine, -1: of the others
    machine: int
    makes: int  # kind of the machine, -1: of a warehouse
    x: float
    y: float
    holds: int  # 1 + the state of its pallet, 0: empty
    lift: int  # 1: this robot could lift what lies there, if it were there with its fork empty
    put: int  # 1: this robot could put there what it carries
    output_blocked: int  # of an input: 1 while something lies in the output of its machine
    wait: float  # s until the machine is done; 0: it is not working
    stalled: float  # of an input: s for which nobody has come to the machine that has work; falls again without work
    ours: int  # 1: what the machine works on, or has done, is of the own team


@record
class Observation:
    """What one seat sees."""

    x: float
    y: float
    heading: float
    linear: float
    angular: float
    turn_rate: float
    fork: float
    fork_x: float
    fork_y: float
    turbo: float
    frozen: int
    carries: int  # 1 + the state of what it carries, 0: nothing
    refused: int
    seconds_left: float
    lead: int  # own team's deliveries less the others'
    others: Annotated[list[Other], OTHERS]
    people: Annotated[list[Person], WORKERS]
    slots: Annotated[list[SlotView], SLOTS]
    way_x: float  # where to drive now, along the route
    way_y: float
    way_bearing: float
    way_distance: float
    goal_bearing: float
    goal_distance: float  # as the crow flies
    straight: int  # 1: nothing is in the way to the goal


@kernel
def observe(match: Any, seat: int, senses: Any, obs: Any) -> None:
    """Fill the observation of one seat."""
    robot, load, rules = match.robots[seat], match.loads[seat], match.rules
    obs.x, obs.y, obs.heading = robot.x, robot.y, robot.heading
    obs.linear, obs.angular, obs.turn_rate = robot.linear, robot.angular, rules.turn_rate
    obs.fork = rules.fork
    obs.fork_x = robot.x + rules.fork * cos(robot.heading)
    obs.fork_y = robot.y + rules.fork * sin(robot.heading)
    obs.turbo, obs.frozen, obs.refused = robot.turbo, load.frozen, load.refused
    obs.carries = match.pallets[load.pallet - 1].state + 1 if load.pallet else 0
    obs.seconds_left = (rules.ticks - match.tick) * 0.02
    obs.lead = match.delivered[robot.team] - match.delivered[1 - robot.team]
    for i in range(OTHERS):
        observe_other(match, robot, (seat + 1 + i) % ROBOTS, senses.delay, obs.others[i])
    for w in range(WORKERS):
        observe_person(match, robot, w, obs.people[w])
    for s in range(SLOTS):
        observe_slot(match, seat, s, obs.slots[s])
    observe_way(match, robot, senses, obs)


@kernel
def observe_other(match: Any, robot: Any, j: int, delay: float, other: Any) -> None:
    """Robot j as `robot` sees it."""
    seen, load, motion = match.robots[j], match.loads[j], match.motions[j]
    other.present, other.mate = seen.present, 1 if seen.team == robot.team else 0
    if not seen.present:
        return
    other.x, other.y = seen.x - delay * motion.vx, seen.y - delay * motion.vy
    dx, dy = other.x - robot.x, other.y - robot.y
    other.distance = sqrt(dx * dx + dy * dy)
    other.bearing = turn_to(atan2(dy, dx) - robot.heading)
    other.speed, other.heading = seen.linear, turn_to(seen.heading - robot.heading)
    other.carries = match.pallets[load.pallet - 1].state + 1 if load.pallet else 0
    other.frozen, other.aim = load.frozen, load.aim


@kernel
def observe_person(match: Any, robot: Any, w: int, person: Any) -> None:
    """Worker w as `robot` sees it."""
    worker = match.workers[w]
    person.x, person.y, person.walking = worker.x, worker.y, worker.walking
    dx, dy = worker.x - robot.x, worker.y - robot.y
    person.distance = sqrt(dx * dx + dy * dy)
    person.bearing = turn_to(atan2(dy, dx) - robot.heading)
    person.goal_x, person.goal_y = worker.route.goal_x, worker.route.goal_y


@kernel
def observe_slot(match: Any, seat: int, s: int, place: Any) -> None:
    """Slot s as the robot of a seat sees it."""
    slot, team = match.slots[s], match.robots[seat].team
    place.kind, place.machine, place.x, place.y = slot.kind, slot.machine, slot.x, slot.y
    place.mine = 0 if slot.machine >= 0 else 1 if slot.team == team else -1
    place.holds = match.pallets[slot.pallet - 1].state + 1 if slot.pallet else 0
    place.lift = 1 if may_lift(match, seat, s) else 0
    place.put = 1 if match.loads[seat].pallet and may_set_down(match, seat, s) else 0
    place.makes, place.wait, place.stalled, place.output_blocked, place.ours = -1, 0.0, 0.0, 0, 0
    if slot.machine >= 0:
        machine = match.machines[slot.machine]
        place.makes = machine.kind
        place.wait = machine.left * 0.02 if machine.pallet else 0.0
        if slot.kind == INPUT:
            place.stalled = machine.stalled * 0.02
        if machine.keeps:
            place.output_blocked = 1
            place.ours = 1 if match.pallets[machine.keeps - 1].team == team else 0


@kernel
def observe_way(match: Any, robot: Any, senses: Any, obs: Any) -> None:
    """Where to drive now, along the route."""
    route = senses.route
    if not route.wanted:
        obs.way_x, obs.way_y, obs.way_bearing, obs.way_distance = robot.x, robot.y, 0.0, 0.0
        obs.goal_bearing, obs.goal_distance, obs.straight = 0.0, 0.0, 1
        return
    update_route(match, route, robot.x, robot.y)
    obs.way_x, obs.way_y, obs.straight = route.way_x, route.way_y, route.straight
    dx, dy = route.way_x - robot.x, route.way_y - robot.y
    obs.way_distance = sqrt(dx * dx + dy * dy)
    obs.way_bearing = turn_to(atan2(dy, dx) - robot.heading)
    dx, dy = route.goal_x - robot.x, route.goal_y - robot.y
    obs.goal_distance = sqrt(dx * dx + dy * dy)
    obs.goal_bearing = turn_to(atan2(dy, dx) - robot.heading)
