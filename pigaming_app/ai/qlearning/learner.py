"""Tabular Q-learning in self-play, after the original and M. Humphrys, "Action Selection methods using Reinforcement
Learning" (1997): n(x, a) counts first, then alpha = 1 / n, so the first visit overwrites Q; actions are drawn from
exp(Q / T), and T falls while experience grows. A trained robot draws as well, at the last temperature.
"""

from math import exp
from typing import Annotated, Any, NamedTuple

from pigaming_app.ai.brain.unstick import Reflex
from pigaming_app.ai.qlearning.features import STATES, nearest_opponent, situation
from pigaming_app.ai.qlearning.rewards import RecipeRecord, action_reward, transition_reward
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import uniform

ACTIONS = 18
PAIRS = STATES * ACTIONS


class Move(NamedTuple):
    """What one of the 18 actions does with stick and button."""

    linear: float  # -1, 0, 1
    angular: float
    fire: int


MOVES = tuple(Move(float(k // 6 - 1), float(k // 2 % 3 - 1), k % 2) for k in range(ACTIONS))


@record
class QTable:
    """All that is learned, with all that decides how it goes on."""

    q: Annotated[list[float], PAIRS]  # of action a in state x at [x * ACTIONS + a]
    n: Annotated[list[int], PAIRS]  # how often it was tried
    experiences: int
    pairs: int  # of state and action that were ever tried
    states: int  # that were ever seen at a decision
    matches: int  # played to their end
    random: int
    knobs: RecipeRecord


@record
class LearnerMind:
    """What a learner, or a player with a table, remembers between decisions."""

    begun: int  # 0 before the first decision of a match
    state: int  # at the last decision
    move: int  # chosen then
    worth: float  # of that move as such
    random: int  # of a player; learners draw from their table's
    reflex: Reflex


@kernel
def learn(match: Any, seat: int, mind: Any, table: Any) -> None:
    """A learner's turn: at every decision learn from the last one, then choose by what is known so far."""
    knobs = table.knobs
    if match.tick % knobs.period:
        return
    opponent = nearest_opponent(match, seat)
    here = situation(match, seat, opponent, knobs.incoming)
    if mind.begun:
        update(table, mind, here)
    mind.begun, mind.state = 1, here
    mind.move = sample_move(table, here, temperature(table), table)
    apply_move(match.actions[seat], mind.move)
    mind.worth = action_reward(match, seat, opponent, here, match.actions[seat], knobs)


@kernel
def learn_last(match: Any, seat: int, mind: Any, table: Any) -> None:
    """The time is up: that ends the match, not the world, so the last decision counts like any other."""
    if mind.begun and table.knobs.last:
        update(table, mind, situation(match, seat, nearest_opponent(match, seat), table.knobs.incoming))
    mind.begun = 0


@kernel
def update(table: Any, mind: Any, here: int) -> None:
    """One experience: Q(x, a) += (r + gamma max Q(y, b) - Q(x, a)) / n(x, a)."""
    knobs, pair = table.knobs, mind.state * ACTIONS + mind.move
    if table.n[pair] == 0:
        table.pairs += 1
        if is_unvisited(table, mind.state):
            table.states += 1
    table.n[pair] += 1
    table.experiences += 1
    reward = mind.worth + transition_reward(mind.state, here, knobs)
    wish = reward + knobs.gamma * max_value(table, here)
    table.q[pair] += (wish - table.q[pair]) / table.n[pair]


@kernel
def is_unvisited(table: Any, state: int) -> int:
    """1 if no action was ever tried in a state."""
    for k in range(state * ACTIONS, (state + 1) * ACTIONS):
        if table.n[k]:
            return 0
    return 1


@kernel
def max_value(table: Any, state: int) -> float:
    """The most that any action is worth in a state."""
    most: float = table.q[state * ACTIONS]
    for k in range(state * ACTIONS + 1, (state + 1) * ACTIONS):
        if table.q[k] > most:
            most = table.q[k]
    return most


@kernel
def temperature(table: Any) -> float:
    """How daring a learner is: a straight line (or one step) from hot to cold, and cold from the ceiling on."""
    knobs = table.knobs
    share = table.experiences / knobs.ceiling if knobs.ramp else 0.0
    if table.experiences >= knobs.ceiling:
        cold: float = knobs.cold
        return cold
    heat: float = knobs.cold + (1.0 - share) * (knobs.hot - knobs.cold)
    return heat


@kernel
def sample_move(table: Any, state: int, heat: float, owner: Any) -> int:
    """An action by the roulette over exp((Q - max Q) / T), with the generator of `owner`."""
    first = state * ACTIONS
    most = max_value(table, state)
    whole = 0.0
    for k in range(first, first + ACTIONS):
        whole += exp((table.q[k] - most) / heat)
    ball = uniform(owner) * whole
    for a in range(ACTIONS):
        ball -= exp((table.q[first + a] - most) / heat)
        if ball < 0.0:
            return a
    return ACTIONS - 1


@kernel
def apply_move(action: Any, move: int) -> None:
    """Set stick and button to one of the 18 moves."""
    set_action(action, float(move // 6 - 1), float(move // 2 % 3 - 1), move % 2, 0)


def move_probabilities(table: Any, state: int, heat: float) -> list[float]:
    """How likely each of the 18 moves is in a state, at a temperature; `table` in either body."""
    values = [float(q) for q in table.q[state * ACTIONS : (state + 1) * ACTIONS]]
    most = max(values)
    odds = [exp((q - most) / heat) for q in values]
    whole = sum(odds)
    return [one / whole for one in odds]
