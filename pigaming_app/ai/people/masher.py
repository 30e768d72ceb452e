"""`masher`: keys at random, three to four presses a second, each held for a moment."""

from pigaming_app.ai.brain.kind import BrainKind, NoWeights
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import uniform
from pigaming_app.sim.world import HZ

PRESSES = 3.5  # per second
HELD = 0.8  # s, mean time for which a key is down
KEYS = 5  # ahead, back, left, right, FIRE


@record
class MasherMind:
    """Ticks for which each key is still down."""

    random: int
    ahead: int
    back: int
    left: int
    right: int
    fire: int


@kernel
def think(match: MatchState, seat: int, mind: MasherMind, weights: NoWeights) -> None:
    """Press a key at random now and then, and hold what is down."""
    if uniform(mind) < PRESSES / HZ:
        key, ticks = int(KEYS * uniform(mind)), 1 + int(2.0 * HELD * HZ * uniform(mind))
        if key == 0:
            mind.ahead = ticks
        elif key == 1:
            mind.back = ticks
        elif key == 2:
            mind.left = ticks
        elif key == 3:
            mind.right = ticks
        else:
            mind.fire = ticks
    mind.ahead, mind.back = max(0, mind.ahead - 1), max(0, mind.back - 1)
    mind.left, mind.right = max(0, mind.left - 1), max(0, mind.right - 1)
    mind.fire = max(0, mind.fire - 1)
    linear = (1.0 if mind.ahead else 0.0) - (1.0 if mind.back else 0.0)
    angular = (1.0 if mind.right else 0.0) - (1.0 if mind.left else 0.0)
    set_action(match.actions[seat], linear, angular, mind.fire, 0)


MASHER = BrainKind("masher", MasherMind, think)
