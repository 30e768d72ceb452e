"""Schedules of the factory planner: the next transports of a team, simulated on a small model of the floor.

A transport is one pallet's way from where it lies to the next machine, or to the exit. `plan` tries every transport
that a robot could begin now. For each it plays the rest of the schedule: the robot that is free first takes the
transport with the lowest score, until `depth` transports are planned. The transport whose schedule delivers earliest is
chosen; announced targets of mates are kept. Times are in seconds from now.

The model: robots drive straight at PACE and lose TURN a way; a machine works PROCESS s from the arrival of a worker,
and only while its output is empty; an output is emptied when a planned transport lifts its pallet.
"""

from math import sqrt
from typing import Annotated, Any

from pigaming_app.games.factory.observation import OTHERS
from pigaming_app.games.factory.state import DAMAGED, DONE, ENTRY, EXIT, HALF, INPUT, MACHINE_SLOTS, MACHINES, OUTPUT, RAW, WORKERS, A
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.world import HEIGHT, ROBOTS, WIDTH

LOTS = 12  # pallets in the model, at most
NEVER = 1e6  # s
PACE = 270.0  # px/s
TURN = 0.55  # s lost to turning and accelerating on a way
PROCESS = 6.0  # s
FAST_PROCESS = 2.0  # s, of the fast machine
WALK = 130.0  # px/s, of workers
SPOT = 62.0  # px from a machine's centre at which a worker is as good as there
REST = 80.0  # px from the middle of the floor at which workers rest
MIDDLE_X, MIDDLE_Y = 0.5 * WIDTH, 0.5 * HEIGHT
BESIDE = 130.0  # px between a machine's centre and its worker, at most
CLEARED = 5.0  # s after which others are expected to empty an output
STAGES = 9.0, 9.0, 2.0  # s that a raw, half-done or done pallet still needs after the last planned transport
RUSH_TIMES = 22.0, 12.0, 3.0  # s that a raw, half-done or done pallet needs to be delivered


@record
class Lot:
    """A pallet of the schedule."""

    state: int
    lies: int  # slot in which it lies, or will
    ready: float  # s until it can be lifted; NEVER: in a robot, or not before an output is emptied
    rush: float  # s left to its deadline, 0: none


@record
class Bench:
    """A machine of the schedule."""

    makes: int
    into: int  # slot
    out: int
    x: float
    y: float
    free: float  # s until its input is free
    clear: float  # s until its output is
    idle: float  # s until it stops processing, negative if it has stopped
    queue: int  # 1 + the lot that waits in its input for the output to be emptied; 0: none
    fast: int


@record
class Hand:
    """A robot of the schedule."""

    x: float
    y: float
    free: float  # s until it can begin its next transport
    lot: int  # 1 + the lot that it carries; 0: none
    first: int  # 1 + the lot, of those that lie ready, that it has announced; 0: none
    into: int  # 1 + the slot for the lot that it carries, if announced; 0: none


@record
class Helper:
    """A worker of the schedule, who walks home from (x, y) from `free` on."""

    x: float
    y: float
    free: float  # s until the worker has nothing to do


@record
class Stage:
    """A state of the model."""

    lots: Annotated[list[Lot], LOTS]
    benches: Annotated[list[Bench], MACHINES]
    hands: Annotated[list[Hand], ROBOTS]
    helpers: Annotated[list[Helper], WORKERS]


@record
class Plan:
    """Memory of the planner: the present state, and that of the schedule being tried."""

    lots: int
    hands: int
    now: Stage
    then: Stage
    depth: int  # transports of a schedule
    stage_bonus: Annotated[list[float], 3]  # s, by state of a pallet
    unblock: float  # s, bonus of emptying an output for which a pallet waits
    carry: float  # weight of the loaded way and of waiting at its end
    last: float  # weight of the latest delivery, compared with the mean of all
    keep: float  # s, bonus of the present target
    keep_laden: float  # s, the same while it carries a pallet
    turn: float  # s lost on a way
    rush: float  # s, value of a rush order that is delivered in time
    hurry: float  # s, bonus of a rush order that can still be in time
    rules: int  # dispatch rules that are tried for each first transport
    shift: Annotated[list[float], 3]  # s, added to the bonus by state in the rule being tried
    exit: int  # slot for done pallets


