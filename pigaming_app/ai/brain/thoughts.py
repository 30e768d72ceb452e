"""A brain's reasoning as plain values for display: percepts, utilities, present behaviour.

A brain may provide `explain(match, seat, mind, weights) -> Thoughts`. It is read-only: it changes neither match nor
mind and draws no random number, so a match runs identically with or without the display.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import cos, tau

PETALS = 16  # directions of a rose (a polar histogram), clockwise from straight ahead
MoveKey = tuple[int, int, int]  # stick ahead and clockwise, each -1, 0 or 1, and fire, 0 or 1

OPPONENT, MATE, WALL, BULLET, PRIZE, GOAL, WAY = "opponent", "mate", "wall", "bullet", "prize", "goal", "way"
PERSON = "person"
STICKS = {
    (1, 0): "ahead", (1, -1): "ahead_left", (1, 1): "ahead_right", (0, 0): "stay", (0, -1): "turn_left",
    (0, 1): "turn_right", (-1, 0): "reverse", (-1, -1): "reverse", (-1, 1): "reverse",
}  # behaviours by position of the stick: ahead and clockwise  # fmt: skip


@dataclass(frozen=True)
class Percept:
    """A perceived object at its estimated position, arena px. `clear`: the line of sight is free."""

    kind: str
    x: float
    y: float
    clear: bool = True


@dataclass(frozen=True)
class Thoughts:
    """Present reasoning of a brain.

    `behaviour` and `reason` are keys of the texts [brain]; `names` fill the placeholders in those texts.
    """

    behaviour: str
    reason: str = ""
    names: Mapping[str, int | str] = field(default_factory=dict)
    facts: Mapping[str, float] = field(default_factory=dict)  # the variables behind the decision, by name
    percepts: Sequence[Percept] = ()
    rose: Sequence[float] = ()  # utility of each of PETALS directions, -1..1, relative to the robot's heading
    bearing: float | None = None  # rad, clockwise from the heading, of where it goes: in place of a rose
    utilities: Mapping[str, float] = field(default_factory=dict)  # utility of each behaviour, 0..1
    moves: Mapping[MoveKey, float] = field(default_factory=dict)  # utility of each move, for brains that choose moves
    chosen: str | MoveKey = ""  # a key of `utilities` or of `moves`
    heads: Mapping[str, Sequence[float]] = field(default_factory=dict)  # probabilities of choices, for networks
    choices: Mapping[str, int] = field(default_factory=dict)  # of each head

    @property
    def petals(self) -> Sequence[float]:
        """The rose, or one towards the bearing, or an empty one."""
        return self.rose or ((0.0,) * PETALS if self.bearing is None else towards(self.bearing))


def behaviour_of(linear: int, angular: int, fire: int) -> str:
    """The behaviour that an action shows; the stick ahead and clockwise, each -1, 0 or 1."""
    return "shoot" if fire else STICKS[linear, angular]


def clamp(value: float) -> float:
    """`value` limited to 0..1."""
    return min(1.0, max(0.0, value))


def towards(bearing: float, weight: float = 1.0) -> list[float]:
    """A rose with a lobe of height `weight` at `bearing` (rad) that falls to 0 a quarter turn away."""
    return [weight * max(0.0, cos(tau * k / PETALS - bearing)) ** 2 for k in range(PETALS)]


def blend(*roses: Sequence[float]) -> list[float]:
    """Sum of roses, limited to -1..1."""
    return [min(1.0, max(-1.0, sum(values))) for values in zip(*roses, strict=True)]


def petal(bearing: float) -> int:
    """Index of the petal nearest to a bearing in rad."""
    return round(bearing / tau * PETALS) % PETALS
