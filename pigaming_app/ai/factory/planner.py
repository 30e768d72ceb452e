"""The planner of Robot Factory: schedules of transports for the whole team, and driving without stops."""

from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.factory.driving import AVOID_TICKS, DETOUR, NEARER, PATIENCE, back_out, detect_stuck, draw_back, make_way
from pigaming_app.ai.factory.maneuvers import cruise, reach
from pigaming_app.ai.factory.navigation import Ways, find_way
from pigaming_app.ai.factory.schedule import NEVER, Plan, choose_rule, play_out, promised, restart, survey
from pigaming_app.ai.factory.task_allocation import cheapest_place, may_take, waiting_place
from pigaming_app.games.factory.observation import Observation, Senses, observe
from pigaming_app.games.factory.state import DAMAGED, DONE, EXIT, INPUT, MACHINES
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import seeded, uniform
from pigaming_app.sim.world import HZ

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
PLAN = 25  # ticks between two plans
SLIP = 4 * HZ  # ticks for which it drives the wrong way before it notices
START = 25  # upper limit of the random delay before the first job, ticks
BLUNDER = 4.0  # s, error of a schedule's cost at `mind.noise` 1
AWAY = 15.0  # s, cost of a slot that could not be reached


@record
class PlannerMind:
    """Memory of the planner."""

    senses: Senses
    obs: Observation
    plan: Plan
    ways: Ways
    random: int
    speed: float  # share of full speed
    noise: float  # error of the cost of schedules, as a share of BLUNDER
    dash: int  # 1: may use turbo
    last: float  # weight of the last delivery, but in party
    hesitate: float  # s of pause after each job, on average
    slip: float  # share of jobs to which it first sets out the wrong way
    target: int  # slot number, -1: none
    side: int  # on which it passes obstacles: 1 right, -1 left
    sided: int  # ticks for which it keeps to that side
    wait: float  # s until the fork can be used there
    near: int  # 1: wait near the target, which is occupied
    plan_in: int  # ticks until the next plan
    resting: int  # ticks left of the pause
    carried: int  # load at the last decision, as in `obs.carries`
    pressed: int  # 1: fire was pressed at the last decision
    waiting: int  # plans in a row without a job
    anchor_x: float  # position at the last progress, px
    anchor_y: float
    stuck_ticks: int  # ticks since then
    progress_target: int  # target to which `closest` and `progress_ticks` refer
    closest: float  # shortest remaining route so far, px
    progress_ticks: int  # ticks since then
    avoided: int  # slot that could not be reached
    avoid_ticks: int  # ticks left of avoiding it
    via: int  # slot that a detour leads towards
    detour: int  # ticks left of the detour
    freeing: int  # ticks left of backing out
    escape: float  # forward stick while backing out
    escape_turn: float


@kernel
def think(match: Any, seat: int, mind: Any, weights: Any) -> None:
    """Observe and decide every PERIOD ticks, and on the tick after a press; the action holds in between."""
    if (match.tick + seat) % PERIOD and not mind.pressed:
        return
    elapsed = 0 if (match.tick + seat) % PERIOD else PERIOD
    mind.pressed = 0
    action = match.actions[seat]
    observe(match, seat, mind.senses, mind.obs)
    mind.plan.last = 0.0 if match.rules.party else mind.last
    choose(mind.obs, mind, elapsed)
    slot = mind.obs.slots[mind.via if mind.detour > 0 else mind.target]
    find_way(match, match.robots[seat], mind.obs, mind.ways, slot.x, slot.y)
    act(mind.obs, mind, action)
    action.aim = mind.target + 1


@kernel
def choose(obs: Any, mind: Any, elapsed: int) -> None:
    """Plan when due: when a job has ended, and every PLAN ticks."""
    if obs.carries != mind.carried:
        mind.carried, mind.plan_in = obs.carries, 0
        mind.resting = int(2.0 * HZ * mind.hesitate * uniform(mind))
        if mind.slip > 0.0 and uniform(mind) < mind.slip:
            mind.detour, mind.via = SLIP, int(uniform(mind) * obs.slot_count)
    mind.plan_in -= elapsed
    mind.avoid_ticks -= elapsed
    mind.resting -= elapsed
    mind.wait -= elapsed * 0.02
    if mind.plan_in <= 0 or mind.target < 0:
        mind.plan_in = PLAN
        choose_job(obs, mind)


@kernel
def choose_job(obs: Any, mind: Any) -> None:
    """Set `mind.target`, and `mind.near` if it is only a place to wait at."""
    mind.near, mind.wait = 0, 0.0
    if obs.carries - 1 == DAMAGED:
        best = cheapest_place(obs, mind)
    else:
        survey(obs, mind.plan)
        best = best_place(obs, mind) if obs.carries else best_lot(obs, mind)
    if best >= 0:
        mind.target = best
        mind.waiting = 0
        return
    mind.waiting += 1
    if obs.carries:
        best = cheapest_place(obs, mind)
        if best >= 0:
            mind.target = best
            if may_take(obs.slots[best], obs.carries - 1):
                mind.waiting = 0
            return
    mind.near = 1
    mind.target = waiting_place(obs, mind)


@kernel
def adjusted(mind: Any, s: int, cost: float) -> float:
    """The cost of a schedule that begins at slot s, with hysteresis, error of judgement and avoidance."""
    if mind.target == s:
        cost -= mind.plan.keep_laden if mind.obs.carries else mind.plan.keep
    if mind.avoid_ticks > 0 and mind.avoided == s:
        cost += AWAY
    if mind.noise > 0.0:
        cost += mind.noise * BLUNDER * uniform(mind)
    return cost