@kernel
def way(plan: Any, x: float, y: float, slot: Any) -> float:
    """Time of a way from (x, y) to a slot, s."""
    dx, dy = slot.x - x, slot.y - y
    return plan.turn + max(0.0, sqrt(dx * dx + dy * dy) - 90.0) / PACE


@kernel
def survey(obs: Any, plan: Any) -> None:
    """Fill in `plan.now` from the observation."""
    now = plan.now
    lots = 0
    survey_helpers(obs, now)
    for m in range(MACHINES):
        bench, into, out = now.benches[m], obs.slots[MACHINE_SLOTS + 2 * m], obs.slots[MACHINE_SLOTS + 2 * m + 1]
        bench.makes, bench.fast = into.makes, into.fast
        bench.into, bench.out = MACHINE_SLOTS + 2 * m, MACHINE_SLOTS + 2 * m + 1
        bench.queue, bench.free, bench.clear, bench.idle = 0, 0.0, 0.0, 0.0
        bench.x, bench.y = 0.5 * (into.x + out.x), 0.5 * (into.y + out.y)
        if into.wait > 0.0:  # in process
            bench.idle = into.wait
            if into.ours and lots < LOTS:
                add(now.lots[lots], HALF if into.makes == A else DONE, bench.out, into.wait, 0.0)
                lots += 1
                bench.clear = NEVER
            else:
                bench.clear = into.wait + CLEARED
        elif out.holds:
            if out.lift and out.holds - 1 != DAMAGED and lots < LOTS:
                add(now.lots[lots], out.holds - 1, bench.out, 0.0, out.rush)
                lots += 1
                bench.clear = NEVER
            else:
                bench.clear = CLEARED
        if into.holds:
            fits = into.holds - 1 == (RAW if into.makes == A else HALF)
            if not fits:
                bench.free = CLEARED
            elif bench.clear == NEVER:
                bench.free = NEVER
                if into.lift and lots < LOTS:
                    add(now.lots[lots], into.holds, bench.out, NEVER, into.rush)
                    lots += 1
                    bench.queue = lots
                else:
                    bench.queue = -1
            else:
                done = work(now, bench, bench.clear)
                if into.lift and lots < LOTS:
                    add(now.lots[lots], into.holds, bench.out, done, into.rush)
                    lots += 1
                    bench.clear = NEVER
                else:
                    bench.clear = done + CLEARED
    for s in range(obs.slot_count):
        slot = obs.slots[s]
        if slot.holds and slot.lift and slot.machine < 0 and lots < LOTS:
            state = slot.holds - 1
            if state <= DONE and not (slot.kind == EXIT and state == DONE):
                add(now.lots[lots], state, s, 0.0, slot.rush)
                lots += 1
    hands = 1
    hand = now.hands[0]
    hand.x, hand.y, hand.free, hand.lot, hand.first, hand.into = obs.x, obs.y, obs.frozen * 0.02, 0, 0, 0
    if obs.carries and lots < LOTS:
        add(now.lots[lots], obs.carries - 1, -1, NEVER, obs.rush)
        lots += 1
        hand.lot = lots
    for i in range(OTHERS):
        other = obs.others[i]
        if not other.present or not other.mate:
            continue
        hand = now.hands[hands]
        hand.x, hand.y, hand.free, hand.lot, hand.first, hand.into = other.x, other.y, other.frozen * 0.02, 0, 0, 0
        hands += 1
        if other.carries:
            if lots < LOTS and other.carries - 1 <= DONE:
                add(now.lots[lots], other.carries - 1, -1, NEVER, 0.0)
                lots += 1
                hand.lot = lots
                hand.into = other.aim
        elif other.aim:
            for k in range(lots):
                if now.lots[k].lies == other.aim - 1 and now.lots[k].ready < NEVER:
                    hand.first = k + 1
    plan.lots, plan.hands = lots, hands
    plan.exit = nearest_exit(obs)
    for i in range(1, hands):
        hand = now.hands[i]
        if hand.lot and hand.into:
            set_down(obs, plan, now, hand, hand.into)
            hand.into = 0


