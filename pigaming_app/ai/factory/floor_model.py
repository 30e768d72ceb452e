"""A small model of the floor for the planner: pallets, machines, workers and robots with the times when they are free.

All times are in seconds from now, positions in px.
"""

from math import sqrt
from typing import Annotated

from pigaming_app.games.factory.observation import OTHERS, FactoryObservation
from pigaming_app.games.factory.state import DAMAGED, DONE, EXIT, HALF, MACHINE_SLOTS, MACHINES, RAW, WORKERS, A
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.world import DT, HEIGHT, ROBOTS, WIDTH

LOTS = 12  # pallets in the model, at most
NEVER = 1e6  # s
PROCESS, FAST_PROCESS = 6.0, 2.0  # s of work, and on the fast machine, which needs no worker
CLEARED = 5.0  # s after which others are expected to have taken their pallet
WALK = 130.0  # px/s, of workers
SPOT = 62.0  # px from a machine's centre at which a worker is as good as there
BESIDE = 130.0  # px between a machine's centre and its worker, at most
REST = 80.0  # px from the middle of the floor at which workers rest
MIDDLE_X, MIDDLE_Y = 0.5 * WIDTH, 0.5 * HEIGHT


@record
class Lot:
    """A pallet that the team may lift."""

    state: int
    lies: int  # slot in which it lies, or will; -1: it is on a robot
    ready: float  # time when it can be lifted, or was delivered; NEVER: not before something else happens
    rush: float  # s left to its deadline, 0: none


@record
class Bench:
    """A machine."""

    makes: int
    fast: int
    x: float  # centre
    y: float
    free: float  # time when its input is free
    clear: float  # time when its output is; NEVER: a pallet of the team is to be lifted there
    idle: float  # time when it has no pallet in process
    queue: int  # 1 + the lot in its input that waits for the output, -1: another team's; 0: none


@record
class TeamRobot:
    """A robot of the team, the own one first."""

    x: float
    y: float
    free: float  # time when it can begin its next transport
    lot: int  # 1 + the lot that it carries; 0: none
    first: int  # 1 + the lot that it has announced; 0: none
    into: int  # 1 + the slot that it has announced for the lot that it carries; 0: none


@record
class Helper:
    """A worker, who walks home from (x, y) from `free` on."""

    x: float
    y: float
    free: float


@record
class Model:
    """The floor."""

    lots: Annotated[list[Lot], LOTS]
    benches: Annotated[list[Bench], MACHINES]
    hands: Annotated[list[TeamRobot], ROBOTS]
    helpers: Annotated[list[Helper], WORKERS]
    lot_count: int
    hand_count: int


@kernel
def survey(obs: FactoryObservation, model: Model) -> None:
    """Fill in the model from the observation."""
    model.lot_count = 0
    survey_helpers(obs, model)
    for m in range(MACHINES):
        survey_machine(obs, model, m)
    for s in range(obs.slot_count):
        slot = obs.slots[s]
        if slot.machine < 0 and slot.lift and slot.holds - 1 <= DONE and slot.kind != EXIT:
            add_lot(model, slot.holds - 1, s, 0.0, slot.rush)
    survey_hands(obs, model)


@kernel
def add_lot(model: Model, state: int, lies: int, ready: float, rush: float) -> int:
    """Add a pallet if there is room for it; returns 1 + its number, 0 if there is none."""
    if model.lot_count == LOTS:
        return 0
    lot = model.lots[model.lot_count]
    lot.state, lot.lies, lot.ready, lot.rush = state, lies, ready, rush
    model.lot_count += 1
    return int(model.lot_count)


@kernel
def survey_helpers(obs: FactoryObservation, model: Model) -> None:
    """Fill in the workers: those at a machine are busy until it is done."""
    for w in range(WORKERS):
        person, helper = obs.people[w], model.helpers[w]
        helper.x, helper.y, helper.free = person.x, person.y, 0.0
        for m in range(MACHINES):
            into, out = obs.slots[MACHINE_SLOTS + 2 * m], obs.slots[MACHINE_SLOTS + 2 * m + 1]
            dx, dy = person.goal_x - 0.5 * (into.x + out.x), person.goal_y - 0.5 * (into.y + out.y)
            if into.wait > 0.0 and dx * dx + dy * dy < BESIDE * BESIDE:
                helper.free = into.wait


