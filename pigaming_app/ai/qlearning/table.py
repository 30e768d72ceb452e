"""A Q-table, and moves by it, drawn from the Boltzmann distribution exp(Q / T) as in training."""

from collections.abc import Callable
from math import exp
from typing import Annotated, Any, NamedTuple

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.brain.unstick import Reflex, act_on_reflex
from pigaming_app.ai.qlearning.features import STATES, nearest_opponent, situation
from pigaming_app.ai.qlearning.recipe import Recipe, RecipeRecord
from pigaming_app.ai.reward_line import RewardProgram, program_of
from pigaming_app.ai.reward_quantities import QUANTITIES
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import fields_of, packed, record, unpack
from pigaming_app.sim.rng import Rng, seeded, uniform
from pigaming_app.sim.world import Action

ACTIONS = 18
PAIRS = STATES * ACTIONS  # of state and action
VANISHING = -746.0  # power whose exponential is 0


class Move(NamedTuple):
    """Stick and fire button of one of the 18 actions."""

    linear: float  # -1, 0, 1
    angular: float
    fire: int


MOVES = tuple(Move(float(k // 6 - 1), float(k // 2 % 3 - 1), k % 2) for k in range(ACTIONS))


@record
class QTable:
    """The Q-table with its visit counts, training progress, random generator and parameters."""

    q: Annotated[list[float], PAIRS]  # Q(x, a) at [x * ACTIONS + a]
    n: Annotated[list[int], PAIRS]  # n(x, a), number of updates
    experiences: int  # updates so far
    pairs: int  # pairs of state and action tried at least once
    states: int  # states with at least one tried action
    matches: int  # matches played to the end
    random: int
    knobs: RecipeRecord
    rest: RewardProgram  # of the reward, beside the weights among the knobs


@record
class LearnerMind:
    """Memory of a learner, or of a player with a table, between decisions."""

    begun: int  # 0 before the first decision of a match
    state: int  # state at the last decision
    move: int  # move chosen then
    seen: Annotated[list[float], len(QUANTITIES)]  # what its reward depends on
    random: int  # generator of a player; learners use the generator of their table
    reflex: Reflex
    odds: Annotated[list[float], ACTIONS]  # of the moves at the last decision


@kernel
def max_value(table: QTable, state: int) -> float:
    """Highest Q of a state."""
    first = max(0, state * ACTIONS)  # seen to be no place from the end, which numba would look for every time
    highest, other = table.q[first], table.q[first + 1]  # of two halves: the processor compares them side by side
    for a in range(2, ACTIONS, 2):
        highest = table.q[first + a] if table.q[first + a] > highest else highest
        other = table.q[first + a + 1] if table.q[first + a + 1] > other else other
    return other if other > highest else highest


@kernel
def sample_move(table: QTable, state: int, heat: float, owner: Rng, odds: list[float]) -> int:
    """Draw a move with probability proportional to exp((Q - max Q) / T), T = `heat`, by the generator of `owner`.

    `odds` receives these powers.
    """
    first = state * ACTIONS
    highest = max_value(table, state)
    untried, total = power_of(0.0, highest, heat), 0.0  # most values are 0 or the highest, and exp takes long
    for a in range(ACTIONS):
        q = table.q[first + a]
        odds[a] = untried if q == 0.0 else 1.0 if q == highest else power_of(q, highest, heat)
        total += odds[a]
    rest = uniform(owner) * total
    for a in range(ACTIONS):
        rest -= odds[a]
        if rest < 0.0:
            return a
    return ACTIONS - 1


@kernel
def power_of(q: float, highest: float, heat: float) -> float:
    """exp((q - highest) / heat)."""
    power = (q - highest) / heat
    return exp(power) if power > VANISHING else 0.0


@kernel
def apply_move(action: Action, move: int) -> None:
    """Set stick and fire button to one of the 18 moves."""
    set_action(action, float(move // 6 - 1), float(move // 2 % 3 - 1), move % 2, 0)


def set_recipe(table: Any, recipe: Recipe) -> None:
    """Let a table be learned by a recipe from now on. `table`: a plain or NumPy record."""
    plain = isinstance(table, QTable)
    knobs = table.knobs if plain else table["knobs"]
    for field in fields_of(RecipeRecord):
        knobs[field.name] = field.kind(getattr(recipe, field.name))
    rest = program_of(recipe.rest, QUANTITIES)
    table["rest"] = rest if plain else packed([rest])[0]


def move_probabilities(table: QTable, state: int, heat: float) -> list[float]:
    """Probabilities of the 18 moves in a state at temperature `heat`; `table` is a plain or NumPy record."""
    values = [float(q) for q in table.q[state * ACTIONS : (state + 1) * ACTIONS]]
    highest = max(values)
    odds = [exp((q - highest) / heat) for q in values]
    total = sum(odds)
    return [weight / total for weight in odds]


@kernel
def think(match: PiTanks, seat: int, mind: LearnerMind, weights: QTable) -> None:
    """At every decision draw a move at the final temperature, unless the reflex overrides it."""
    if match.tick % weights.knobs.period:
        return
    opponent = nearest_opponent(match, seat)
    if opponent >= 0 and not act_on_reflex(match, seat, opponent, mind, weights.knobs.period):
        mind.state = situation(match, seat, opponent, weights.knobs.incoming)
        mind.move = sample_move(weights, mind.state, weights.knobs.cold, mind, mind.odds)
        apply_move(match.actions[seat], mind.move)


def reset(mind: LearnerMind, seed: int) -> None:
    """Initialise a mind that follows the table alone."""
    mind.random = seeded(seed)


def reset_with_reflex(mind: LearnerMind, seed: int) -> None:
    """Initialise a mind whose reflex frees the robot when it is stuck."""
    reset(mind, seed)
    mind.reflex.on = 1


class Learned:
    """A trained table as the `weights` of a brain. The NumPy or plain copy is made on first use and cached."""

    def __init__(self, table: QTable) -> None:
        """`table`: a plain record, or a row of one NumPy record."""
        plain = isinstance(table, QTable)
        self.bodies: dict[bool, Any] = {not plain: [table] if plain else table}

    def __call__(self, fast: bool) -> Any:
        """A row of one table, a NumPy record (`fast`) or a plain one."""
        if fast not in self.bodies:
            other = self.bodies[not fast]
            self.bodies[fast] = packed(other) if fast else [unpack(QTable, other[0])]
        return self.bodies[fast]


def player(name: str, weights: Callable[[bool], Any], reflex: bool = False) -> BrainKind:
    """A brain that plays by a table; `reflex`: it also frees itself when stuck, as in matches against people."""
    return BrainKind(name, LearnerMind, think, reset_with_reflex if reflex else reset, weights)
