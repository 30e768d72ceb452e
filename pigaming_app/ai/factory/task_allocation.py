"""Task allocation of the factory brain: job costs, and the division of jobs between two mates.

Among three or four allies, a slot that any of them has announced is left to them.

A job is a slot at which to lift a pallet, or to put one down. Costs are in px of driving; times count as px at SPEED.
"""

from math import sqrt

from pigaming_app.ai.factory.mind import Mind
from pigaming_app.games.factory.observation import OTHERS, FactoryObservation, FactoryOther, SlotView
from pigaming_app.games.factory.state import DAMAGED, DONE, ENTRY, EXIT, HALF, INPUT, OUTPUT, RAW, A, B
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import uniform

NO = 1e8  # cost of an impossible job
SPEED = 230.0  # px/s, mean speed on a route, to convert waiting times into px
KEEP = 90.0  # px, bonus of the present job: hysteresis against changing plans
BLOCKED = 320.0  # px, cost of an input while the output of its machine is occupied
QUEUE = 900.0  # px, cost of lifting a pallet that cannot be put down yet
FREES = 300.0  # px, bonus for clearing the output of a machine
HOME = 5000.0  # px, cost of waiting at home, so that waiting at an output comes first
NOISE = 600.0  # px, largest estimation error at `mind.noise` 1
STALLED = 12.0  # s without a worker after which a pallet is taken back out of a machine's input
SLOW = 6.0  # s without a worker before that counts as a delay; less is common
AVOID_COST = 2000.0  # px, cost of the avoided slot, which could not be reached
LATER = 260.0  # px, cost of a raw pallet, so that pallets nearer to completion come first
RUSH = 1200.0  # px, bonus of a rush order that can still be delivered in time
RUSH_TIMES = 26.0, 14.0, 4.0  # s that a raw, half-done or done pallet needs at least to be delivered
FAST = 350.0  # px, bonus of the fast machine


@record
class ForemanMind(Mind):
    """Memory of the driver."""

    pause: int  # ticks of pause after each job
    joint: int  # 1: considers the job of its mate when it chooses its own


@kernel
def choose_job(obs: FactoryObservation, mind: ForemanMind) -> None:
    """Set `mind.target`, and `mind.near` if it is only a place to wait at."""
    mind.near = 0
    best = cheapest_place(obs, mind) if obs.carries else share_out(obs, mind)
    if best >= 0:
        mind.target = best
        if not obs.carries or may_take(obs.slots[best], obs.carries - 1):
            mind.waiting = 0  # but not on the way back to the shelf
        return
    mind.waiting += 1
    mind.near = 1
    mind.target = waiting_place(obs, mind)


@kernel
def is_taken(obs: FactoryObservation, s: int) -> bool:
    """True if a mate has announced slot s as its target."""
    taken = False
    for i in range(OTHERS):
        other = obs.others[i]
        if other.present and other.mate and other.aim == s + 1:
            taken = True
    return taken


@kernel
def distance_to(obs: FactoryObservation, s: int) -> float:
    """Distance from the robot to slot s, px."""
    dx, dy = obs.slots[s].x - obs.x, obs.slots[s].y - obs.y
    return sqrt(dx * dx + dy * dy)


@kernel
def distance_between(obs: FactoryObservation, s: int, t: int) -> float:
    """Distance from slot s to slot t, px."""
    dx, dy = obs.slots[s].x - obs.slots[t].x, obs.slots[s].y - obs.slots[t].y
    return sqrt(dx * dx + dy * dy)


@kernel
def input_cost(slot: SlotView) -> float:
    """Cost of an input whose machine cannot start at once, px; negative for the fast machine."""
    if slot.kind != INPUT:
        return 0.0
    return delay(slot) + (BLOCKED if slot.output_blocked else 0.0) - (FAST if slot.fast else 0.0)


@kernel
def delay(slot: SlotView) -> float:
    """Cost of the time for which an input's machine has had no worker, px."""
    return slot.stalled * SPEED if slot.stalled > SLOW else 0.0


@kernel
def avoid_cost(mind: Mind, s: int) -> float:
    """AVOID_COST for the avoided slot, else 0, px."""
    return AVOID_COST if mind.avoid_ticks > 0 and mind.avoided == s else 0.0


@kernel
def may_take(slot: SlotView, state: int) -> bool:
    """True if a pallet in `state` belongs into the slot."""
    if slot.kind == INPUT:
        return bool((slot.makes == A and state == RAW) or (slot.makes == B and state == HALF))
    return bool(slot.kind == EXIT and slot.mine == 1 and state == DONE)


