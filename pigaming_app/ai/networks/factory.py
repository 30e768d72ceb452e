"""Robot Factory as a network sees it: 140 inputs, and four heads of choices.

Directions are given as cosine and sine relative to the own heading. The first inputs about the work are the three best
targets: slots at which the next step of the work can be done now or soon, the cheapest first. With an empty fork these
are pallets to lift, else places for the load. A warehouse counts once, by its best slot.
"""

from math import cos, sin, sqrt

from pigaming_app.ai.networks.encoding import ANYWHERE, Encoding, Inputs, encode_room, nearest_robot, saturating, whole
from pigaming_app.ai.networks.factory_targets import (
    CHOSEN,
    STALLED,
    FactoryNetworkSenses,
    find_targets,
    is_left_to_mate,
)
from pigaming_app.games.factory.rules import slot_for
from pigaming_app.games.factory.state import INPUT, MACHINE_SLOTS, MACHINES, WORKERS, WORKING, A, B, Factory
from pigaming_app.games.factory.workers import fits
from pigaming_app.sim.action import set_action
from pigaming_app.sim.flow_field import update_route
from pigaming_app.sim.grid import node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import CELL, HEIGHT, HZ, ROBOTS, WIDTH, Robot

GROUPS = (
    ("motion", 5),
    ("load", 9),
    ("score", 8),
    ("place", 4),
    ("way", 5),
    ("target", 11),
    ("second", 11),
    ("third", 11),
    ("machines", 28),
    ("others", 24),
    ("people", 12),
    ("room", 8),
    ("rules", 4),
)
MOTION, LOAD, SCORE, PLACE, WAY, TARGETS, MACHINE, OTHERS, PEOPLE, ROOM, RULES, SIZE = (
    0, 5, 14, 22, 26, 31, 64, 92, 116, 128, 136, 140
)  # first input of each group  # fmt: skip
TARGET, ONE_MACHINE, OTHER, PERSON = 11, 7, 8, 4  # inputs for each of them
HEADS = (("drive", 3), ("turn", 7), ("fire", 2), ("turbo", 2))
TURNS = (-1.0, -0.36, -0.11, 0.0, 0.11, 0.36, 1.0)  # positions of the stick; a full turn is 17 degrees a decision

NEAR = 300.0  # px at which nearness is 1/2
FINE = 60.0  # px between fork and slot that fill the range
RAYS, STEPS = 8, 6  # directions in which it looks for room, and steps in each
DIAGONAL = 0.7071067811865476


@kernel
def encode(match: Factory, seat: int, senses: FactoryNetworkSenses, inputs: Inputs) -> None:
    """Fill in the inputs of one seat."""
    for i in range(SIZE):
        inputs[i] = 0.0
    me = match.robots[seat]
    ahead_x, ahead_y = cos(me.heading), sin(me.heading)
    find_targets(match, seat, senses)
    encode_self(match, seat, senses, ahead_x, ahead_y, inputs)
    encode_score(match, seat, inputs)
    for i in range(CHOSEN):
        if senses.slots[i] >= 0:
            encode_target(match, seat, senses.slots[i], ahead_x, ahead_y, TARGETS + TARGET * i, inputs)
    encode_way(match, me, senses, ahead_x, ahead_y, inputs)
    encode_machines(match, seat, ahead_x, ahead_y, inputs)
    encode_others(match, seat, senses, ahead_x, ahead_y, inputs)
    encode_people(match, me, ahead_x, ahead_y, inputs)
    encode_room(match, me, ahead_x, ahead_y, RAYS, STEPS, DIAGONAL, DIAGONAL, ROOM, inputs)


@kernel
def encode_self(
    match: Factory, seat: int, senses: FactoryNetworkSenses, ahead_x: float, ahead_y: float, inputs: Inputs
) -> None:
    """The own robot, its load, and what its fork would do now."""
    me, load, rules = match.robots[seat], match.loads[seat], match.rules
    inputs[MOTION], inputs[MOTION + 1] = whole(me.linear / 400.0), whole(me.angular / rules.turn_rate)
    inputs[MOTION + 2], inputs[MOTION + 3] = whole(me.turbo), whole(me.boosting)
    inputs[MOTION + 4] = whole(load.frozen / (rules.freeze + 1.0))
    if load.pallet:
        pallet = match.pallets[load.pallet - 1]
        inputs[LOAD + 1 + pallet.state] = whole(1.0)
        inputs[LOAD + 5] = whole(pallet.rush / (60.0 * HZ))
    else:
        inputs[LOAD] = whole(1.0)
    inputs[LOAD + 6], inputs[LOAD + 7] = whole(load.pressed), whole(1.0 if load.refused else 0.0)
    within = slot_for(match, seat, me.x + rules.fork * ahead_x, me.y + rules.fork * ahead_y)
    if within >= 0:
        wanted = within == senses.slots[0] or within == senses.slots[1] or within == senses.slots[2]
        inputs[LOAD + 8] = whole(1.0 if wanted else -1.0)
    inputs[PLACE], inputs[PLACE + 1] = whole(2.0 * me.x / WIDTH - 1.0), whole(2.0 * me.y / HEIGHT - 1.0)
    inputs[PLACE + 2], inputs[PLACE + 3] = whole(ahead_x), whole(ahead_y)


