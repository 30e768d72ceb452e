"""Schedules of the factory planner: the transports of a whole team, played out on the model of the floor.

A transport is one pallet's way from where it lies to the next machine, or to the exit. The robot that is free first
takes the transport with the lowest score, and so on until everything is delivered. The score is the time of lifting,
less bonuses; a dispatch rule shifts the bonus of one state of pallets, so that several schedules can be compared.

All times are in seconds from now.
"""

from math import sqrt
from typing import Annotated

from pigaming_app.ai.factory.floor_model import (
    CLEARED,
    NEVER,
    PROCESS,
    Bench,
    Model,
    TeamRobot,
    copy_model,
    survey,
    work,
)
from pigaming_app.games.factory.observation import FactoryObservation, SlotView
from pigaming_app.games.factory.state import DONE, EXIT, INPUT, MACHINE_SLOTS, MACHINES, OUTPUT
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record

PACE = 270.0  # px/s, mean speed of a robot on its way
REACHED = 90.0  # px from a slot at which the fork can be used
STAGES = 9.0, 9.0, 2.0  # s that a raw, half-done or done pallet still needs at the end of an unfinished schedule
RUSH_TIMES = 22.0, 12.0, 3.0  # s that a raw, half-done or done pallet needs to be delivered
QUEUED = 3.0  # s for which a pallet is expected to wait behind another one
FAST = 4.0  # s, bonus of the fast machine
SHIFT, FAR_SHIFT = 3.0, 8.0  # s by which dispatch rules differ
RULES = 13  # dispatch rules that exist


@record
class Plan:
    """Memory of the planner."""

    now: Model
    then: Model  # of the schedule being played out
    shift: Annotated[list[float], 3]  # s, bonus of the present dispatch rule, by state of a pallet
    exit: int  # slot for done pallets
    rules: int  # dispatch rules that are compared for each first transport
    raw: float = -1.0  # s, bonus by state of a pallet
    half: float = 0.25
    done: float = -0.6
    unblock: float = 3.8  # s, bonus of an output for which another pallet waits
    hurry: float = 3.0  # s, bonus of a rush order that can still be in time
    carry: float = 0.54  # weight of the loaded way and of waiting at its end
    turn: float = 0.26  # s lost on a way by turning
    last: float = 0.36  # weight of the last delivery, compared with the mean of all
    rush: float = 30.0  # s, value of a rush order that is delivered in time


@kernel
def look(obs: FactoryObservation, plan: Plan) -> None:
    """Fill in the present, with the announced transports of laden mates carried out."""
    now = plan.now
    survey(obs, now)
    plan.exit = nearest_exit(obs)
    for i in range(1, now.hand_count):
        hand = now.hands[i]
        if hand.lot and hand.into:
            set_down(obs, plan, now, hand)


@kernel
def nearest_exit(obs: FactoryObservation) -> int:
    """The nearest free slot of the own exit; a taken one if there is no other."""
    best, least = 0, 1e18
    for s in range(MACHINE_SLOTS):
        slot = obs.slots[s]
        if slot.kind == EXIT and slot.mine == 1:
            dx, dy = slot.x - obs.x, slot.y - obs.y
            far = dx * dx + dy * dy + (1e12 if slot.holds else 0.0)
            if far < least:
                best, least = s, far
    return best


@kernel
def way(plan: Plan, x: float, y: float, slot: SlotView) -> float:
    """Time of a way from (x, y) to a slot."""
    dx, dy = slot.x - x, slot.y - y
    return plan.turn + max(0.0, sqrt(dx * dx + dy * dy) - REACHED) / PACE


@kernel
def best_machine(
    obs: FactoryObservation, plan: Plan, model: Model, state: int, x: float, y: float, leave: float
) -> int:
    """The machine that could start soonest on a pallet in `state` that leaves (x, y) at `leave`; -1 if all are full."""
    best, least = -1, NEVER
    for m in range(MACHINES):
        bench = model.benches[m]
        if bench.makes != state or bench.free >= NEVER:  # machines A take raw pallets, B half-done ones
            continue
        put = max(leave + way(plan, x, y, obs.slots[MACHINE_SLOTS + 2 * m]), bench.free)
        begin = max(put, bench.idle) + QUEUED if bench.clear >= NEVER else max(put, bench.clear, bench.idle)
        cost = 0.5 * (put + begin) - (FAST if bench.fast else 0.0)
        if cost < least:
            best, least = m, cost
    return best


@kernel
def lift(obs: FactoryObservation, plan: Plan, model: Model, hand: TeamRobot, k: int) -> None:
    """Let a hand drive to lot k and lift it; a machine whose output this empties goes on."""
    lot = model.lots[k]
    slot = obs.slots[lot.lies]
    hand.free = max(hand.free + way(plan, hand.x, hand.y, slot), lot.ready)
    hand.x, hand.y, hand.lot, hand.first = slot.x, slot.y, k + 1, 0
    lot.ready = NEVER
    if slot.kind == OUTPUT:
        bench = model.benches[slot.machine]
        bench.clear = hand.free
        if bench.queue > 0:
            begin_work(model, bench, bench.queue - 1, hand.free)
        elif bench.queue < 0:
            bench.free, bench.clear = hand.free + 1.0, hand.free + PROCESS + CLEARED
        bench.queue = 0


@kernel
def begin_work(model: Model, bench: Bench, k: int, at: float) -> None:
    """Let a machine begin work on lot k, not before `at`."""
    model.lots[k].ready = work(model, bench, max(at, bench.idle))
    bench.clear = NEVER