@kernel
def cheapest_place(obs: FactoryObservation, mind: Mind) -> int:
    """Cheapest slot for the carried pallet; -1 if none is free."""
    state = obs.carries - 1
    best, least = -1, NO
    for s in range(obs.slot_count):
        slot = obs.slots[s]
        if not slot.put or is_taken(obs, s):
            continue
        right = slot.kind == ENTRY if state == DAMAGED else may_take(slot, state)
        if not right:
            continue
        cost = distance_to(obs, s) + input_cost(slot) + avoid_cost(mind, s)
        if mind.target == s:
            cost -= KEEP
        if cost < least:
            best, least = s, cost
    if best < 0 and mind.waiting > 16:  # eight seconds without a place: return it to the shelf, and take another job
        for s in range(obs.slot_count):
            slot = obs.slots[s]
            if slot.put and slot.kind == ENTRY and distance_to(obs, s) < least:
                best, least = s, distance_to(obs, s)
    return best


@kernel
def onward_cost(obs: FactoryObservation, s: int, state: int) -> float:
    """Cost from slot s to the best free place for a pallet in `state`, px; NO if there is none."""
    least = NO
    for t in range(obs.slot_count):
        slot = obs.slots[t]
        if may_take(slot, state) and not slot.holds and not is_taken(obs, t):
            cost = distance_between(obs, s, t) + input_cost(slot)
            if cost < least:
                least = cost
    return least


@kernel
def cost_of(obs: FactoryObservation, s: int, queue: float) -> float:
    """Cost of the job at slot s without the way there, px; NO if impossible.

    `queue`: cost of clearing an output while no place for its pallet is free.
    """
    slot = obs.slots[s]
    if not slot.lift:
        return NO
    state = slot.holds - 1
    if state == DAMAGED:
        return NO
    then = onward_cost(obs, s, state)
    if then < NO and slot.rush > RUSH_TIMES[state]:
        then -= RUSH
    if may_take(slot, state):  # in its right place: move it only if the machine stalls and another place is cheaper
        return then if slot.kind == INPUT and slot.stalled > STALLED and then < slot.stalled * SPEED else NO
    if slot.kind == OUTPUT:  # any pallet here blocks its machine
        return min(then, queue) - FREES
    return then + LATER if state == RAW and then < NO else then


@kernel
def share_out(obs: FactoryObservation, mind: ForemanMind) -> int:
    """Slot to lift from next, minimising the joint cost of this job and the mate's best other one; -1 if none."""
    mate, mates = -1, 0
    for i in range(OTHERS):
        if obs.others[i].present and obs.others[i].mate:
            mate, mates = i, mates + 1
    alone = mates != 1 or obs.others[mate].carries  # one fork must stay free to clear the machines
    queue = NO if alone else QUEUE
    best, least = -1, NO
    for s in range(obs.slot_count):
        then = cost_of(obs, s, queue)
        if then >= NO - FREES or (alone and is_taken(obs, s)):
            continue
        cost = distance_to(obs, s) + then + avoid_cost(mind, s) - (KEEP if mind.target == s else 0.0)
        if mind.noise > 0.0:
            cost += mind.noise * NOISE * uniform(mind)
        if not alone and mind.joint:
            cost += best_other(obs, obs.others[mate], s, queue)
        if cost < least:
            best, least = s, cost
    return best


@kernel
def best_other(obs: FactoryObservation, mate: FactoryOther, without: int, queue: float) -> float:
    """Cost of the mate's best job without slot `without`, px; 3000 if there is none."""
    least = 3000.0
    for s in range(obs.slot_count):
        if s == without:
            continue
        then = cost_of(obs, s, queue)
        if then < NO - FREES:
            dx, dy = obs.slots[s].x - mate.x, obs.slots[s].y - mate.y
            cost = sqrt(dx * dx + dy * dy) + then - (KEEP if mate.aim == s + 1 else 0.0)
            if cost < least:
                least = cost
    return least


@kernel
def waiting_place(obs: FactoryObservation, mind: Mind) -> int:
    """Slot to wait at: a future place for the load, an output about to be ready, or home."""
    best, least = -1, NO
    state = obs.carries - 1
    for s in range(obs.slot_count):
        slot = obs.slots[s]
        if obs.carries:
            good = may_take(slot, state) or (state == DAMAGED and slot.kind == ENTRY and slot.mine == 1)
        else:
            good = slot.mine == 1 or (slot.kind == OUTPUT and slot.ours == 1)
        if good and not is_taken(obs, s):
            cost = distance_to(obs, s) + slot.wait * SPEED + delay(slot) + avoid_cost(mind, s)
            if slot.mine == 1:
                cost += HOME
            if cost < least:
                best, least = s, cost
    return best