@kernel
def encode_score(match: Factory, seat: int, inputs: Inputs) -> None:
    """Deliveries or points, the clock and the stars it still allows, and the rules."""
    team, rules = match.robots[seat].team, match.rules
    ours, theirs = match.delivered[team], match.delivered[1 - team]
    lead = match.points[team] - match.points[1 - team] if rules.party else ours - theirs
    inputs[SCORE], inputs[SCORE + 1] = whole(saturating(0.5 * lead)), whole(saturating(0.1 * lead))
    left = rules.ticks - match.tick
    inputs[SCORE + 2], inputs[SCORE + 3] = whole(left / (120.0 * HZ)), whole(1.0 if left < 0 else 0.0)
    if rules.pallets:
        inputs[SCORE + 4] = whole((rules.pallets - ours) / 8.0)
        inputs[SCORE + 5] = whole((rules.pallets - theirs) / 8.0)
    if rules.allies:
        inputs[SCORE + 6] = whole((rules.three_stars - match.tick) / (60.0 * HZ))
        inputs[SCORE + 7] = whole((rules.two_stars - match.tick) / (60.0 * HZ))
    inputs[RULES], inputs[RULES + 1] = whole(rules.party), whole(rules.allies)
    inputs[RULES + 2] = whole(1.0 if team else -1.0)
    if rules.party:
        inputs[RULES + 3] = whole(1.0 - match.tick % rules.fast_every / rules.fast_every)


@kernel
def encode_target(match: Factory, seat: int, s: int, ahead_x: float, ahead_y: float, k: int, inputs: Inputs) -> None:
    """Slot s as a target, from input k on."""
    me, slot, rules = match.robots[seat], match.slots[s], match.rules
    dx, dy = slot.x - me.x, slot.y - me.y
    distance = sqrt(dx * dx + dy * dy) + 1e-9
    along, across = ahead_x * dx + ahead_y * dy, ahead_x * dy - ahead_y * dx
    ready = 1.0
    if match.loads[seat].pallet:
        ready = 0.0 if slot.pallet else 1.0
    elif slot.pallet:
        pallet = match.pallets[slot.pallet - 1]
        inputs[k + 8], inputs[k + 9] = whole(0.5 * pallet.state), whole(pallet.rush / (60.0 * HZ))
    else:
        machine = match.machines[slot.machine]
        inputs[k + 8] = whole(0.5 if machine.kind == A else 1.0)
        ready = 1.0 / (1.0 + machine.left / HZ) - 1.0
    inputs[k], inputs[k + 1], inputs[k + 2] = whole(1.0), whole(ready), whole(NEAR / (NEAR + distance))
    inputs[k + 3], inputs[k + 4] = whole(along / distance), whole(across / distance)
    inputs[k + 5], inputs[k + 6] = whole((along - rules.fork) / FINE), whole(across / FINE)
    inputs[k + 7] = whole(1.0 if is_left_to_mate(match, seat, s) else 0.0)
    if slot.kind == INPUT:
        machine = match.machines[slot.machine]
        inputs[k + 10] = whole(-1.0 if machine.fast else machine.stalled / (STALLED * HZ))


@kernel
def encode_way(
    match: Factory, me: Robot, senses: FactoryNetworkSenses, ahead_x: float, ahead_y: float, inputs: Inputs
) -> None:
    """The way to the first target."""
    if senses.slots[0] < 0:
        return
    slot, route = match.slots[senses.slots[0]], senses.route
    route.active, route.goal_x, route.goal_y = 1, slot.x, slot.y
    update_route(match, route, me.x, me.y)
    dx, dy = route.waypoint_x - me.x, route.waypoint_y - me.y
    distance = sqrt(dx * dx + dy * dy) + 1e-9
    path = distance if route.straight else CELL * route.reach[node_at(me.x, me.y)]
    inputs[WAY], inputs[WAY + 1] = (
        whole((ahead_x * dx + ahead_y * dy) / distance),
        whole((ahead_x * dy - ahead_y * dx) / distance),
    )
    inputs[WAY + 2], inputs[WAY + 3] = whole(route.straight), whole(distance / 400.0)
    inputs[WAY + 4] = whole(path / 1600.0)


@kernel
def encode_machines(match: Factory, seat: int, ahead_x: float, ahead_y: float, inputs: Inputs) -> None:
    """All machines: the nearer and the farther one of kind A, then those of kind B."""
    me = match.robots[seat]
    for kind in (A, B):
        first, second, nearest2 = -1, -1, 0.0
        for m in range(MACHINES):
            machine = match.machines[m]
            if machine.kind != kind:
                continue
            dx, dy = machine.x - me.x, machine.y - me.y
            if first < 0 or dx * dx + dy * dy < nearest2:
                first, second, nearest2 = m, first, dx * dx + dy * dy
            else:
                second = m
        k = MACHINE + (0 if kind == A else 2 * ONE_MACHINE)
        encode_machine(match, me, first, ahead_x, ahead_y, k, inputs)
        encode_machine(match, me, second, ahead_x, ahead_y, k + ONE_MACHINE, inputs)


