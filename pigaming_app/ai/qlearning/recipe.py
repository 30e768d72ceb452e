"""Rewards of the Q-learner and all other parameters of its training, as one recipe, which a trained table keeps.

RECIPES[1] and RECIPES[2] are the original's two reward tables. Every choice that its paper leaves open is a named field
here, with our choice as default; the Lab edits the same fields. In two of them our default is not the paper's reading:

- `in_sight`: its rewards are functions of two states and an action, and a state holds directions only, so its "line of
  sight" is the direction of the opponent with the closest wall elsewhere: 0. Ours is 1, a free line between the robots
  as well, so that shots into the other walls earn nothing.
- `exposure`: its opponent "was not behind but gets behind": 0. Ours is 1: a wall that stops covering the robot's back
  counts, too, so that each spell of danger costs once, however it begins.

docs/thesis.md has the results of both readings.
"""

from dataclasses import dataclass, fields, replace

from pigaming_app.ai.reward_line import program_of
from pigaming_app.ai.reward_quantities import QUANTITIES
from pigaming_app.sim.record import record
from pigaming_app.sim.toml_table import quote
from pigaming_app.storage.schema import Line

ANY, SWITCH, HEAT = (-1000.0, 1000.0), (0, 1), (0.001, 1000.0)
BOUNDS: dict[str, tuple[float, float]] = {
    "in_sight": SWITCH,
    "off_wall": SWITCH,
    "look": (0, 7),
    "behind_from": (1, 8),
    "behind_to": (8, 15),
    "exposure": SWITCH,
    "behind_always": SWITCH,
    "gamma": (0.0, 0.999),
    "ceiling": (1, 1_000_000_000),
    "hot": HEAT,
    "cold": HEAT,
    "period": (1, 50),
    "incoming": SWITCH,
    "loaded": SWITCH,
    "moving": SWITCH,
    "ramp": SWITCH,
    "last": SWITCH,
}


@dataclass(frozen=True)
class RecipeNumbers:
    """All parameters of learning that are numbers. Rewards are in points; switches are 0 or 1."""

    hit: float = 10.0  # fires with the opponent ahead and in sight, and the closest wall in another direction
    in_sight: int = 1  # 1: `hit` needs a free line to the opponent; 0, the thesis: its direction alone counts
    off_wall: int = 1  # 1, the thesis: `hit` needs the closest wall in another direction; 0: in any
    look: int = 0  # sectors on either side of straight ahead that count as ahead; the thesis: 0
    miss: float = -1.0  # fires with the opponent in another direction than ahead
    behind: float = -1.0  # exposed: the opponent behind, and the closest wall in another direction
    behind_from: int = 4  # first and last sector that count as behind; the thesis: "between 4 and 12", so 4 and 12,
    behind_to: int = 12  # or 5 and 11
    exposure: int = 1  # `behind` where exposure begins: 1: however; 0, the thesis: as the opponent gets behind
    behind_always: int = 0  # 0, the thesis's agent 1: only then; 1, agent 2: at every decision in exposure
    still: float = 0.0  # no linear command
    gamma: float = 0.6  # discount per decision
    ceiling: int = 100_000  # experiences, of both robots, over which the temperature falls
    hot: float = 1.0 / 2.0  # temperature at the first experience
    cold: float = 1.0 / 50.0  # temperature from `ceiling` on, and of trained robots
    period: int = 5  # ticks between decisions: 10 Hz; at 3 rad/s a decision turns by 17 degrees, less than a sector
    incoming: int = 1  # 1: only approaching bullets are seen; 0: all of the opponent's
    loaded: int = 0  # 1: firing counts only when the gun is loaded; 0: pressing the button counts
    moving: int = 0  # `still` means 0: no linear command; 1: no motion, whatever the command
    ramp: int = 1  # 1: linear fall of the temperature; 0: one step at `ceiling`, as the thesis's whole numbers do
    last: int = 1  # 1: the last decision is learned from at the end (a truncation: bootstrapped); 0: it is dropped

    def __post_init__(self) -> None:
        """Raises ValueError for numbers out of bounds, TypeError for other types."""
        for field in fields(RecipeNumbers):
            value, (low, high) = getattr(self, field.name), BOUNDS.get(field.name, ANY)
            if isinstance(value, bool) or not isinstance(value, int if field.type is int else int | float):
                kind = "whole number" if field.type is int else "number"
                raise TypeError(f"{field.name}: {quote(value)} is not a {kind}")
            if not low <= value <= high:
                raise ValueError(f"{field.name}: {quote(value)}, but {low:g} to {high:g} are possible")


@dataclass(frozen=True)
class Recipe(RecipeNumbers):
    """All parameters of learning except the random seed."""

    rest: Line = ""  # of the reward, beside `hit`, `miss`, `behind` and `still`: see reward_line.py

    def __post_init__(self) -> None:
        """Raises ValueError for numbers out of bounds and for a rest that is no reward, TypeError for other types."""
        super().__post_init__()
        program_of(self.rest, QUANTITIES)


@record
class RecipeRecord(RecipeNumbers):
    """The numbers of a recipe as a record for kernels."""


RECIPES = {1: Recipe(), 2: replace(Recipe(), behind_always=1, still=-10.0)}
