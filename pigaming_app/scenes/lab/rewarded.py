"""The reward of a robot in training, as knobs and as a line."""

from dataclasses import replace
from typing import Any, Generic, TypeVar

from pigaming_app.ai.reward_line import line_of, with_line
from pigaming_app.ai.reward_quantities import QUANTITIES, WEIGHTED

Recipe = TypeVar("Recipe")  # a dataclass


class Rewarded(Generic[Recipe]):
    """A training whose `recipe` may change at any time."""

    recipe: Recipe

    def turn(self, knob: str, value: int) -> None:
        """Change one reward."""
        reward: dict[str, Any] = {knob: float(value)}
        self.recipe = replace(self.recipe, **reward)  # type: ignore[type-var]

    @property
    def line(self) -> str:
        """The reward as code."""
        return line_of(self.recipe, WEIGHTED)

    def reward_by(self, line: str) -> None:
        """Reward by a line of code. Raises LineError."""
        self.recipe = with_line(self.recipe, line, QUANTITIES, WEIGHTED)