@kernel
def encode_machine(match: Factory, me: Robot, m: int, ahead_x: float, ahead_y: float, k: int, inputs: Inputs) -> None:
    """Machine m, from input k on."""
    machine, rules = match.machines[m], match.rules
    dx, dy = machine.x - me.x, machine.y - me.y
    distance = sqrt(dx * dx + dy * dy) + 1e-9
    inputs[k] = whole((ahead_x * dx + ahead_y * dy) / distance)
    inputs[k + 1] = whole((ahead_x * dy - ahead_y * dx) / distance)
    inputs[k + 2] = whole(NEAR / (NEAR + distance))
    waiting, ready = match.slots[MACHINE_SLOTS + 2 * m].pallet, match.slots[MACHINE_SLOTS + 2 * m + 1].pallet
    if waiting:
        inputs[k + 3] = whole(1.0 if fits(machine.kind, match.pallets[waiting - 1].state) else -1.0)
    if ready:
        inputs[k + 4] = whole(1.0 if match.pallets[ready - 1].team == me.team else -1.0)
    if machine.pallet:
        ours = match.pallets[machine.pallet - 1].team == me.team
        inputs[k + 5] = whole((1.0 if ours else -1.0) * (0.25 + 0.75 * machine.left / rules.process))
    if machine.worker:
        inputs[k + 6] = whole(1.0 if match.workers[machine.worker - 1].task == WORKING else 0.5)
    else:
        inputs[k + 6] = whole(-machine.stalled / (STALLED * HZ))


@kernel
def encode_others(
    match: Factory, seat: int, senses: FactoryNetworkSenses, ahead_x: float, ahead_y: float, inputs: Inputs
) -> None:
    """The other robots, the nearest first."""
    told = 0
    for place in range(ROBOTS - 1):
        j = nearest_robot(match, seat, told, ANYWHERE)
        if j < 0:
            break
        told |= 1 << j
        encode_other(match, match.robots[seat], j, senses, ahead_x, ahead_y, OTHERS + OTHER * place, inputs)


@kernel
def encode_other(
    match: Factory,
    me: Robot,
    j: int,
    senses: FactoryNetworkSenses,
    ahead_x: float,
    ahead_y: float,
    k: int,
    inputs: Inputs,
) -> None:
    """Robot j, from input k on."""
    robot, load = match.robots[j], match.loads[j]
    heading = robot.heading - senses.delay * robot.angular
    vx, vy = robot.linear * cos(heading), robot.linear * sin(heading)
    true_x, true_y = robot.x - me.x - senses.delay * vx, robot.y - me.y - senses.delay * vy
    dx, dy = true_x - senses.error * true_y, true_y + senses.error * true_x
    distance = sqrt(dx * dx + dy * dy) + 1e-9
    inputs[k], inputs[k + 1] = whole(1.0 if robot.team == me.team else -1.0), whole(NEAR / (NEAR + distance))
    inputs[k + 2] = whole((ahead_x * dx + ahead_y * dy) / distance)
    inputs[k + 3] = whole((ahead_x * dy - ahead_y * dx) / distance)
    inputs[k + 4] = whole((ahead_x * vx + ahead_y * vy) / 400.0)
    inputs[k + 5] = whole((ahead_x * vy - ahead_y * vx) / 400.0)
    if load.pallet:
        inputs[k + 6] = whole(0.25 * (match.pallets[load.pallet - 1].state + 1))
    inputs[k + 7] = whole(load.frozen / (match.rules.freeze + 1.0))


@kernel
def encode_people(match: Factory, me: Robot, ahead_x: float, ahead_y: float, inputs: Inputs) -> None:
    """The workers, the nearest first: how near they are, where, and how directly they walk towards the robot."""
    told = 0
    for place in range(WORKERS):
        best, least = 0, 1e18
        for w in range(WORKERS):
            dx, dy = match.workers[w].x - me.x, match.workers[w].y - me.y
            if not (told >> w) & 1 and dx * dx + dy * dy < least:
                best, least = w, dx * dx + dy * dy
        told |= 1 << best
        worker, distance, k = match.workers[best], sqrt(least) + 1e-9, PEOPLE + PERSON * place
        dx, dy = worker.x - me.x, worker.y - me.y
        inputs[k] = whole(1.0 / (1.0 + distance / 150.0))
        inputs[k + 1] = whole((ahead_x * dx + ahead_y * dy) / distance)
        inputs[k + 2] = whole((ahead_x * dy - ahead_y * dx) / distance)
        if worker.walking:
            inputs[k + 3] = whole(-(cos(worker.heading) * dx + sin(worker.heading) * dy) / distance)


@kernel
def act(match: Factory, seat: int, choices: list[int]) -> None:
    """Stick and buttons from the choices of the four heads."""
    set_action(match.actions[seat], choices[0] - 1.0, TURNS[choices[1]], choices[2], choices[3])


ENCODING = Encoding("factory", GROUPS, HEADS, encode, act, FactoryNetworkSenses)
