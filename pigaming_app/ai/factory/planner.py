"""The planner of Robot Factory: whole schedules for both mates, and driving without stops.

Twice a second, and whenever a job ends, it plays out the rest of the work for each job that it could begin now, and
takes the one whose schedule delivers soonest. It keeps to what its mates have announced, and lets a person, who
announces nothing, take what is nearest to them. It goes to a machine before the product is done, and arrives in time.
"""

from typing import Any

from pigaming_app.ai.brain.kind import NoWeights
from pigaming_app.ai.factory.driving import STAND_OFF, draw_back, make_way
from pigaming_app.ai.factory.job_choice import PlannerMind, plan_job
from pigaming_app.ai.factory.maneuvers import cruise, reach
from pigaming_app.ai.factory.mind import PERIOD, PLAN, back_out, detect_stuck, keep_patience, perhaps_slip
from pigaming_app.ai.factory.navigation import find_way
from pigaming_app.games.factory.observation import FactoryObservation, observe
from pigaming_app.games.factory.state import Factory
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.rng import seeded, uniform
from pigaming_app.sim.world import DT, HZ, Action

WARM = 60 * HZ  # ticks from the beginning after which it is warm
CLOSE = 120.0  # px from a slot that is not ready, within which waiting is not being stuck


@kernel
def think(match: Factory, seat: int, mind: PlannerMind, weights: NoWeights) -> None:
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
def choose_job(obs: FactoryObservation, mind: PlannerMind, elapsed: int) -> None:
    """Plan when a job has ended, and every PLAN ticks."""
    if obs.carries != mind.carried:
        mind.carried, mind.plan_in, mind.waiting = obs.carries, 0, 0
        mind.resting = int(2.0 * HZ * mind.hesitation * uniform(mind))
        perhaps_slip(obs, mind)
    mind.plan_in -= elapsed
    mind.avoid_ticks -= elapsed
    mind.resting -= elapsed
    mind.wait -= elapsed * DT
    if mind.plan_in <= 0:
        mind.plan_in = PLAN
        plan_job(obs, mind)


@kernel
def act(obs: FactoryObservation, mind: PlannerMind, action: Action) -> None:
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
            keep_patience(obs, mind, mind.ways.to_go)
            detect_stuck(obs, mind, action)
        else:
            mind.stuck_ticks = 0


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