@kernel
def survey_machine(obs: FactoryObservation, model: Model, m: int) -> None:
    """Fill in machine m, and add the pallets that it holds."""
    bench, s = model.benches[m], MACHINE_SLOTS + 2 * m + 1
    into, out = obs.slots[s - 1], obs.slots[s]
    bench.makes, bench.fast = into.makes, into.fast
    bench.x, bench.y = 0.5 * (into.x + out.x), 0.5 * (into.y + out.y)
    bench.free, bench.clear, bench.idle, bench.queue = 0.0, 0.0, into.wait, 0
    if into.wait > 0.0:  # in process
        if into.ours and add_lot(model, HALF if into.makes == A else DONE, s, into.wait, 0.0):
            bench.clear = NEVER
        else:
            bench.clear = into.wait + CLEARED
    elif out.holds:
        if out.lift and out.holds - 1 != DAMAGED and add_lot(model, out.holds - 1, s, 0.0, out.rush):
            bench.clear = NEVER
        else:
            bench.clear = CLEARED
    if not into.holds:
        return
    if into.holds - 1 != (RAW if into.makes == A else HALF):
        bench.free = CLEARED
        return
    added = add_lot(model, into.holds, s, NEVER, into.rush) if into.lift else 0
    if bench.clear >= NEVER:
        bench.free, bench.queue = NEVER, added if added else -1
    else:
        done = work(model, bench, bench.clear)
        bench.clear = done + CLEARED
        if added:
            bench.clear, model.lots[added - 1].ready = NEVER, done


@kernel
def survey_hands(obs: FactoryObservation, model: Model) -> None:
    """Fill in the robots of the team, and add what they carry."""
    hand = model.hands[0]
    hand.x, hand.y, hand.free, hand.lot, hand.first, hand.into = obs.x, obs.y, obs.frozen * DT, 0, 0, 0
    if obs.carries:
        hand.lot = add_lot(model, obs.carries - 1, -1, NEVER, obs.rush)
    model.hand_count = 1
    for i in range(OTHERS):
        other = obs.others[i]
        if not other.present or not other.mate:
            continue
        hand = model.hands[model.hand_count]
        model.hand_count += 1
        hand.x, hand.y, hand.free, hand.lot, hand.first, hand.into = other.x, other.y, other.frozen * DT, 0, 0, 0
        if other.carries and other.carries - 1 != DAMAGED:
            hand.lot, hand.into = add_lot(model, other.carries - 1, -1, NEVER, 0.0), other.aim
        elif other.aim:
            for k in range(model.lot_count):
                if model.lots[k].lies == other.aim - 1 and model.lots[k].ready < NEVER:
                    hand.first = k + 1


@kernel
def work(model: Model, bench: Bench, at: float) -> float:
    """Let a machine begin work with the worker who is there first, not before `at`; returns the time of its end."""
    if bench.fast:
        bench.free, bench.idle = at, at + FAST_PROCESS
        return bench.idle
    best, soonest = 0, NEVER
    for w in range(WORKERS):
        helper = model.helpers[w]
        leave = max(at, helper.free)
        dx, dy = MIDDLE_X - helper.x, MIDDLE_Y - helper.y
        home = sqrt(dx * dx + dy * dy)
        share = min(WALK * (leave - helper.free), max(0.0, home - REST)) / (home + 1.0)
        dx, dy = helper.x + share * dx - bench.x, helper.y + share * dy - bench.y
        begin = leave + max(0.0, sqrt(dx * dx + dy * dy) - SPOT) / WALK
        if begin < soonest:
            best, soonest = w, begin
    helper = model.helpers[best]
    dx, dy = MIDDLE_X - bench.x, MIDDLE_Y - bench.y
    share = SPOT / (sqrt(dx * dx + dy * dy) + 1.0)
    bench.free, bench.idle = soonest, soonest + PROCESS
    helper.x, helper.y, helper.free = bench.x + share * dx, bench.y + share * dy, bench.idle
    return bench.idle


@kernel
def copy_model(to: Model, model: Model) -> None:
    """Copy a model."""
    to.lot_count, to.hand_count = model.lot_count, model.hand_count
    for k in range(model.lot_count):
        a, b = to.lots[k], model.lots[k]
        a.state, a.lies, a.ready, a.rush = b.state, b.lies, b.ready, b.rush
    for m in range(MACHINES):
        c, d = to.benches[m], model.benches[m]
        c.makes, c.fast, c.x, c.y = d.makes, d.fast, d.x, d.y
        c.free, c.clear, c.idle, c.queue = d.free, d.clear, d.idle, d.queue
    for i in range(model.hand_count):
        e, f = to.hands[i], model.hands[i]
        e.x, e.y, e.free, e.lot, e.first, e.into = f.x, f.y, f.free, f.lot, f.first, f.into
    for w in range(WORKERS):
        g, h = to.helpers[w], model.helpers[w]
        g.x, g.y, g.free = h.x, h.y, h.free
