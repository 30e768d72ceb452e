"""The AIs of one game, and the ways in which people drive in it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from math import nan
from typing import Any

from pigaming_app.ai.brain import kind
from pigaming_app.ai.brain.driving import Driving, SteeringHelp, point_where_to_go, turn_and_drive
from pigaming_app.ai.brain.kind import BrainKind, Traits
from pigaming_app.sim.kernel import kernel

LEVELS = ("level1", "level2", "level3", "level4", "level5")  # in every game; one to five stars on the screen

TURN, POINT = "turn", "point"
HELPED_TURN, HELPED_POINT = "helped_turn", "helped_point"  # with steering help
ONE_BUTTON = "one_button"  # an AI drives; its entry in `driving` shows a stick on pages without a match
STAND_IN = "level3"  # drives for somebody who is away
USUAL_DRIVING: Mapping[str, Driving] = {TURN: turn_and_drive, POINT: point_where_to_go, ONE_BUTTON: turn_and_drive}


@kernel
def recall_nothing(mind: Any, since: int) -> None:
    """Of a game in which a mind remembers no shots."""


@kernel
def see_nothing(mind: Any) -> tuple[float, float]:
    """Of a game in which nobody aims."""
    return nan, nan


@dataclass(frozen=True)
class Gun:
    """Kernels on the mind of `GameAI.person`, by which `people fit` compares shots."""

    recall: Callable[[Any, int], None]  # take the last shot for so many ticks ago
    sight: Callable[[Any], tuple[float, float]]  # directions to the target and to where a shot would meet it, rad


NO_GUN = Gun(recall_nothing, see_nothing)


@dataclass(frozen=True)
class GameAI:
    """The AIs of one game. `kinds`: by name, the five LEVELS among them; `idle` and `random` are added."""

    kinds: Mapping[str, BrainKind]
    rivals: tuple[str, ...] = LEVELS  # offered in the lobby, in the order in which it steps through them
    driving: Mapping[str, Driving] = field(default_factory=lambda: USUAL_DRIVING)  # styles, in the lobby's order
    chauffeur: str = LEVELS[-1]  # drives for one button
    boosts: bool = False  # the one button is the turbo too, where there may be nothing to fire
    # an easy and a hard brain, whose minds differ in single floats after `reset`: Auto is between them; None: no Auto
    auto: tuple[BrainKind, BrainKind] | None = None
    lead: Callable[[Any, int], float] | None = None  # kernel: points by which a seat is ahead; default: of the match
    person: Callable[[Traits], BrainKind] | None = None  # what a person sees and wants; `ai/people` adds the hands
    gun: Gun = NO_GUN  # of the mind of `person`
    help: SteeringHelp | None = None  # of the model of people who presses keys at random

    def __post_init__(self) -> None:
        missing = [name for name in LEVELS if name not in self.kinds]
        if missing:
            raise ValueError(f"kinds: {', '.join(missing)} missing")
        if wrong := [name for name, kind in self.kinds.items() if not isinstance(kind, BrainKind)]:
            raise ValueError(f"kinds: {wrong[0]} is no BrainKind")
        if self.chauffeur not in self.kinds:
            raise ValueError(f"chauffeur: {self.chauffeur} is not in kinds")
        if self.auto and (self.auto[0].think, self.auto[0].mind) != (self.auto[1].think, self.auto[1].mind):
            raise ValueError("auto: two brains that differ in more than numbers")
        if not self.rivals or {*self.rivals} - self.brains.keys():
            raise ValueError(f"rivals: not all of {', '.join(self.rivals) or 'none'} are in kinds")
        if not {TURN, POINT} <= {*self.driving} <= {TURN, POINT, HELPED_TURN, HELPED_POINT, ONE_BUTTON}:
            raise ValueError(f"driving: no set of styles: {', '.join(self.driving)}")

    @property
    def brains(self) -> dict[str, BrainKind]:
        """All brains by name."""
        return {"idle": kind.IDLE, "random": kind.RANDOM, **self.kinds}


def levels(*kinds: BrainKind) -> dict[str, BrainKind]:
    """Five brains as the LEVELS, the weakest first; a single one stands for all of them."""
    every = kinds * len(LEVELS) if len(kinds) == 1 else kinds
    return {name: replace(kind, name=name) for name, kind in zip(LEVELS, every, strict=True)}


RANDOM_ONLY = GameAI(levels(kind.RANDOM))
"""Of a game without brains."""
