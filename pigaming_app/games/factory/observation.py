"""Robot Factory: a brain's observation of a match, as named numbers relative to its own seat.

Bearings are relative to the robot's own heading, in (-pi, pi], clockwise positive. Positions of other robots are
extrapolated back by `delay` seconds; the own pose is not delayed.
"""

from math import atan2, cos, sin, sqrt
from typing import Annotated

from pigaming_app.games.factory.rules import may_lift, may_set_down
from pigaming_app.games.factory.state import INPUT, NOBODY, SHARED_SLOTS, SLOTS, WORKERS, Factory
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.flow_field import Route, update_route
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.world import ROBOTS, Robot

OTHERS = ROBOTS - 1


@record
class FactorySenses:
    """Parameters of the observation of one seat, and its route."""

    delay: float  # s, age of the poses of others
    route: Route


@record
class FactoryOther:
    """Another robot, in seat order after the own seat."""

    present: int
    mate: int
    x: float
    y: float
    distance: float
    bearing: float
    speed: float  # px/s, forward positive
    heading: float  # relative to the own heading
    carries: int  # 1 + the state of its pallet, 0: none
    frozen: int
    aim: int  # 1 + the slot that it declares as its target, 0: none


@record
class Person:
    """A worker."""

    x: float
    y: float
    distance: float
    bearing: float
    walking: int
    goal_x: float  # its destination
    goal_y: float


@record
class SlotView:
    """A slot, as observed by one robot."""

    kind: int
    mine: int  # 1: of the own team, 0: of a machine or shared, -1: of the other team
    machine: int
    makes: int  # kind of the machine, -1: a warehouse slot
    x: float
    y: float
    holds: int  # 1 + the state of its pallet, 0: empty
    lift: int  # 1: this robot may lift its pallet, with an empty fork within reach
    put: int  # 1: this robot may set down its pallet there
    output_blocked: int  # 1 while the machine's output holds a pallet or is reserved for one
    wait: float  # s until the machine is done; 0: it is idle
    stalled: float  # of an input: s for which work has waited for a worker; counts down without work
    ours: int  # 1: the pallet in process, or in the output, belongs to the own team
    rush: float  # s left to the deadline of its pallet, a rush order; 0: none
    fast: int  # 1: a slot of the fast machine
    theirs: int  # 1: in party, its pallet is loose or the other team's


@record
class FactoryObservation:
    """The observation of one seat. Positions and distances in px."""

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
    carries: int  # 1 + the state of its pallet, 0: none
    refused: int
    seconds_left: float
    lead: int  # own team's deliveries less the other team's; in party points
    others: Annotated[list[FactoryOther], OTHERS]
    people: Annotated[list[Person], WORKERS]
    slots: Annotated[list[SlotView], SLOTS]
    waypoint_x: float  # waypoint of the route
    waypoint_y: float
    waypoint_bearing: float
    waypoint_distance: float
    goal_bearing: float
    goal_distance: float  # straight-line
    straight: int  # 1: the straight line to the goal is clear
    rush: float  # s left to the deadline of its pallet, a rush order; 0: none
    slot_count: int = SHARED_SLOTS  # slots that exist, from the first


@kernel
def observe(match: Factory, seat: int, senses: FactorySenses, obs: FactoryObservation) -> None:
    """Fill in the observation of one seat."""
    robot, load, rules = match.robots[seat], match.loads[seat], match.rules
    obs.x, obs.y, obs.heading = robot.x, robot.y, robot.heading
    obs.linear, obs.angular, obs.turn_rate = robot.linear, robot.angular, rules.turn_rate
    obs.fork = rules.fork
    obs.fork_x = robot.x + rules.fork * cos(robot.heading)
    obs.fork_y = robot.y + rules.fork * sin(robot.heading)
    obs.turbo, obs.frozen, obs.refused = robot.turbo, load.frozen, load.refused
    obs.carries = match.pallets[load.pallet - 1].state + 1 if load.pallet else 0
    obs.rush = match.pallets[load.pallet - 1].rush * 0.02 if load.pallet else 0.0
    obs.seconds_left = (rules.ticks - match.tick) * 0.02
    obs.lead = match.delivered[robot.team] - match.delivered[1 - robot.team]
    if rules.party:
        obs.lead = match.points[robot.team] - match.points[1 - robot.team]
    for i in range(OTHERS):
        observe_other(match, robot, (seat + 1 + i) % ROBOTS, senses.delay, obs.others[i])
    obs.slot_count = match.slot_count
    for w in range(WORKERS):
        observe_person(match, robot, w, obs.people[w])
    for s in range(match.slot_count):
        observe_slot(match, seat, s, obs.slots[s])
    observe_waypoint(match, robot, senses, obs)


