"""What a brain shows of itself to whoever watches: what it sees, what it would like, what it does, in plain values.

A kind of brain may have `explain(match, seat, mind, weights) -> Thoughts`. It only reads: neither match nor mind is
changed, no random number is drawn, so a match plays out alike whether anybody watches or not.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import cos, tau

PETALS = 16  # directions of a rose, clockwise from straight ahead
MoveKey = tuple[int, int, int]  # stick ahead and clockwise, each -1, 0 or 1, and fire, 0 or 1

OPPONENT, MATE, WALL, BULLET, PRIZE, GOAL, WAY = "opponent", "mate", "wall", "bullet", "prize", "goal", "way"
PERSON = "person"


@dataclass(frozen=True)
class Percept:
    """A thing that matters to it, and where it believes that is, arena px. `clear`: nothing stands between."""

    kind: str
    x: float
    y: float
    clear: bool = True


@dataclass(frozen=True)
class Thoughts:
    """What is on a brain's mind. `doing` and `because` are keys of the texts [brain]; `names` fill their braces."""

    doing: str
    because: str = ""
    names: Mapping[str, int | str] = field(default_factory=dict)
    facts: Mapping[str, float] = field(default_factory=dict)  # the state that it goes by, named
    sights: Sequence[Percept] = ()
    rose: Sequence[float] = (0.0,) * PETALS  # how good each direction seems, -1..1, relative to the own heading
    wishes: Mapping[str, float] = field(default_factory=dict)  # how much it wants each of the things it can do, 0..1
    moves: Mapping[MoveKey, float] = field(default_factory=dict)  # the same for brains that choose among moves
    chosen: str | MoveKey = ""  # a key of `wishes` or of `moves`


def clamp(value: float) -> float:
    """A number held within 0..1."""
    return min(1.0, max(0.0, value))


def towards(bearing: float, weight: float = 1.0) -> list[float]:
    """A rose that points in one direction, `weight` at its best and nothing a quarter turn away; bearing in rad."""
    return [weight * max(0.0, cos(tau * k / PETALS - bearing)) ** 2 for k in range(PETALS)]


def blend(*roses: Sequence[float]) -> list[float]:
    """The sum of roses, held within -1..1."""
    return [min(1.0, max(-1.0, sum(values))) for values in zip(*roses, strict=True)]


def petal(bearing: float) -> int:
    """The direction of a rose in which a bearing lies, rad."""
    return round(bearing / tau * PETALS) % PETALS
