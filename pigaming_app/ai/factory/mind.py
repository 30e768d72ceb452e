"""What both brains of Robot Factory share: memory, and the rules on it for slips, giving up and backing out."""

from pigaming_app.ai.brain.unstick import choose_escape, ticks_stuck
from pigaming_app.games.factory.observation import FactoryObservation, FactorySenses
from pigaming_app.games.factory.state import WORKERS
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import uniform
from pigaming_app.sim.world import HZ, Action

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
PLAN = 25  # ticks between two choices of a job
SLIP = 4 * HZ  # ticks for which it drives the wrong way before it notices
STOP = 96.0  # px; it never backs out towards a person nearer than this
STUCK_DISTANCE = 16.0  # px; a smaller displacement within STUCK_TICKS counts as stuck
STUCK_TICKS = 45
FREEING = 25  # ticks of backing out
NEARER = 10.0  # px that count as progress towards a slot
PATIENCE, AVOID_TICKS = 8 * HZ, 12 * HZ  # ticks without progress before a slot is avoided, and ticks of avoiding it
DETOUR = 4 * HZ  # ticks of a detour towards another slot
FAR = 1e9  # px; longer than every way


@record
class Mind:
    """Memory of a brain."""

    senses: FactorySenses
    obs: FactoryObservation
    random: int
    speed: float  # share of full speed, at present
    noise: float  # error of the cost of jobs, as a share of the largest
    dash: int  # 1: may use turbo
    slip: float  # share of jobs to which it first sets out the wrong way
    target: int  # slot number, -1: none
    near: int  # 1: wait near the target, which is occupied
    plan_in: int  # ticks until the next choice of a job
    resting: int  # ticks left of the pause after a job
    carried: int  # load at the last decision, as in `obs.carries`
    waiting: int  # choices in a row without a job
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
def perhaps_slip(obs: FactoryObservation, mind: Mind) -> None:
    """After a job: set out the wrong way, with the probability `mind.slip`."""
    if mind.slip > 0.0 and uniform(mind) < mind.slip:
        start_detour(obs, mind, SLIP)


@kernel
def start_detour(obs: FactoryObservation, mind: Mind, ticks: int) -> None:
    """Drive towards a slot at random for some ticks."""
    mind.detour, mind.via = ticks, int(uniform(mind) * obs.slot_count)


@kernel
def keep_patience(obs: FactoryObservation, mind: Mind, left: float) -> None:
    """Avoid the target for AVOID_TICKS ticks after PATIENCE ticks without progress; `left`: remaining way, px.

    If that target fails again while it is avoided, for want of another, make a detour to approach from elsewhere.
    """
    if mind.near or mind.progress_target != mind.target:
        mind.progress_target, mind.closest, mind.progress_ticks = mind.target, FAR, 0
    if left < mind.closest - NEARER:
        mind.closest, mind.progress_ticks = left, 0
    else:
        mind.progress_ticks += PERIOD
    if mind.progress_ticks <= PATIENCE:
        return
    if mind.avoid_ticks > 0 and mind.avoided == mind.target:
        start_detour(obs, mind, DETOUR)
    mind.avoided, mind.avoid_ticks = mind.target, AVOID_TICKS
    mind.closest, mind.progress_ticks, mind.plan_in = FAR, 0, 0


@kernel
def detect_stuck(obs: FactoryObservation, mind: Mind, action: Action) -> None:
    """Start backing out if it has been stuck for STUCK_TICKS."""
    if ticks_stuck(mind, obs.x, obs.y, False, STUCK_DISTANCE, PERIOD) > STUCK_TICKS:
        mind.stuck_ticks, mind.freeing = 0, FREEING
        choose_escape(mind, -0.8, 0.7)


@kernel
def back_out(obs: FactoryObservation, mind: Mind, action: Action) -> None:
    """Back out with a turn, away from any person within STOP px."""
    mind.freeing -= PERIOD
    for w in range(WORKERS):
        person = obs.people[w]
        if person.distance < STOP:
            ahead = abs(person.bearing) < 1.57
            mind.escape = -0.8 if ahead else 0.8
    set_action(action, mind.escape, mind.escape_turn, 0, 0)
