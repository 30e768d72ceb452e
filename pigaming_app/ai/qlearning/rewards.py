"""Rewards of the Q-learner and all other parameters of its training, as one recipe.

RECIPES[1] and RECIPES[2] are the original's two reward tables. Every choice that its paper leaves open is a named field
here, with our choice as default; the Lab edits the same fields.
"""

from dataclasses import dataclass, fields, replace
from typing import Any

from pigaming_app.ai.qlearning.features import opponent_of, wall_of
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.toml_table import quote

AHEAD = 0  # sector straight ahead
CREEP = 10.0  # px/s; a slower robot counts as standing
BEHIND_FROM, BEHIND_TO = 4, 12  # first and last sector that count as behind

ANY, SWITCH, HEAT = (-1000.0, 1000.0), (0, 1), (0.001, 1000.0)
BOUNDS: dict[str, tuple[float, float]] = {
    "behind_always": SWITCH,
    "gamma": (0.0, 0.999),
    "ceiling": (1, 1_000_000_000),
    "hot": HEAT,
    "cold": HEAT,
    "period": (1, 50),
    "incoming": SWITCH,
    "loaded": SWITCH,
    "in_sight": SWITCH,
    "moving": SWITCH,
    "ramp": SWITCH,
    "last": SWITCH,
}


@dataclass(frozen=True)
class Recipe:
    """All parameters of learning except the random seed. Rewards are in points; switches are 0 or 1."""

    hit: float = 10.0  # fires with the opponent ahead and in sight, and the closest wall in another direction
    miss: float = -1.0  # fires with the opponent in another direction
    behind: float = -1.0  # opponent behind, and the closest wall in another direction
    behind_always: int = 0  # 0: only when this situation begins; 1: at every decision
    still: float = 0.0  # no linear command
    gamma: float = 0.6  # discount per decision
    ceiling: int = 100_000  # experiences, of both robots, over which the temperature falls
    hot: float = 1.0 / 2.0  # temperature at the first experience
    cold: float = 1.0 / 50.0  # temperature from `ceiling` on, and of trained robots
    period: int = 5  # ticks between decisions: 10 Hz; at 3 rad/s a decision turns by 17 degrees, less than a sector
    incoming: int = 1  # 1: only approaching bullets are seen; 0: all of the opponent's
    loaded: int = 0  # 1: firing counts only when the gun is loaded; 0: pressing the button counts
    in_sight: int = 1  # 1: `hit` needs a free line of sight; 0: the direction alone counts
    moving: int = 0  # `still` means 0: no linear command; 1: no motion, whatever the command
    ramp: int = 1  # 1: linear fall of the temperature; 0: one step at `ceiling`, as the thesis's whole numbers do
    last: int = 1  # 1: the last decision is learned from at the end (a truncation: bootstrapped); 0: it is dropped

    def __post_init__(self) -> None:
        """Raises ValueError for numbers out of bounds, TypeError for other types."""
        for field in fields(self):
            value, (low, high) = getattr(self, field.name), BOUNDS.get(field.name, ANY)
            if isinstance(value, bool) or not isinstance(value, int if field.type is int else int | float):
                kind = "whole number" if field.type is int else "number"
                raise TypeError(f"{field.name}: {quote(value)} is not a {kind}")
            if not low <= value <= high:
                raise ValueError(f"{field.name}: {quote(value)}, but {low:g} to {high:g} are possible")


@record
class RecipeRecord(Recipe):
    """`Recipe` as a record for kernels."""


RECIPES = {1: Recipe(), 2: replace(Recipe(), behind_always=1, still=-10.0)}


@kernel
def action_reward(match: Any, seat: int, opponent: int, state: int, action: Any, knobs: Any) -> float:
    """Immediate reward for choosing `action` in `state`, points."""
    reward = 0.0
    if action.fire and not (knobs.loaded and match.tanks[seat].cooldown):
        ahead = opponent_of(state)
        if ahead != AHEAD:
            reward += knobs.miss
        elif wall_of(state) != ahead:
            robot, other = match.robots[seat], match.robots[opponent]
            if not knobs.in_sight or is_clear(match, robot.x, robot.y, other.x, other.y, 0.0):
                reward += knobs.hit
    speed = match.robots[seat].linear
    if (-CREEP < speed < CREEP) if knobs.moving else action.linear == 0.0:
        reward += knobs.still
    return reward


@kernel
def transition_reward(before: int, after: int, knobs: Any) -> float:
    """Reward for the transition from one decision's state to the next one's, points."""
    reward: float = knobs.behind if exposed(after) and (knobs.behind_always or not exposed(before)) else 0.0
    return reward


@kernel
def exposed(state: int) -> int:
    """1 if the opponent is behind and the closest wall is in another direction."""
    ahead = opponent_of(state)
    return 1 if BEHIND_FROM <= ahead <= BEHIND_TO and wall_of(state) != ahead else 0
