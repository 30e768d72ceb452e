"""Baselines for measuring other brains: one idle, one uniformly random."""

from pigaming_app.ai.brain.kind import BrainKind, NoWeights
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


IDLE = BrainKind("idle", SimpleMind, stand_still, reset)
RANDOM = BrainKind("random", SimpleMind, act_randomly, reset)
