"""The hand-written driver of Robot Factory: what to carry where, shared out between mates, and how to get there.

Twice a second it lists what its team could do next, reckons what each job costs itself and its mate, and takes its part
of the cheapest way to share two of them out. Its mate, if it is one of these, reckons alike; a person's next job is
guessed from where they are, and left to them. To put down, a slot that a mate makes for is taken;
to lift, it is so while the mate carries something: of two free mates with one job left both go, and one gets it. The
three strengths differ in speed, in how long they think after each job, and in how well they reckon, never in rules.
"""

from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.factory.driving import back_out, detect_stuck, drive_to, lose_patience, make_detour
from pigaming_app.ai.factory.task_allocation import choose_job
from pigaming_app.games.factory.observation import Observation, Senses, observe
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import seeded, uniform
from pigaming_app.sim.world import HZ

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
PLAN = 25  # ticks between two looks at what there is to do
START = 20  # ticks within which it wakes up


@record
class ForemanMind:
    """What the driver remembers."""

    senses: Senses
    obs: Observation
    random: int
    speed: float  # share of full speed
    pause: int  # ticks for which it thinks after each job
    noise: float  # by which it misreckons what a job costs, as a share
    dash: int  # 1: it uses turbo
    target: int  # the slot it makes for, -1: none
    near: int  # 1: it only waits near the target, which is not free
    plan_in: int  # ticks until it looks again
    resting: int  # ticks left of thinking
    carried: int  # what it carried at the last decision
    waiting: int  # ticks for which it has had nothing better to do than wait
    anchor_x: float  # where it was when it last got anywhere
    anchor_y: float
    held_up: int  # ticks since
    sought: int  # the target for which the next two count
    least: float  # px, the shortest way there that was left
    late: int  # ticks since that was reached
    shunned: int  # a slot that it could not get at
    shun: int  # ticks for which it prefers others
    via: int  # the slot towards which it makes a detour
    detour: int  # ticks left of that
    freeing: int  # ticks left of breaking free
    escape: float  # the stick while it does
    escape_turn: float


@kernel
def think(match: Any, seat: int, mind: Any, weights: Any) -> None:
    """Look and decide every PERIOD ticks; in between the stick stays as it is."""
    if (match.tick + seat) % PERIOD:
        return
    action = match.actions[seat]
    observe(match, seat, mind.senses, mind.obs)
    act(mind.obs, mind, action)
    action.aim = mind.target + 1


@kernel
def act(obs: Any, mind: Any, action: Any) -> None:
    """Choose a job now and then, and go about it."""
    if obs.carries != mind.carried:  # a job is done
        mind.carried, mind.plan_in, mind.resting = obs.carries, 0, mind.pause
    mind.plan_in -= PERIOD
    mind.shun -= PERIOD
    if mind.plan_in <= 0:
        mind.plan_in = PLAN
        choose_job(obs, mind)
    mind.resting -= PERIOD
    if obs.frozen or mind.resting > 0:
        mind.held_up = 0
        set_action(action, 0.0, 0.0, 0, 0)
        return
    if mind.freeing > 0:
        back_out(obs, mind, action)
        return
    if mind.detour > 0:
        make_detour(obs, mind, action)
    else:
        drive_to(obs, mind, action)
        lose_patience(obs, mind)
    detect_stuck(obs, mind, action)


def make_reset(speed: float, pause: float, noise: float, delay: float, dash: int) -> Any:
    """A function that fills a fresh mind: share of full speed, s of thinking, misreckoning, s of late eyes, turbo."""

    def fill(mind: ForemanMind, seed: int) -> None:
        mind.random, mind.target = seeded(seed), -1
        mind.resting = int(uniform(mind) * START)  # nobody begins on the same tick
        mind.speed, mind.pause, mind.noise, mind.dash = speed, round(pause * HZ), noise, dash
        mind.senses.delay = delay

    return fill


EASY = BrainKind("easy", ForemanMind, think, make_reset(speed=0.6, pause=1.2, noise=0.5, delay=0.4, dash=0))
NORMAL = BrainKind("normal", ForemanMind, think, make_reset(speed=0.85, pause=0.4, noise=0.15, delay=0.2, dash=0))
HARD = BrainKind("hard", ForemanMind, think, make_reset(speed=1.0, pause=0.0, noise=0.03, delay=0.1, dash=1))