@kernel
def try_rules(obs: Any, plan: Any) -> float:
    """The lowest cost of the schedules of all dispatch rules, s."""
    least = NEVER
    for rule in range(plan.rules):
        restart(plan)
        choose_rule(plan, rule)
        least = min(least, play_out(obs, plan))
    return least


@kernel
def best_lot(obs: Any, mind: Any) -> int:
    """Slot of the pallet to lift next; -1 if there is none."""
    plan = mind.plan
    best, least = -1, NEVER
    for k in range(plan.lots):
        lot = plan.now.lots[k]
        if lot.ready >= NEVER or lot.lies < 0:
            continue
        restart(plan)
        if promised(plan, k, 0):
            continue
        plan.now.hands[0].first = k + 1
        cost = adjusted(mind, lot.lies, try_rules(obs, plan))
        plan.now.hands[0].first = 0
        if cost < least:
            best, least = k, cost
    if best < 0:
        return -1
    mind.wait = plan.now.lots[best].ready
    return int(plan.now.lots[best].lies)


@kernel
def best_place(obs: Any, mind: Any) -> int:
    """Slot for the carried pallet; -1 if there is none."""
    plan = mind.plan
    state = obs.carries - 1
    if state == DONE:
        return int(plan.exit) if obs.slots[plan.exit].put else -1
    best, least = -1, NEVER
    for m in range(MACHINES):
        bench = plan.now.benches[m]
        if bench.makes != state or bench.free >= NEVER:
            continue
        plan.now.hands[0].into = bench.into + 1
        cost = adjusted(mind, bench.into, try_rules(obs, plan))
        plan.now.hands[0].into = 0
        if cost < least:
            best, least = m, cost
    if best < 0:
        return -1
    bench = plan.now.benches[best]
    mind.wait = bench.free
    return int(bench.into)


@kernel
def act(obs: Any, mind: Any, action: Any) -> None:
    """Work on the job."""
    if obs.frozen or mind.resting > 0:
        mind.stuck_ticks = 0
        if obs.frozen:
            set_action(action, 0.0, 0.0, 0, 0)
        else:
            draw_back(obs, action)
        return
    if mind.freeing > 0:
        back_out(obs, mind, action)
        return
    if mind.detour > 0:
        mind.detour -= PERIOD
        if obs.goal_distance < 150.0:
            mind.detour = 0
        cruise(obs, mind, action, 0.0, 1)
        detect_stuck(obs, mind, action)
        return
    slot = obs.slots[mind.target]
    ready = slot.put if obs.carries else (1 if slot.lift else 0)
    if mind.near and obs.straight and obs.goal_distance < 150.0:
        make_way(obs, mind, action)
        return
    reach(obs, mind, action, mind.wait, ready)
    if ready or obs.goal_distance > 120.0:
        be_patient(obs, mind)
        detect_stuck(obs, mind, action)
    else:
        mind.stuck_ticks = 0


@kernel
def be_patient(obs: Any, mind: Any) -> None:
    """Avoid the target for AVOID_TICKS ticks after PATIENCE ticks without progress on the way.

    If that target fails again while it is avoided, for want of another, make a detour to approach from elsewhere.
    """
    if mind.near or mind.progress_target != mind.target:
        mind.progress_target, mind.closest, mind.progress_ticks = mind.target, 1e9, 0
    if mind.ways.to_go < mind.closest - NEARER:
        mind.closest, mind.progress_ticks = mind.ways.to_go, 0
    else:
        mind.progress_ticks += PERIOD
    if mind.progress_ticks <= PATIENCE:
        return
    if mind.avoid_ticks > 0 and mind.avoided == mind.target:
        mind.detour, mind.via = DETOUR, int(uniform(mind) * obs.slot_count)
    mind.avoided, mind.avoid_ticks = mind.target, AVOID_TICKS
    mind.closest, mind.progress_ticks, mind.plan_in = 1e9, 0, 0


def make_reset(
    speed: float = 1.0,
    hesitate: float = 0.0,
    noise: float = 0.0,
    delay: float = 0.1,
    dash: int = 1,
    slip: float = 0.0,
    rules: int = 3,
    form: float = 0.0,
    depth: int = 40,
    **tuned: float,
) -> Any:
    """A `reset` for a strength.

    `speed`: share of full speed; `hesitate`: s of pause after each job, on average; `noise`: error of the cost of
    schedules, as a share of BLUNDER; `delay`: reaction time to others, s; `dash`: 1 if it may use turbo; `slip`: share of
    jobs that begin the wrong way; `rules`: dispatch rules that it tries; `form`: by how much a match's speed may differ,
    as a share.
    """

    def fill(mind: PlannerMind, seed: int) -> None:
        mind.random, mind.target = seeded(seed), -1
        mind.resting = int(uniform(mind) * START)  # staggered starts
        today = 1.0 + form * (2.0 * uniform(mind) - 1.0)
        mind.speed, mind.hesitate, mind.noise, mind.dash = speed * today, hesitate / today, noise, dash
        mind.slip, mind.senses.delay = slip, delay
        plan = mind.plan
        plan.depth, plan.rules = depth, rules
        plan.stage_bonus[0] = tuned.get("b0", -0.97)
        plan.stage_bonus[1] = tuned.get("b1", -0.33)
        plan.stage_bonus[2] = tuned.get("b2", -1.74)
        plan.unblock = tuned.get("unblock", 3.8)
        plan.carry = tuned.get("carry", 0.54)
        mind.last = tuned.get("last", 0.36)
        plan.keep_laden = tuned.get("keep_laden", 1.1)
        plan.rush, plan.hurry = tuned.get("rush", 15.0), tuned.get("hurry", 3.0)
        plan.turn = tuned.get("turn", 0.26)
        plan.keep = tuned.get("keep", 0.17)

    return fill