@kernel
def survey_helpers(obs: Any, now: Any) -> None:
    """Fill in the workers: those at a machine are busy until it is done."""
    for w in range(WORKERS):
        person, helper = obs.people[w], now.helpers[w]
        helper.x, helper.y, helper.free = person.x, person.y, 0.0
        for m in range(MACHINES):
            into, out = obs.slots[MACHINE_SLOTS + 2 * m], obs.slots[MACHINE_SLOTS + 2 * m + 1]
            dx, dy = person.goal_x - 0.5 * (into.x + out.x), person.goal_y - 0.5 * (into.y + out.y)
            if into.wait > 0.0 and dx * dx + dy * dy < BESIDE * BESIDE:
                helper.free = into.wait


@kernel
def work(then: Any, bench: Any, at: float) -> float:
    """Let the worker who is there first begin work at a machine, not before `at`; returns the time when it is done."""
    if bench.fast:
        bench.free, bench.idle = at, at + FAST_PROCESS
        return bench.idle
    best, soonest = 0, NEVER
    for w in range(WORKERS):
        helper = then.helpers[w]
        leave = max(at, helper.free)
        dx, dy = MIDDLE_X - helper.x, MIDDLE_Y - helper.y
        off = sqrt(dx * dx + dy * dy)
        share = min(WALK * (leave - helper.free), max(0.0, off - REST)) / (off + 1.0)
        dx, dy = helper.x + share * dx - bench.x, helper.y + share * dy - bench.y
        begin = leave + max(0.0, sqrt(dx * dx + dy * dy) - SPOT) / WALK
        if begin < soonest:
            best, soonest = w, begin
    helper = then.helpers[best]
    dx, dy = MIDDLE_X - bench.x, MIDDLE_Y - bench.y
    off = SPOT / (sqrt(dx * dx + dy * dy) + 1.0)
    bench.free, bench.idle = soonest, soonest + PROCESS
    helper.x, helper.y, helper.free = bench.x + off * dx, bench.y + off * dy, bench.idle
    return bench.idle


@kernel
def add(lot: Any, state: int, lies: int, ready: float, rush: float) -> None:
    """Fill in a lot."""
    lot.state, lot.lies, lot.ready, lot.rush = state, lies, ready, rush


@kernel
def nearest_exit(obs: Any) -> int:
    """A free slot of the own exit, the one nearest to the middle of the floor's machines; any if none is free."""
    best, least = 0, 1e18
    for s in range(MACHINE_SLOTS):
        slot = obs.slots[s]
        if slot.kind == EXIT and slot.mine == 1:
            dx, dy = slot.x - obs.x, slot.y - obs.y
            cost = dx * dx + dy * dy + (1e12 if slot.holds else 0.0)
            if cost < least:
                best, least = s, cost
    return best


@kernel
def restart(plan: Any) -> None:
    """Set `plan.then` to the present."""
    now, then = plan.now, plan.then
    for k in range(plan.lots):
        a, b = then.lots[k], now.lots[k]
        a.state, a.lies, a.ready, a.rush = b.state, b.lies, b.ready, b.rush
    for m in range(MACHINES):
        c, d = then.benches[m], now.benches[m]
        c.makes, c.into, c.out, c.fast, c.x, c.y = d.makes, d.into, d.out, d.fast, d.x, d.y
        c.free, c.clear, c.idle, c.queue = d.free, d.clear, d.idle, d.queue
    for i in range(plan.hands):
        e, f = then.hands[i], now.hands[i]
        e.x, e.y, e.free, e.lot, e.first, e.into = f.x, f.y, f.free, f.lot, f.first, f.into
    for w in range(WORKERS):
        g, h = then.helpers[w], now.helpers[w]
        g.x, g.y, g.free = h.x, h.y, h.free


