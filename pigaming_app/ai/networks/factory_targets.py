"""Robot Factory as a network sees it: the slots at which the next step of the work can be done, the cheapest first.

With an empty fork these are pallets to lift, else places for the load. A warehouse counts once, by its best slot. Costs
are in px of driving; waiting times count as the way that a robot drives in them.
"""

from math import sqrt
from typing import Annotated

from pigaming_app.ai.networks.encoding import NetworkSenses
from pigaming_app.games.factory.rules import may_lift
from pigaming_app.games.factory.state import (
    DAMAGED,
    DONE,
    ENTRY,
    EXIT,
    HALF,
    MACHINE_SLOTS,
    MACHINES,
    RAW,
    SHARED_SLOTS,
    SHELVES,
    TEAMS,
    A,
    Factory,
)
from pigaming_app.games.factory.workers import fits
from pigaming_app.sim.flow_field import Route
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.world import HZ, ROBOTS

CHOSEN = 3  # targets
NONE = 1e18  # px, cost of a target that is missing
SPEED = 230.0  # px/s, mean speed on a way
TAKEN = 400.0  # px, cost of a slot that a mate will reach first
EARLY = 250.0  # px, cost of a raw pallet, since pallets nearer to completion come first
FULL = 900.0  # px, cost of an occupied place, and of a pallet whose next places are occupied
FAST = 350.0  # px, bonus of the fast machine
STALLED = 12.0  # s without a worker after which a machine counts as out of order


@record
class FactoryNetworkSenses(NetworkSenses):
    """Parameters of the observation, the targets of the moment, and the route to the first of them."""

    slots: Annotated[list[int], CHOSEN]  # the targets, -1: none
    costs: Annotated[list[float], CHOSEN]  # px
    route: Route


@kernel
def find_targets(match: Factory, seat: int, senses: FactoryNetworkSenses) -> None:
    """Choose the targets of a seat."""
    for i in range(CHOSEN):
        senses.slots[i], senses.costs[i] = -1, NONE
    if match.loads[seat].pallet:
        find_places(match, seat, senses)
    else:
        find_pallets(match, seat, senses)


@kernel
def find_pallets(match: Factory, seat: int, senses: FactoryNetworkSenses) -> None:
    """Choose targets for an empty fork: pallets that it may lift, and those about to leave a machine."""
    after_raw, after_half = FULL, FULL  # px, if a raw or a half-done pallet has no free place
    for m in range(MACHINES):
        if not match.slots[MACHINE_SLOTS + 2 * m].pallet:
            if match.machines[m].kind == A:
                after_raw = 0.0
            else:
                after_half = 0.0
    after_raw += EARLY
    for block in range(2 * TEAMS):
        best, least = -1, NONE
        for s in range(block * SHELVES, (block + 1) * SHELVES):
            if match.slots[s].pallet and may_lift(match, seat, s):
                cost = cost_of_pallet(match, seat, s, after_raw, after_half)
                if cost < least:
                    best, least = s, cost
        consider(senses, best, least)
    for m in range(MACHINES):
        s = MACHINE_SLOTS + 2 * m + 1
        machine = match.machines[m]
        if match.slots[s].pallet:
            if may_lift(match, seat, s):
                consider(senses, s, cost_of_pallet(match, seat, s, after_raw, after_half))
        elif machine.pallet and match.pallets[machine.pallet - 1].team == match.robots[seat].team:
            consider(senses, s, cost_of_way(match, seat, s) + SPEED * machine.left / HZ)
    for s in range(SHARED_SLOTS, match.slot_count):
        if match.slots[s].pallet:
            consider(senses, s, cost_of_pallet(match, seat, s, after_raw, after_half))


@kernel
def find_places(match: Factory, seat: int, senses: FactoryNetworkSenses) -> None:
    """Choose targets for a loaded fork: where its pallet belongs."""
    state, team = match.pallets[match.loads[seat].pallet - 1].state, match.robots[seat].team
    if state in (RAW, HALF):
        for m in range(MACHINES):
            s, machine = MACHINE_SLOTS + 2 * m, match.machines[m]
            if fits(machine.kind, state):
                cost = cost_of_way(match, seat, s) - (FAST if machine.fast else 0.0) + SPEED * stall(match, m)
                if match.slots[s].pallet:
                    cost += FULL + SPEED * machine.left / HZ
                consider(senses, s, cost)
        return
    kind = EXIT if state == DONE else ENTRY
    for block in range(2 * TEAMS):
        best, least = -1, NONE
        for s in range(block * SHELVES, (block + 1) * SHELVES):
            slot = match.slots[s]
            if slot.kind == kind and slot.team == team and not slot.pallet:
                cost = cost_of_way(match, seat, s)
                if cost < least:
                    best, least = s, cost
        consider(senses, best, least)


@kernel
def cost_of_pallet(match: Factory, seat: int, s: int, after_raw: float, after_half: float) -> float:
    """Cost of lifting the pallet of slot s next, px; NONE for a damaged one."""
    state = match.pallets[match.slots[s].pallet - 1].state
    if state == DAMAGED:
        return NONE
    cost = cost_of_way(match, seat, s)
    if state == RAW:
        cost += after_raw
    elif state == HALF:
        cost += after_half
    return cost


@kernel
def cost_of_way(match: Factory, seat: int, s: int) -> float:
    """Distance from a seat's robot to slot s, more if a mate will be there first, px."""
    dx, dy = match.slots[s].x - match.robots[seat].x, match.slots[s].y - match.robots[seat].y
    return sqrt(dx * dx + dy * dy) + (TAKEN if is_left_to_mate(match, seat, s) else 0.0)


@kernel
def is_left_to_mate(match: Factory, seat: int, s: int) -> bool:
    """True if a mate with the same need of slot s is nearer to it, or has announced it."""
    me, slot = match.robots[seat], match.slots[s]
    loaded = match.loads[seat].pallet > 0
    dx, dy = slot.x - me.x, slot.y - me.y
    own2 = dx * dx + dy * dy
    left = False
    for i in range(1, ROBOTS):
        j = (seat + i) % ROBOTS
        mate = match.robots[j]
        if mate.present and mate.team == me.team:
            load = match.loads[j]
            dx, dy = slot.x - mate.x, slot.y - mate.y
            if load.aim == s + 1 or (load.aim == 0 and (load.pallet > 0) == loaded and dx * dx + dy * dy < own2):
                left = True
    return left


@kernel
def stall(match: Factory, m: int) -> float:
    """Time for which machine m has had work and no worker, s; short times are common and count as 0."""
    seconds = match.machines[m].stalled / HZ
    return seconds if seconds > 0.5 * STALLED else 0.0


@kernel
def consider(senses: FactoryNetworkSenses, s: int, cost: float) -> None:
    """Sort slot s among the targets, if it is one of the cheapest."""
    if cost >= senses.costs[CHOSEN - 1]:
        return
    place = CHOSEN - 1
    while place > 0 and cost < senses.costs[place - 1]:
        senses.slots[place], senses.costs[place] = senses.slots[place - 1], senses.costs[place - 1]
        place -= 1
    senses.slots[place], senses.costs[place] = s, cost
