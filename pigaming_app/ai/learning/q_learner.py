"""Tabular Q-learning after the original and M. Humphrys, *Action Selection methods using Reinforcement Learning*, 1997.

The learning rate is alpha = 1 / n(x, a), counting the present visit, so the first visit overwrites Q. Actions are drawn
from the Boltzmann distribution exp(Q / T), and T falls as experience grows.
"""

from math import sqrt

from pigaming_app.ai.qlearning.features import SECTORS, nearest_opponent, opponent_of, situation, wall_of
from pigaming_app.ai.qlearning.recipe import RecipeNumbers
from pigaming_app.ai.qlearning.table import ACTIONS, LearnerMind, QTable, apply_move, max_value, sample_move
from pigaming_app.ai.reward_line import points
from pigaming_app.ai.reward_quantities import BEHIND, DISTANCE, FARTHEST, FIRED, HIT, MISS, STILL, TAKEN, TURNED
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import Action

CREEP = 10.0  # px/s; a slower robot counts as standing


@kernel
def learn(match: PiTanks, seat: int, mind: LearnerMind, table: QTable) -> None:
    """A decision of a learner: update the table for the last one, then draw the next move."""
    knobs = table.knobs
    opponent = nearest_opponent(match, seat)
    here = situation(match, seat, opponent, knobs.incoming)
    if mind.begun:
        observe_transition(match, seat, mind, here, knobs)
        update(table, mind, here)
    mind.begun, mind.state = 1, here
    mind.move = sample_move(table, here, temperature(table), table, mind.odds)
    apply_move(match.actions[seat], mind.move)
    observe_action(match, seat, opponent, here, match.actions[seat], knobs, mind.seen)


@kernel
def learn_last(match: PiTanks, seat: int, mind: LearnerMind, table: QTable) -> None:
    """Update the table at the end of a match: a truncation, so the last decision bootstraps like any other."""
    if mind.begun and table.knobs.last:
        here = situation(match, seat, nearest_opponent(match, seat), table.knobs.incoming)
        observe_transition(match, seat, mind, here, table.knobs)
        update(table, mind, here)
    mind.begun = 0


@kernel
def update(table: QTable, mind: LearnerMind, here: int) -> None:
    """One update: Q(x, a) += (r + gamma max Q(y, b) - Q(x, a)) / n(x, a), with y the state `here`."""
    knobs, pair = table.knobs, mind.state * ACTIONS + mind.move
    if table.n[pair] == 0:
        table.pairs += 1
        if is_unvisited(table, mind.state):
            table.states += 1
    table.n[pair] += 1
    table.experiences += 1
    target = reward(table, mind.seen) + knobs.gamma * max_value(table, here)
    table.q[pair] += (target - table.q[pair]) / table.n[pair]


@kernel
def is_unvisited(table: QTable, state: int) -> int:
    """1 if no action was ever tried in the state."""
    for k in range(state * ACTIONS, (state + 1) * ACTIONS):
        if table.n[k]:
            return 0
    return 1


@kernel
def temperature(table: QTable) -> float:
    """Present temperature: falls from `hot` to `cold` linearly (`ramp`) or in one step at `ceiling` experiences."""
    knobs = table.knobs
    share = table.experiences / knobs.ceiling if knobs.ramp else 0.0
    if table.experiences >= knobs.ceiling:
        cold: float = knobs.cold
        return cold
    heat: float = knobs.cold + (1.0 - share) * (knobs.hot - knobs.cold)
    return heat


@kernel
def reward(table: QTable, seen: list[float]) -> float:
    """Reward of a decision with what was seen of it, points."""
    knobs = table.knobs
    worth: float = knobs.hit * seen[HIT] + knobs.miss * seen[MISS] + knobs.still * seen[STILL]
    worth += knobs.behind * seen[BEHIND]
    return worth + points(table.rest, seen) if table.rest.size else worth


@kernel
def observe_action(
    match: PiTanks, seat: int, opponent: int, state: int, action: Action, knobs: RecipeNumbers, seen: list[float]
) -> None:
    """What can be seen when `action` is chosen in `state`. Hits taken so far are subtracted, to be counted later."""
    robot, other, tank = match.robots[seat], match.robots[opponent], match.tanks[seat]
    seen[HIT], seen[MISS] = 0.0, 0.0
    if action.fire and not (knobs.loaded and tank.cooldown):
        direction = opponent_of(state)
        if knobs.look < direction < SECTORS - knobs.look:
            seen[MISS] = 1.0
        elif (wall_of(state) != direction or not knobs.off_wall) and (
            not knobs.in_sight or is_clear(match, robot.x, robot.y, other.x, other.y, 0.0)
        ):
            seen[HIT] = 1.0
    still = (-CREEP < robot.linear < CREEP) if knobs.moving else action.linear == 0.0
    seen[STILL] = 1.0 if still else 0.0
    seen[TURNED] = 1.0 if action.angular != 0.0 else 0.0
    seen[FIRED] = 1.0 if action.fire and not tank.cooldown else 0.0
    dx, dy = other.x - robot.x, other.y - robot.y
    seen[TAKEN], seen[DISTANCE] = -float(tank.taken), min(FARTHEST, sqrt(dx * dx + dy * dy))


@kernel
def observe_transition(match: PiTanks, seat: int, mind: LearnerMind, here: int, knobs: RecipeNumbers) -> None:
    """What can be seen of the last decision when the next one's state `here` is known."""
    mind.seen[BEHIND] = float(is_behind(mind.state, here, knobs))
    mind.seen[TAKEN] += match.tanks[seat].taken


@kernel
def is_behind(before: int, after: int, knobs: RecipeNumbers) -> int:
    """1 if the transition from one decision's state to the next one's counts as `behind`."""
    begun = exposed(before, knobs) if knobs.exposure else opponent_behind(before, knobs)
    return 1 if exposed(after, knobs) and (knobs.behind_always or not begun) else 0


@kernel
def exposed(state: int, knobs: RecipeNumbers) -> int:
    """1 if the opponent is behind and the closest wall is in another direction."""
    return 1 if opponent_behind(state, knobs) and wall_of(state) != opponent_of(state) else 0


@kernel
def opponent_behind(state: int, knobs: RecipeNumbers) -> int:
    """1 if the direction of the opponent counts as behind."""
    return 1 if knobs.behind_from <= opponent_of(state) <= knobs.behind_to else 0
