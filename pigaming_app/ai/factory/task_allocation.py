"""What a driver of Robot Factory does next: jobs, what they cost, and how two mates share them out.

A job is a slot: to lift what lies there, or to put down there what is carried. `mind` is a ForemanMind.
"""

from math import sqrt
from typing import Any

from pigaming_app.games.factory.observation import OTHERS
from pigaming_app.games.factory.state import DAMAGED, DONE, ENTRY, EXIT, HALF, INPUT, OUTPUT, RAW, SLOTS, A, B
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.rng import uniform

NO = 1e8  # a cost that says: impossible
SPEED = 230.0  # px/s that a robot makes on the way, to weigh ways against waiting
KEEP = 90.0  # px by which the job that one is about seems cheaper, so that plans stay
BLOCKED = 320.0  # px that an input costs whose machine's output is taken
QUEUE = 900.0  # px that it costs to lift what cannot be put down yet
FREES = 300.0  # px that it is worth to free a machine
HOME = 5000.0  # px by which waiting at home seems farther than where something will come out
NOISE = 600.0  # px by which who reckons badly is wrong
STALLED = 12.0  # s without a worker after which a pallet is taken out of a machine's input again
SLOW = 6.0  # s without one that count against a machine at all; less is common
SHUN = 2000.0  # px by which a slot seems farther that could not be got at
LATER = 260.0  # px by which a raw pallet seems farther: what is nearer to the exit comes first


@kernel
def choose_job(obs: Any, mind: Any) -> None:
    """Set the target of the mind; `near`: it is not free, go near it and wait."""
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
def is_taken(obs: Any, s: int) -> bool:
    """Whether a mate says that it makes for slot s."""
    said = False
    for i in range(OTHERS):
        other = obs.others[i]
        if other.present and other.mate and other.aim == s + 1:
            said = True
    return said


@kernel
def away(obs: Any, s: int) -> float:
    """The px from the robot to slot s."""
    dx, dy = obs.slots[s].x - obs.x, obs.slots[s].y - obs.y
    return sqrt(dx * dx + dy * dy)


@kernel
def between(obs: Any, s: int, t: int) -> float:
    """The px from slot s to slot t."""
    dx, dy = obs.slots[s].x - obs.slots[t].x, obs.slots[s].y - obs.slots[t].y
    return sqrt(dx * dx + dy * dy)


@kernel
def hindrance(slot: Any) -> float:
    """The px that it costs to put something into a slot whose machine cannot begin at once."""
    if slot.kind != INPUT:
        return 0.0
    return delay(slot) + (BLOCKED if slot.output_blocked else 0.0)


@kernel
def delay(slot: Any) -> float:
    """The px that the time weighs for which nobody has come to the machine of an input."""
    return slot.stalled * SPEED if slot.stalled > SLOW else 0.0


@kernel
def shyness(mind: Any, s: int) -> float:
    """The px by which slot s seems farther because it could not be got at."""
    return SHUN if mind.shun > 0 and mind.shunned == s else 0.0


@kernel
def may_take(slot: Any, state: int) -> bool:
    """Whether a pallet in a state is at its right place in a slot."""
    if slot.kind == INPUT:
        return bool((slot.makes == A and state == RAW) or (slot.makes == B and state == HALF))
    return bool(slot.kind == EXIT and slot.mine == 1 and state == DONE)


@kernel
def cheapest_place(obs: Any, mind: Any) -> int:
    """Where to put down what is carried; -1: nowhere now."""
    state = obs.carries - 1
    best, least = -1, NO
    for s in range(SLOTS):
        slot = obs.slots[s]
        if not slot.put or is_taken(obs, s):
            continue
        right = slot.kind == ENTRY if state == DAMAGED else may_take(slot, state)
        if not right:
            continue
        cost = away(obs, s) + hindrance(slot) + shyness(mind, s)
        if mind.target == s:
            cost -= KEEP
        if cost < least:
            best, least = s, cost
    if best < 0 and mind.waiting > 16:  # for eight seconds: back to the shelf, and do something else
        for s in range(SLOTS):
            slot = obs.slots[s]
            if slot.put and slot.kind == ENTRY and away(obs, s) < least:
                best, least = s, away(obs, s)
    return best


@kernel
def onward(obs: Any, s: int, state: int) -> float:
    """The px from slot s to the best free place for a pallet in that state; NO: there is none."""
    least = NO
    for t in range(SLOTS):
        slot = obs.slots[t]
        if may_take(slot, state) and not slot.holds and not is_taken(obs, t):
            cost = between(obs, s, t) + hindrance(slot)
            if cost < least:
                least = cost
    return least


@kernel
def cost_of(obs: Any, s: int, queue: float) -> float:
    """What it costs to do the job at slot s, after the way there; `queue`: if it must then wait for a free place."""
    slot = obs.slots[s]
    if not slot.lift:
        return NO
    state = slot.holds - 1
    if state == DAMAGED:
        return NO
    then = onward(obs, s, state)
    if may_take(
        slot, state
    ):  # where it should be, unless nobody comes to the machine and it would be better off elsewhere
        return then if slot.kind == INPUT and slot.stalled > STALLED and then < slot.stalled * SPEED else NO
    if slot.kind == OUTPUT:  # whatever it is, it frees a machine
        return min(then, queue) - FREES
    return then + LATER if state == RAW and then < NO else then


@kernel
def share_out(obs: Any, mind: Any) -> int:
    """The slot from which to lift next, when the mate's next job is thought of too; -1: nothing to do."""
    mate = -1
    for i in range(OTHERS):
        if obs.others[i].present and obs.others[i].mate:
            mate = i
    alone = mate < 0 or obs.others[mate].carries  # somebody must keep the fork free, to clear the machines
    queue = NO if alone else QUEUE
    best, least = -1, NO
    for s in range(SLOTS):
        then = cost_of(obs, s, queue)
        if then >= NO - FREES or (alone and is_taken(obs, s)):
            continue
        cost = away(obs, s) + then + shyness(mind, s) - (KEEP if mind.target == s else 0.0)
        if mind.noise > 0.0:
            cost += mind.noise * NOISE * uniform(mind)
        if not alone:
            cost += best_other(obs, obs.others[mate], s, queue)
        if cost < least:
            best, least = s, cost
    return best


@kernel
def best_other(obs: Any, mate: Any, without: int, queue: float) -> float:
    """What the mate's best job costs it if it leaves slot `without` to this robot."""
    least = 3000.0
    for s in range(SLOTS):
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
def waiting_place(obs: Any, mind: Any) -> int:
    """The slot near which to wait: where what is carried will go, or the own next pallet come out, or at home."""
    best, least = -1, NO
    state = obs.carries - 1
    for s in range(SLOTS):
        slot = obs.slots[s]
        if obs.carries:
            good = may_take(slot, state) or (state == DAMAGED and slot.kind == ENTRY and slot.mine == 1)
        else:
            good = slot.mine == 1 or (slot.kind == OUTPUT and slot.ours == 1)
        if good and not is_taken(obs, s):
            cost = away(obs, s) + slot.wait * SPEED + delay(slot) + shyness(mind, s)
            if slot.mine == 1:
                cost += HOME
            if cost < least:
                best, least = s, cost
    return best