@kernel
def set_down(obs: FactoryObservation, plan: Plan, model: Model, hand: TeamRobot) -> bool:
    """Let a hand put down its lot, in the announced slot if it can; False if there is no place."""
    k, wish = hand.lot - 1, hand.into - 1
    lot = model.lots[k]
    hand.into = 0
    if lot.state == DONE:
        slot = obs.slots[wish if wish >= 0 and obs.slots[wish].kind == EXIT else plan.exit]
        hand.free += way(plan, hand.x, hand.y, slot)
        lot.state, lot.ready = DONE + 1, hand.free
    else:
        m = obs.slots[wish].machine if wish >= 0 and obs.slots[wish].kind == INPUT else -1
        if m < 0 or model.benches[m].makes != lot.state or model.benches[m].free >= NEVER:
            m = best_machine(obs, plan, model, lot.state, hand.x, hand.y, hand.free)
        if m < 0:
            return False
        slot, bench = obs.slots[MACHINE_SLOTS + 2 * m], model.benches[m]
        hand.free = max(hand.free + way(plan, hand.x, hand.y, slot), bench.free)
        lot.state, lot.lies, lot.ready = lot.state + 1, MACHINE_SLOTS + 2 * m + 1, NEVER
        if bench.clear >= NEVER:
            bench.queue, bench.free = k + 1, NEVER
        else:
            begin_work(model, bench, k, max(hand.free, bench.clear))
    hand.x, hand.y, hand.lot = slot.x, slot.y, 0
    return True


@kernel
def promised(model: Model, k: int, i: int) -> bool:
    """True if another hand than i has announced lot k."""
    found = False
    for j in range(model.hand_count):
        if j != i and model.hands[j].first == k + 1:
            found = True
    return found


@kernel
def next_lot(obs: FactoryObservation, plan: Plan, i: int) -> int:
    """The lot with the lowest score for hand i; -1 if there is none."""
    model = plan.then
    hand = model.hands[i]
    best, least = -1, NEVER
    for k in range(model.lot_count):
        lot = model.lots[k]
        if lot.ready >= NEVER or lot.state > DONE or promised(model, k, i):
            continue
        slot = obs.slots[lot.lies]
        at = max(hand.free + way(plan, hand.x, hand.y, slot), lot.ready)
        score = at - plan.shift[lot.state]
        if lot.state == DONE:
            score += plan.carry * way(plan, slot.x, slot.y, obs.slots[plan.exit])
        else:
            m = best_machine(obs, plan, model, lot.state, slot.x, slot.y, at)
            if m < 0:
                continue
            there = at + way(plan, slot.x, slot.y, obs.slots[MACHINE_SLOTS + 2 * m])
            score += plan.carry * (max(there, model.benches[m].free) - at)
        if lot.rush > RUSH_TIMES[lot.state] + at:
            score -= plan.hurry
        if slot.kind == OUTPUT and model.benches[slot.machine].queue:
            score -= plan.unblock
        if score < least:
            best, least = k, score
    return best


@kernel
def cheapest_schedule(obs: FactoryObservation, plan: Plan) -> float:
    """The lowest cost of the schedules by all dispatch rules that are compared, from the present on."""
    least = NEVER
    for rule in range(plan.rules):
        plan.shift[0], plan.shift[1], plan.shift[2] = plan.raw, plan.half, plan.done
        if rule:
            size = SHIFT if rule < 7 else FAR_SHIFT
            plan.shift[(rule - 1) // 2 % 3] += size if rule % 2 else -size
        copy_model(plan.then, plan.now)
        play_out(obs, plan)
        least = min(least, cost_of_schedule(plan))
    return least


@kernel
def play_out(obs: FactoryObservation, plan: Plan) -> None:
    """Play the schedule out, until all lots are delivered or all hands have nothing more to do."""
    model = plan.then
    for _ in range(3 * model.lot_count + 4):
        i = 0
        for j in range(1, model.hand_count):
            if model.hands[j].free < model.hands[i].free:
                i = j
        hand = model.hands[i]
        if hand.free >= NEVER:
            return
        if not hand.lot:
            k = hand.first - 1
            if k < 0:
                k = next_lot(obs, plan, i)
            if k < 0:
                hand.free = next_free(model, hand.free)
                continue
            lift(obs, plan, model, hand, k)
        if not set_down(obs, plan, model, hand):
            hand.free += 2.0


@kernel
def next_free(model: Model, at: float) -> float:
    """Time at which a hand without a transport looks again, when another one is free; NEVER if none is."""
    soonest = NEVER
    for j in range(model.hand_count):
        free = model.hands[j].free
        if at < free < soonest:
            soonest = free
    return soonest + 0.01


@kernel
def cost_of_schedule(plan: Plan) -> float:
    """Mean time of delivery of the lots, rush orders counting double, and `plan.last` times the latest, s."""
    model = plan.then
    total, latest, soonest, end = 0.0, 0.0, NEVER, 0.0
    for j in range(model.hand_count):
        free = model.hands[j].free
        soonest = min(soonest, free)
        if free < NEVER:
            end = max(end, free)
    if soonest < NEVER:
        end = soonest
    for k in range(model.lot_count):
        lot = model.lots[k]
        at = lot.ready
        if lot.state <= DONE:
            at = end if at >= NEVER else max(end, at)
            for state in range(lot.state, DONE + 1):
                at += STAGES[state]
        total += at
        if at < lot.rush:
            total += at - plan.rush
        latest = max(latest, at)
    return total / max(1, model.lot_count) + plan.last * latest
