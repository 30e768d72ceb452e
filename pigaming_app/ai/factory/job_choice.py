"""Choice of the next job by schedules: for each one that is possible now, the cheapest schedule that begins with it."""

from pigaming_app.ai.factory.driving import STAND_OFF
from pigaming_app.ai.factory.floor_model import NEVER
from pigaming_app.ai.factory.mind import AVOID_TICKS, Mind
from pigaming_app.ai.factory.navigation import Ways
from pigaming_app.ai.factory.schedule import Plan, cheapest_schedule, look, promised
from pigaming_app.ai.factory.task_allocation import cheapest_place, distance_to, waiting_place
from pigaming_app.games.factory.observation import OTHERS, FactoryObservation
from pigaming_app.games.factory.state import DAMAGED, DONE, ENTRY, EXIT, MACHINE_SLOTS, MACHINES
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import uniform

BLUNDER = 4.0  # s, largest error of a cost at `mind.noise` 1
AWAY = 15.0  # s, cost of a slot that could not be reached
KEEP, KEEP_LADEN = 0.17, 1.1  # s, bonus of the present target, without and with a pallet
ROOM, CROWDED = 250.0, 800.0  # px from a mate within which it does not park, and the cost of doing so
PATIENT = 16  # plans, eight seconds, for which it waits with a pallet before it brings it back to the shelf


@record
class PlannerMind(Mind):
    """Memory of the planner."""

    plan: Plan
    ways: Ways
    best_speed: float  # share of full speed once it is warm
    warm_up: float  # share of its speed that it lacks at the beginning of a match
    hesitation: float  # s of pause after each job, on average
    wait: float  # s until the fork can be used at the target
    pressed: int  # 1: fire was pressed at the last decision


@kernel
def plan_job(obs: FactoryObservation, mind: PlannerMind) -> None:
    """Set `mind.target`, `mind.wait` and `mind.near`."""
    mind.near, mind.wait = 0, 0.0
    best = -1
    if obs.carries - 1 != DAMAGED:
        look(obs, mind.plan)
        keep_exit(obs, mind)
        best = best_place(obs, mind) if obs.carries else best_lot(obs, mind)
    if best >= 0 and obs.carries and not obs.slots[best].put and obs.goal_distance < STAND_OFF:
        mind.waiting += 1
    if mind.waiting > PATIENT and best >= 0:
        mind.avoided, mind.avoid_ticks = best, AVOID_TICKS
        best = -1
    if best < 0 and obs.carries:
        best = cheapest_place(obs, mind)
    if best >= 0:
        mind.target = best
        return
    mind.waiting += 1
    mind.near, mind.target = 1, waiting_place(obs, mind) if obs.carries else parking_place(obs)


@kernel
def keep_exit(obs: FactoryObservation, mind: PlannerMind) -> None:
    """Stay with the slot of the exit that it drives to, as long as it can be reached and used.

    The nearest one may change with every turn round an obstacle, and with it the way round.
    """
    if mind.target < 0 or (mind.avoid_ticks > 0 and mind.avoided == mind.target):
        return
    slot = obs.slots[mind.target]
    if slot.kind == EXIT and slot.put:
        mind.plan.exit = mind.target


@kernel
def parking_place(obs: FactoryObservation) -> int:
    """Slot to wait at when there is nothing to do: of the own entry, the nearest that is not near a mate."""
    best, least = 0, NEVER
    for s in range(MACHINE_SLOTS):
        slot = obs.slots[s]
        if slot.kind != ENTRY or slot.mine != 1:
            continue
        cost = distance_to(obs, s)
        for i in range(OTHERS):
            other = obs.others[i]
            dx, dy = other.x - slot.x, other.y - slot.y
            if other.present and other.mate and dx * dx + dy * dy < ROOM * ROOM:
                cost += CROWDED
        if cost < least:
            best, least = s, cost
    return best


@kernel
def cost_of_job(obs: FactoryObservation, mind: PlannerMind, s: int) -> float:
    """Cost of the cheapest schedule from `mind.plan.now` on, which begins at slot s, s."""
    cost = cheapest_schedule(obs, mind.plan)
    if mind.target == s:
        cost -= KEEP_LADEN if obs.carries else KEEP
    if mind.avoid_ticks > 0 and mind.avoided == s:
        cost += AWAY
    if mind.noise > 0.0:
        cost += mind.noise * BLUNDER * uniform(mind)
    return cost


@kernel
def best_lot(obs: FactoryObservation, mind: PlannerMind) -> int:
    """Slot of the pallet to lift next; -1 if there is none."""
    model = mind.plan.now
    best, least = -1, NEVER
    for k in range(model.lot_count):
        lot = model.lots[k]
        if lot.ready >= NEVER or promised(model, k, 0):
            continue
        model.hands[0].first = k + 1
        cost = cost_of_job(obs, mind, lot.lies)
        if cost < least:
            best, least = k, cost
    if best < 0:
        return -1
    mind.wait = model.lots[best].ready
    return int(model.lots[best].lies)


@kernel
def best_place(obs: FactoryObservation, mind: PlannerMind) -> int:
    """Slot for the carried pallet; -1 if there is none."""
    model, state = mind.plan.now, obs.carries - 1
    if state == DONE:
        return int(mind.plan.exit) if obs.slots[mind.plan.exit].put else -1
    best, least = -1, NEVER
    for m in range(MACHINES):
        bench = model.benches[m]
        if bench.makes == state and bench.free < NEVER:
            model.hands[0].into = MACHINE_SLOTS + 2 * m + 1
            cost = cost_of_job(obs, mind, MACHINE_SLOTS + 2 * m)
            if cost < least:
                best, least = m, cost
    if best < 0:
        return -1
    mind.wait = model.benches[best].free
    return MACHINE_SLOTS + 2 * best
