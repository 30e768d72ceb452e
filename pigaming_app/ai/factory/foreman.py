"""The hand-written brain of Robot Factory: greedy joint task allocation for two mates, and route following.

Twice a second it lists the open jobs of its team, estimates the cost of each for itself and for its mate, and takes its
own part of the cheapest pair. A mate with the same brain computes the same allocation; the job of a human mate is
predicted from position and left to them. For putting down, a slot that a mate has targeted counts as taken. For
lifting, it counts as taken only while the mate carries a pallet: if one job is left for two free mates, both go and the
first gets it. The three strengths differ in numbers, never in rules: the weakest drives slowly, hesitates after a job,
often sets out the wrong way, misjudges costs and does not consider its mate.

In party it prefers rush orders and the fast machine, and takes whatever pallet anybody may take.
"""

from typing import Any

from pigaming_app.ai.brain.kind import BrainKind, NoWeights, Traits
from pigaming_app.ai.factory.driving import draw_back, drive_to, make_detour, update_patience
from pigaming_app.ai.factory.mind import PERIOD, PLAN, back_out, detect_stuck, perhaps_slip
from pigaming_app.ai.factory.task_allocation import ForemanMind, choose_job
from pigaming_app.games.factory.observation import FactoryObservation, observe
from pigaming_app.games.factory.state import Factory
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.rng import seeded, uniform
from pigaming_app.sim.world import HZ, Action

START = 150  # upper limit of the random delay before the first job, ticks; with 20, Ice won 70 % in yard


@kernel
def think(match: Factory, seat: int, mind: ForemanMind, weights: NoWeights) -> None:
    """Observe and decide every PERIOD ticks; the action holds in between."""
    if (match.tick + seat) % PERIOD:
        return
    action = match.actions[seat]
    observe(match, seat, mind.senses, mind.obs)
    act(mind.obs, mind, action)
    action.aim = mind.target + 1


@kernel
def act(obs: FactoryObservation, mind: ForemanMind, action: Action) -> None:
    """Allocate a job when due, then work on it."""
    if obs.carries != mind.carried:  # a job has just ended
        mind.carried, mind.plan_in, mind.resting = obs.carries, 0, mind.pause
        perhaps_slip(obs, mind)
    mind.plan_in -= PERIOD
    mind.avoid_ticks -= PERIOD
    if mind.plan_in <= 0:
        mind.plan_in = PLAN
        choose_job(obs, mind)
    mind.resting -= PERIOD
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
        make_detour(obs, mind, action)
    else:
        drive_to(obs, mind, action)
        update_patience(obs, mind)
    detect_stuck(obs, mind, action)


def make_reset(speed: float, pause: float, noise: float, delay: float, dash: int, slip: float, joint: int) -> Any:
    """A `reset` for a strength.

    `speed`: share of full speed; `pause`: s after each job; `noise`: error of cost estimates, as a share of NOISE;
    `delay`: reaction time to others, s; `dash`: 1 if it may use turbo; `slip`: share of jobs that begin the wrong way;
    `joint`: 1 if it considers its mate's job.
    """

    def fill(mind: ForemanMind, seed: int) -> None:
        mind.random, mind.target = seeded(seed), -1
        mind.resting = int(uniform(mind) * START)  # staggered starts
        mind.speed, mind.pause, mind.noise, mind.dash = speed, round(pause * HZ), noise, dash
        mind.slip, mind.joint, mind.senses.delay = slip, joint, delay

    return fill


def person(traits: Traits) -> BrainKind:
    """What a person sees and wants: who knows the game thinks less after a job and considers its mate."""
    novice = 1.0 - traits.tactics
    reset = make_reset(
        speed=1.0,
        pause=2.0 * novice,
        noise=0.5 * novice,
        delay=traits.reaction,
        dash=int(traits.turbo),
        slip=0.3 * novice,
        joint=int(traits.tactics > 0.5),
    )
    return BrainKind("person", ForemanMind, think, reset)


HAND1 = BrainKind(
    "hand1", ForemanMind, think, make_reset(speed=0.5, pause=3.2, noise=0.8, delay=0.4, dash=0, slip=0.6, joint=0)
)
HAND2 = BrainKind(
    "hand2", ForemanMind, think, make_reset(speed=0.85, pause=0.4, noise=0.15, delay=0.2, dash=0, slip=0.0, joint=1)
)
HAND3 = BrainKind(
    "hand3", ForemanMind, think, make_reset(speed=1.0, pause=0.0, noise=0.03, delay=0.1, dash=1, slip=0.0, joint=1)
)