@kernel
def best_bench(obs: Any, plan: Any, then: Any, kind: int, x: float, y: float, leave: float) -> int:
    """The machine of a kind that could start soonest on a pallet that leaves (x, y) at `leave`; -1 if all are full."""
    best, least = -1, NEVER
    for m in range(MACHINES):
        bench = then.benches[m]
        if bench.makes != kind or bench.free >= NEVER:
            continue
        start = max(leave + way(plan, x, y, obs.slots[bench.into]), bench.free)
        begin = max(start, bench.clear if bench.clear < NEVER else max(bench.idle, start) + 3.0, bench.idle)
        cost = 0.5 * (start + begin) - (4.0 if bench.fast else 0.0)
        if cost < least:
            best, least = m, cost
    return best


@kernel
def put_into(obs: Any, plan: Any, then: Any, hand: Any, k: int, m: int, leave: float) -> float:
    """Let a hand bring lot k from where the hand is at `leave` into machine m; returns the time of putting down."""
    lot, bench = then.lots[k], then.benches[m]
    slot = obs.slots[bench.into]
    put = max(leave + way(plan, hand.x, hand.y, slot), bench.free)
    hand.x, hand.y, hand.free, hand.lot = slot.x, slot.y, put, 0
    lot.state, lot.lies, lot.ready = lot.state + 1, bench.out, NEVER
    if bench.clear >= NEVER:
        bench.queue, bench.free = k + 1, NEVER
    else:
        begin_work(then, bench, k, max(put, bench.clear))
    return put


@kernel
def begin_work(then: Any, bench: Any, k: int, at: float) -> None:
    """Let a machine begin work on lot k, not before `at`."""
    then.lots[k].ready = work(then, bench, max(at, bench.idle))
    bench.clear = NEVER


@kernel
def deliver(obs: Any, plan: Any, then: Any, hand: Any, k: int, s: int, leave: float) -> float:
    """Let a hand bring lot k from where the hand is at `leave` to exit slot s; returns the time of the delivery."""
    slot, lot = obs.slots[s], then.lots[k]
    put = leave + way(plan, hand.x, hand.y, slot)
    hand.x, hand.y, hand.free, hand.lot = slot.x, slot.y, put, 0
    lot.state, lot.ready = DONE + 1, put
    return put


@kernel
def lift(obs: Any, plan: Any, then: Any, hand: Any, k: int) -> None:
    """Let a hand drive to lot k and lift it; an emptied output lets its machine go on."""
    lot = then.lots[k]
    slot = obs.slots[lot.lies]
    hand.free = max(hand.free + way(plan, hand.x, hand.y, slot), lot.ready)
    hand.x, hand.y, hand.lot, hand.first = slot.x, slot.y, k + 1, 0
    lot.ready = NEVER
    if slot.kind == OUTPUT:
        bench = then.benches[slot.machine]
        bench.clear = hand.free
        if bench.queue:
            waits = bench.queue - 1
            bench.queue = 0
            if waits >= 0:
                begin_work(then, bench, waits, hand.free)
            else:
                bench.free, bench.clear = hand.free + 1.0, hand.free + PROCESS + CLEARED


@kernel
def set_down(obs: Any, plan: Any, then: Any, hand: Any, wish: int) -> int:
    """Let a hand put its lot down, if announced in slot wish - 1; 0 if there is no place."""
    k = hand.lot - 1
    lot = then.lots[k]
    if lot.state == DONE:
        s = plan.exit
        if wish and obs.slots[wish - 1].kind == EXIT:
            s = wish - 1
        deliver(obs, plan, then, hand, k, s, hand.free)
        return 1
    kind = lot.state  # RAW goes to A, HALF to B
    m = -1
    if wish and obs.slots[wish - 1].kind == INPUT:
        m = obs.slots[wish - 1].machine
        if then.benches[m].makes != kind or then.benches[m].free >= NEVER:
            m = -1
    if m < 0:
        m = best_bench(obs, plan, then, kind, hand.x, hand.y, hand.free)
    if m < 0:
        return 0
    put_into(obs, plan, then, hand, k, m, hand.free)
    return 1


