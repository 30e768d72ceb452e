"""Tabular Q-learning after the original and M. Humphrys, *Action Selection methods using Reinforcement Learning*, 1997.

The learning rate is alpha = 1 / n(x, a), counting the present visit, so the first visit overwrites Q. Actions are drawn
from the Boltzmann distribution exp(Q / T), and T falls as experience grows.
"""

from pigaming_app.ai.qlearning.features import SECTORS, nearest_opponent, opponent_of, situation, wall_of
from pigaming_app.ai.qlearning.recipe import Recipe
from pigaming_app.ai.qlearning.table import ACTIONS, LearnerMind, QTable, apply_move, max_value, sample_move
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import Action

CREEP = 10.0  # px/s; a slower robot counts as standing


@kernel
def learn(match: PiTanks, seat: int, mind: LearnerMind, table: QTable) -> None:
    """One tick of a learner: at every decision update the table for the last one, then draw the next move."""
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
    mind.reward = action_reward(match, seat, opponent, here, match.actions[seat], knobs)


@kernel
def learn_last(match: PiTanks, seat: int, mind: LearnerMind, table: QTable) -> None:
    """Update the table at the end of a match: a truncation, so the last decision bootstraps like any other."""
    if mind.begun and table.knobs.last:
        update(table, mind, situation(match, seat, nearest_opponent(match, seat), table.knobs.incoming))
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
    reward = mind.reward + transition_reward(mind.state, here, knobs)
    target = reward + knobs.gamma * max_value(table, here)
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
def action_reward(match: PiTanks, seat: int, opponent: int, state: int, action: Action, knobs: Recipe) -> float:
    """Immediate reward for choosing `action` in `state`, points."""
    reward = 0.0
    if action.fire and not (knobs.loaded and match.tanks[seat].cooldown):
        direction = opponent_of(state)
        if knobs.look < direction < SECTORS - knobs.look:
            reward += knobs.miss
        elif wall_of(state) != direction or not knobs.off_wall:
            robot, other = match.robots[seat], match.robots[opponent]
            if not knobs.in_sight or is_clear(match, robot.x, robot.y, other.x, other.y, 0.0):
                reward += knobs.hit
    speed = match.robots[seat].linear
    if (-CREEP < speed < CREEP) if knobs.moving else action.linear == 0.0:
        reward += knobs.still
    return reward


@kernel
def transition_reward(before: int, after: int, knobs: Recipe) -> float:
    """Reward for the transition from one decision's state to the next one's, points."""
    begun = exposed(before, knobs) if knobs.exposure else opponent_behind(before, knobs)
    reward: float = knobs.behind if exposed(after, knobs) and (knobs.behind_always or not begun) else 0.0
    return reward


@kernel
def exposed(state: int, knobs: Recipe) -> int:
    """1 if the opponent is behind and the closest wall is in another direction."""
    return 1 if opponent_behind(state, knobs) and wall_of(state) != opponent_of(state) else 0


@kernel
def opponent_behind(state: int, knobs: Recipe) -> int:
    """1 if the direction of the opponent counts as behind."""
    return 1 if knobs.behind_from <= opponent_of(state) <= knobs.behind_to else 0