@kernel
def observe_other(match: Factory, robot: Robot, j: int, delay: float, other: FactoryOther) -> None:
    """Fill in robot j, as observed by `robot`."""
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
def observe_person(match: Factory, robot: Robot, w: int, person: Person) -> None:
    """Fill in worker w, as observed by `robot`."""
    worker = match.workers[w]
    person.x, person.y, person.walking = worker.x, worker.y, worker.walking
    dx, dy = worker.x - robot.x, worker.y - robot.y
    person.distance = sqrt(dx * dx + dy * dy)
    person.bearing = turn_to(atan2(dy, dx) - robot.heading)
    person.goal_x, person.goal_y = worker.route.goal_x, worker.route.goal_y


@kernel
def observe_slot(match: Factory, seat: int, s: int, seen: SlotView) -> None:
    """Fill in slot s, as observed by the robot of a seat."""
    slot, team = match.slots[s], match.robots[seat].team
    seen.kind, seen.machine, seen.x, seen.y = slot.kind, slot.machine, slot.x, slot.y
    seen.mine = 0 if slot.team == NOBODY else 1 if slot.team == team else -1
    seen.holds = match.pallets[slot.pallet - 1].state + 1 if slot.pallet else 0
    seen.rush, seen.theirs = 0.0, 0
    if match.rules.party and slot.pallet:
        pallet = match.pallets[slot.pallet - 1]
        seen.rush, seen.theirs = pallet.rush * 0.02, 1 if pallet.team != team else 0
    seen.lift = 1 if may_lift(match, seat, s) else 0
    seen.put = 1 if match.loads[seat].pallet and may_set_down(match, seat, s) else 0
    seen.makes, seen.wait, seen.stalled, seen.output_blocked, seen.ours = -1, 0.0, 0.0, 0, 0
    if slot.machine >= 0:
        machine = match.machines[slot.machine]
        seen.makes, seen.fast = machine.kind, machine.fast
        seen.wait = machine.left * 0.02 if machine.pallet else 0.0
        if slot.kind == INPUT:
            seen.stalled = machine.stalled * 0.02
        if machine.reserved:
            seen.output_blocked = 1
            seen.ours = 1 if match.pallets[machine.reserved - 1].team == team else 0


@kernel
def observe_waypoint(match: Factory, robot: Robot, senses: FactorySenses, obs: FactoryObservation) -> None:
    """Fill in the waypoint and goal of the route."""
    route = senses.route
    if not route.active:
        obs.waypoint_x, obs.waypoint_y, obs.waypoint_bearing, obs.waypoint_distance = robot.x, robot.y, 0.0, 0.0
        obs.goal_bearing, obs.goal_distance, obs.straight = 0.0, 0.0, 1
        return
    update_route(match, route, robot.x, robot.y)
    obs.waypoint_x, obs.waypoint_y, obs.straight = route.waypoint_x, route.waypoint_y, route.straight
    dx, dy = route.waypoint_x - robot.x, route.waypoint_y - robot.y
    obs.waypoint_distance = sqrt(dx * dx + dy * dy)
    obs.waypoint_bearing = turn_to(atan2(dy, dx) - robot.heading)
    dx, dy = route.goal_x - robot.x, route.goal_y - robot.y
    obs.goal_distance = sqrt(dx * dx + dy * dy)
    obs.goal_bearing = turn_to(atan2(dy, dx) - robot.heading)