@kernel
def next_lot(obs: Any, plan: Any, i: int) -> int:
    """The lot with the lowest score for hand i; -1 if there is none."""
    then = plan.then
    hand = then.hands[i]
    best, least = -1, NEVER
    for k in range(plan.lots):
        lot = then.lots[k]
        if lot.ready >= NEVER or lot.state > DONE or promised(plan, k, i):
            continue
        slot = obs.slots[lot.lies]
        at = max(hand.free + way(plan, hand.x, hand.y, slot), lot.ready)
        score = at - plan.stage_bonus[lot.state] - plan.shift[lot.state]
        if lot.state == DONE:
            score += plan.carry * way(plan, slot.x, slot.y, obs.slots[plan.exit])
        else:
            m = best_bench(obs, plan, then, lot.state, slot.x, slot.y, at)
            if m < 0:
                continue
            bench = then.benches[m]
            score += plan.carry * (max(at + way(plan, slot.x, slot.y, obs.slots[bench.into]), bench.free) - at)
        if lot.rush > RUSH_TIMES[lot.state] + at:
            score -= plan.hurry
        if slot.kind == OUTPUT and then.benches[slot.machine].queue:
            score -= plan.unblock
        if score < least:
            best, least = k, score
    return best


@kernel
def promised(plan: Any, k: int, i: int) -> bool:
    """True if another hand than i is to take lot k first."""
    found = False
    for j in range(plan.hands):
        if j != i and plan.then.hands[j].first == k + 1:
            found = True
    return found


@kernel
def play_out(obs: Any, plan: Any) -> float:
    """Play the schedule in `plan.then` to its end; returns its cost, s."""
    then = plan.then
    for _ in range(min(plan.depth, 3 * plan.lots + 4)):
        i = 0
        for j in range(1, plan.hands):
            if then.hands[j].free < then.hands[i].free:
                i = j
        hand = then.hands[i]
        if hand.free >= NEVER:
            break
        if not hand.lot:
            k = hand.first - 1
            if k < 0:
                k = next_lot(obs, plan, i)
            if k < 0:
                hand.free = next_change(plan, hand.free)
                continue
            lift(obs, plan, then, hand, k)
        if not set_down(obs, plan, then, hand, hand.into):
            hand.free += 2.0
        hand.into = 0
    return cost(plan)


@kernel
def choose_rule(plan: Any, rule: int) -> None:
    """Set the shifts of a dispatch rule; rule 0 has none."""
    for state in range(3):
        plan.shift[state] = 0.0
    if rule:
        state = (rule - 1) // 2 % 3
        size = 3.0 if rule < 7 else 8.0
        plan.shift[state] = size if rule % 2 else -size


@kernel
def next_change(plan: Any, at: float) -> float:
    """Time at which a hand without a transport looks again: when another one is free; NEVER if none is."""
    soonest = NEVER
    for j in range(plan.hands):
        free = plan.then.hands[j].free
        if at < free < soonest:
            soonest = free
    return soonest + 0.01


@kernel
def cost(plan: Any) -> float:
    """Mean time of delivery of the lots, and `plan.last` times the latest, s."""
    total, latest = 0.0, 0.0
    end = NEVER
    for j in range(plan.hands):
        end = min(end, plan.then.hands[j].free)
    if end >= NEVER:
        end = 0.0
        for j in range(plan.hands):
            free = plan.then.hands[j].free
            end = max(end, free if free < NEVER else 0.0)
    for k in range(plan.lots):
        lot = plan.then.lots[k]
        at = lot.ready
        if lot.state <= DONE:
            at = (end if at >= NEVER else max(end, at)) + STAGES[lot.state]
            for state in range(lot.state + 1, DONE + 1):
                at += STAGES[state]
        total += at
        if at < lot.rush:
            total -= plan.rush
        latest = max(latest, at)
    return total / max(1, plan.lots) + plan.last * latest
