"""A lesson of a game: a short match that a script plays, shown by *How to play*."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

GO, TURN, WAIT = "go", "turn", "wait"
STEP = re.compile(r"((?:fire |turbo )*)(go|turn|wait)((?: -?\d+(?:\.\d+)?)+)")
NUMBERS = {GO: 2, TURN: 2, WAIT: 1}  # of each verb


class Step(NamedTuple):
    """One step of a script, and the buttons held meanwhile."""

    verb: str
    numbers: tuple[float, ...]
    fire: bool
    turbo: bool


@dataclass(frozen=True)
class Actor:
    """A robot of a lesson. It starts at (x, y), arena px, with a heading in degrees, clockwise from the right.

    `does`: the name of a brain, or steps, separated by commas: `go X Y` drives to a point, `turn X Y` turns towards
    one, `wait S` stands for S seconds; `fire` or `turbo` before a step holds the button: "turbo go 9 45, fire wait 1".
    """

    x: float
    y: float
    heading: float = 0.0
    does: str = ""

    def steps(self) -> Iterator[Step]:
        """The steps. Raises ValueError."""
        for line in self.does.split(",") if self.does else ():
            found = STEP.fullmatch(line.strip())
            if not found or len(found[3].split()) != NUMBERS[found[2]]:
                raise ValueError(f"no step of a lesson: {line.strip()}")
            yield Step(found[2], tuple(map(float, found[3].split())), "fire" in found[1], "turbo" in found[1])

    @property
    def brain(self) -> str:
        """The brain that drives; empty: its steps do."""
        return self.does if self.does and " " not in self.does else ""


def as_it_is(state: Any) -> None:
    """Change nothing."""


@dataclass(frozen=True)
class Lesson:
    """A short match in a loop, of which a picture of about 400 x 400 px is shown.

    - `actors`: the robots, from the first seat on. The keys of the first are shown.
    - `seconds`: its length.
    - `middle`: of the picture, arena px; None: it follows the first robot.
    - `prepare(state)`: changes the start of the match.
    - `variant`: the rule set; empty: that of the page.
    - `arena`: empty: the first one of the game.
    """

    actors: tuple[Actor, ...]
    seconds: float = 6.0
    middle: tuple[float, float] | None = None
    prepare: Callable[[Any], None] = as_it_is
    variant: str = ""
    arena: str = ""

    def __post_init__(self) -> None:
        """Raises ValueError for a script that is wrong."""
        for actor in self.actors:
            if not actor.brain:
                list(actor.steps())
