"""Baselines for measuring other brains: one idle, one uniformly random."""

from pigaming_app.ai.brain.kind import BrainKind, NoWeights
from pigaming_app.ai.brain.thoughts import Thoughts
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import seeded, uniform

HOLD = 10  # ticks for which a random action is held


@record
class SimpleMind:
    """State of a private random generator, so that the match's generator is not advanced."""

    random: int


def reset(mind: SimpleMind, seed: int) -> None:
    mind.random = seeded(seed)


@kernel
def stand_still(match: MatchState, seat: int, mind: SimpleMind, weights: NoWeights) -> None:
    """Release stick and buttons."""
    set_action(match.actions[seat], 0.0, 0.0, 0, 0)


@kernel
def act_randomly(match: MatchState, seat: int, mind: SimpleMind, weights: NoWeights) -> None:
    """Draw one of the 3 x 3 x 2 x 2 actions every HOLD ticks (five times a second)."""
    if match.tick % HOLD == 0:
        linear = float(int(uniform(mind) * 3.0)) - 1.0
        angular = float(int(uniform(mind) * 3.0)) - 1.0
        fire = int(uniform(mind) * 2.0)
        set_action(match.actions[seat], linear, angular, fire, int(uniform(mind) * 2.0))


def explain_idle(match: MatchState, seat: int, mind: SimpleMind, weights: NoWeights) -> Thoughts:
    return Thoughts("idle", "always")


def explain_random(match: MatchState, seat: int, mind: SimpleMind, weights: NoWeights) -> Thoughts:
    """All moves with equal value, and the one drawn last."""
    action = match.actions[seat]
    moves = {(ahead, turn, fire): 0.0 for ahead in (1, 0, -1) for turn in (-1, 0, 1) for fire in (0, 1)}
    chosen = int(action.linear), int(action.angular), int(action.fire)
    return Thoughts("random", "dice", names={"percent": 6}, moves=moves, chosen=chosen)


IDLE = BrainKind("idle", SimpleMind, stand_still, reset, explain=explain_idle)
RANDOM = BrainKind("random", SimpleMind, act_randomly, reset, explain=explain_random)
