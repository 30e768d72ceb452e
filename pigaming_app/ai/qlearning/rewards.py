"""What the Q-learner is rewarded for, and every choice of its training, as one recipe.

The original's two reward tables are RECIPES[1] and RECIPES[2]. What its paper leaves open is a named number here, with
the choice that was made as its default; the Lab turns the same numbers.
"""

from dataclasses import dataclass, fields, replace
from typing import Any

from pigaming_app.ai.qlearning.features import opponent_of, wall_of
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.toml_table import quote

AHEAD = 0  # the sector in which a robot looks
CREEP = 10.0  # px/s below which a robot does not move
BEHIND_FROM, BEHIND_TO = 4, 12  # the sectors in which an opponent is behind

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
    """Everything that decides what is learned, but chance. Rewards are points; switches are 0 or 1."""

    hit: float = 10.0  # it fires, looks at the opponent and sees it, and the closest wall is not in that direction
    miss: float = -1.0  # it fires and does not look at the opponent
    behind: float = -1.0  # the opponent is behind it, and the closest wall is not in the same direction
    behind_always: int = 0  # 0: only when the opponent gets there; 1: at every decision
    still: float = 0.0  # no linear command
    gamma: float = 0.6
    ceiling: int = 100_000  # experiences, of both robots, over which the temperature falls
    hot: float = 1.0 / 2.0  # the temperature at the first experience
    cold: float = 1.0 / 50.0  # from the ceiling on, and whenever a trained robot plays
    period: int = 5  # ticks between decisions: 10 Hz; at 3 rad/s a decision turns by 17 degrees, less than a sector
    incoming: int = 1  # 1: only bullets are seen that come nearer; 0: all of the opponent's
    loaded: int = 0  # 1: firing counts only when the gun is ready; 0: pressing the button counts
    in_sight: int = 1  # 1: to see the opponent nothing may stand between; 0: looking its way is enough
    moving: int = 0  # 0: still is who gives no linear command; 1: who does not move, whatever the command
    ramp: int = 1  # 1: the temperature falls in a line; 0: in one step at the ceiling, as the thesis's whole numbers do
    last: int = 1  # 1: what was done last is learned from when the time is up (a truncation: bootstrapped); 0: dropped

    def __post_init__(self) -> None:
        """Raises ValueError for numbers nothing can be learned with, TypeError for what is no number."""
        for field in fields(self):
            value, (low, high) = getattr(self, field.name), BOUNDS.get(field.name, ANY)
            if isinstance(value, bool) or not isinstance(value, int if field.type is int else int | float):
                kind = "whole number" if field.type is int else "number"
                raise TypeError(f"{field.name}: {quote(value)} is not a {kind}")
            if not low <= value <= high:
                raise ValueError(f"{field.name}: {quote(value)}, but {low:g} to {high:g} are possible")


@record
class RecipeRecord(Recipe):
    """The recipe as a kernel reads it."""


RECIPES = {1: Recipe(), 2: replace(Recipe(), behind_always=1, still=-10.0)}


@kernel
def action_reward(match: Any, seat: int, opponent: int, state: int, action: Any, knobs: Any) -> float:
    """The reward for an action in a state as such, the moment it is chosen."""
    worth = 0.0
    if action.fire and not (knobs.loaded and match.tanks[seat].cooldown):
        ahead = opponent_of(state)
        if ahead != AHEAD:
            worth += knobs.miss
        elif wall_of(state) != ahead:
            robot, other = match.robots[seat], match.robots[opponent]
            if not knobs.in_sight or is_clear(match, robot.x, robot.y, other.x, other.y, 0.0):
                worth += knobs.hit
    speed = match.robots[seat].linear
    if (-CREEP < speed < CREEP) if knobs.moving else action.linear == 0.0:
        worth += knobs.still
    return worth


@kernel
def transition_reward(before: int, after: int, knobs: Any) -> float:
    """The reward for what came of an action: the state before it and the state at the next decision."""
    worth: float = knobs.behind if exposed(after) and (knobs.behind_always or not exposed(before)) else 0.0
    return worth


@kernel
def exposed(state: int) -> int:
    """1 if the opponent is behind and the closest wall does not cover that direction."""
    ahead = opponent_of(state)
    return 1 if BEHIND_FROM <= ahead <= BEHIND_TO and wall_of(state) != ahead else 0
