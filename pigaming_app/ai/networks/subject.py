"""What the inputs of a game's networks are about, for explanations: topics, and the places of perceived things."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import cos, sin
from typing import Any, NamedTuple

from pigaming_app.ai.brain.thoughts import Percept
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.world import HEIGHT, WIDTH


class Sight(NamedTuple):
    """A thing that a network perceives: topic, kind (see `Percept`), distance in px, and direction as cosine and sine
    relative to the own heading; or a distance of 1, and px ahead and to the right. `clear`: nothing is in between.
    """

    topic: str
    kind: str
    distance: float
    ahead: float
    right: float
    clear: bool = True


@dataclass(frozen=True)
class Subject:
    """The inputs of a game: groups by topic, in the order of their bars; positions of the stick; things by place.

    `fire`: what FIRE does. `percepts(match, inputs)`: the things that the network perceived, and where,
    at its last decision, with its delay and its aiming error.
    """

    topics: Mapping[str, tuple[str, ...]]
    drives: Sequence[float]
    turns: Sequence[float]
    fire: str
    percepts: Callable[[Any, Sequence[float]], Iterable[Sight]]
    place: int | None = None  # first of the inputs with the own position and direction; None: the present ones serve
    turned: Callable[[Any, int], bool] = lambda match, seat: False  # whether a seat's place is turned by half a circle


def perceived(subject: Subject, match: MatchState, seat: int, inputs: Sequence[float]) -> Iterator[tuple[str, Percept]]:
    """Topics and things in a network's inputs; positions in arena px."""
    known, robot = [value / UNIT for value in inputs], match.robots[seat]
    if subject.place is None:
        x, y, ahead_x, ahead_y = robot.x, robot.y, cos(robot.heading), sin(robot.heading)
    else:
        sign = -1.0 if subject.turned(match, seat) else 1.0
        right, down, ahead_x, ahead_y = (sign * value for value in known[subject.place : subject.place + 4])
        x, y = 0.5 * (right + 1.0) * WIDTH, 0.5 * (down + 1.0) * HEIGHT

    for sight in subject.percepts(match, known):
        right = x + sight.distance * (sight.ahead * ahead_x - sight.right * ahead_y)
        down = y + sight.distance * (sight.ahead * ahead_y + sight.right * ahead_x)
        yield sight.topic, Percept(sight.kind, right, down, sight.clear)


def distance_of(nearness: float, half: float) -> float:
    """The distance whose nearness is half / (half + distance)."""
    return half / max(nearness, 1.0 / UNIT) - half
