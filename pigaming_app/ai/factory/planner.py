"""The planner of Robot Factory: whole schedules for both mates, and driving without stops.

Twice a second, and whenever a job ends, it plays out the rest of the work for each job that it could begin now, and
takes the one whose schedule delivers soonest. It keeps to what its mates have announced, and lets a person, who
announces nothing, take what is nearest to them. It goes to a machine before the product is done, and arrives in time.
"""

from typing import Any

from pigaming_app.ai.factory.driving import (
    AVOID_TICKS,
    DETOUR,
    NEARER,
    PATIENCE,
    STAND_OFF,
    back_out,
    detect_stuck,
    draw_back,
    make_way,
)
from pigaming_app.ai.factory.job_choice import plan_job
from pigaming_app.ai.factory.maneuvers import cruise, reach
from pigaming_app.ai.factory.navigation import Ways, find_way
from pigaming_app.ai.factory.schedule import Plan
from pigaming_app.games.factory.observation import Observation, Senses, observe
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import seeded, uniform
from pigaming_app.sim.world import DT, HZ

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
PLAN = 25  # ticks between two plans
SLIP = 4 * HZ  # ticks for which it drives the wrong way before it notices
WARM = 60 * HZ  # ticks from the beginning after which it is warm
CLOSE = 120.0  # px from a slot that is not ready, within which waiting is not being stuck


@record
class PlannerMind:
    """Memory of the planner."""

    senses: Senses
    obs: Observation
    plan: Plan
    ways: Ways
    random: int
    speed: float  # share of full speed, at present
    best_speed: float  # the same once it is warm
    warm_up: float  # share of its speed that it lacks at the beginning of a match
    hesitation: float  # s of pause after each job, on average
    noise: float  # error of the cost of schedules, as a share of BLUNDER
    dash: int  # 1: may use turbo
    slip: float  # share of jobs to which it first sets out the wrong way
    target: int  # slot number, -1: none
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
    closest: float  # shortest remaining way so far, px
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
    elapsed = 0 if (match.tick + seat) % PERIOD else PERIOD
    if not elapsed and not mind.pressed:
        return
    mind.pressed = 0
    observe(match, seat, mind.senses, mind.obs)
    if match.rules.party:  # orders never end, so there is no last delivery
        mind.plan.last = 0.0
    cold = 1.0 - match.tick / WARM if match.tick < WARM else 0.0
    mind.speed = mind.best_speed * (1.0 - mind.warm_up * cold)
    choose_job(mind.obs, mind, elapsed)
    slot = mind.obs.slots[mind.via if mind.detour > 0 else mind.target]
    find_way(match, match.robots[seat], mind.obs, mind.ways, slot.x, slot.y)
    act(mind.obs, mind, match.actions[seat])
    match.actions[seat].aim = mind.target + 1


@kernel
def choose_job(obs: Any, mind: Any, elapsed: int) -> None:
    """Plan when a job has ended, and every PLAN ticks."""
    if obs.carries != mind.carried:
        mind.carried, mind.plan_in, mind.waiting = obs.carries, 0, 0
        mind.resting = int(2.0 * HZ * mind.hesitation * uniform(mind))
        if mind.slip > 0.0 and uniform(mind) < mind.slip:
            mind.detour, mind.via = SLIP, int(uniform(mind) * obs.slot_count)
    mind.plan_in -= elapsed
    mind.avoid_ticks -= elapsed
    mind.resting -= elapsed
    mind.wait -= elapsed * DT
    if mind.plan_in <= 0:
        mind.plan_in = PLAN
        plan_job(obs, mind)


@kernel
def act(obs: Any, mind: Any, action: Any) -> None:
    """Work on the job."""
    if obs.frozen:
        mind.stuck_ticks = 0
        set_action(action, 0.0, 0.0, 0, 0)
    elif mind.resting > 0:
        mind.stuck_ticks = 0
        draw_back(obs, action)
    elif mind.freeing > 0:
        back_out(obs, mind, action)
    elif mind.detour > 0:
        mind.detour = mind.detour - PERIOD if obs.goal_distance > STAND_OFF else 0
        cruise(obs, mind, action, 1)
        detect_stuck(obs, mind, action)
    elif mind.near and obs.straight and obs.goal_distance < STAND_OFF:
        make_way(obs, mind, action)
    else:
        slot = obs.slots[mind.target]
        ready = slot.put if obs.carries else slot.lift and slot.holds
        reach(obs, mind, action, 1 if ready else 0)
        if ready or obs.goal_distance > CLOSE:
            keep_patience(obs, mind)
            detect_stuck(obs, mind, action)
        else:
            mind.stuck_ticks = 0


@kernel
def keep_patience(obs: Any, mind: Any) -> None:
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
    hesitation: float = 0.0,
    noise: float = 0.0,
    delay: float = 0.1,
    dash: int = 1,
    slip: float = 0.0,
    rules: int = 3,
    form: float = 0.0,
    start: float = 0.5,
    warm_up: float = 0.0,
) -> Any:
    """A `reset` for a strength.

    `speed`: share of full speed; `hesitation`: s of pause after each job, on average; `noise`: error of the cost of
    schedules, as a share of BLUNDER; `delay`: reaction time to others, s; `dash`: 1 if it may use turbo; `slip`: share
    of jobs that begin the wrong way; `rules`: dispatch rules that it compares; `form`: by how much it may be faster or
    slower in a match than in others, as a share; `start`: upper limit of the random delay before the first job, s;
    `warm_up`: share of its speed that it lacks at the beginning, and gains in the first minute.
    """

    def fill(mind: PlannerMind, seed: int) -> None:
        mind.random, mind.target = seeded(seed), -1
        mind.resting = int(uniform(mind) * start * HZ)  # staggered starts
        today = 1.0 + form * (2.0 * uniform(mind) - 1.0)
        mind.best_speed, mind.hesitation, mind.warm_up = speed * today, hesitation / today, warm_up
        mind.noise, mind.dash, mind.slip = noise, dash, slip
        mind.senses.delay, mind.plan.rules = delay, rules

    return fill
