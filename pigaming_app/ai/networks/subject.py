"""What the inputs of a game's networks are about, for explanations: topics, and the places of perceived things."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import cos, sin
from typing import Any

from pigaming_app.ai.brain.thoughts import Percept
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.world import HEIGHT, WIDTH

Point = tuple[float, float]
At = Callable[[float, float, float], Point]  # distance, and direction as cosine and sine relative to the heading
Found = Iterator[tuple[str, Percept]]  # topics and things


@dataclass(frozen=True)
class Subject:
    """The inputs of a game: groups by topic, in the order of their bars; positions of the stick; things by place.

    `fire`: what FIRE does. `percepts(match, inputs, at)`: where the network perceived things
    at its last decision, with its delay and its aiming error.
    """

    topics: Mapping[str, tuple[str, ...]]
    drives: Sequence[float]
    turns: Sequence[float]
    fire: str
    percepts: Callable[[Any, Sequence[float], At], Found]
    place: int | None = None  # first of the inputs with the own position and direction; None: the present ones serve
    turned: Callable[[Any, int], bool] = lambda match, seat: False  # whether a seat's place is turned by half a circle


def perceived(subject: Subject, match: MatchState, seat: int, inputs: Sequence[float]) -> Found:
    """Topics and things in a network's inputs; positions in arena px."""
    known, robot = [value / UNIT for value in inputs], match.robots[seat]
    if subject.place is None:
        x, y, ahead_x, ahead_y = robot.x, robot.y, cos(robot.heading), sin(robot.heading)
    else:
        sign = -1.0 if subject.turned(match, seat) else 1.0
        right, down, ahead_x, ahead_y = (sign * value for value in known[subject.place : subject.place + 4])
        x, y = 0.5 * (right + 1.0) * WIDTH, 0.5 * (down + 1.0) * HEIGHT

    def at(distance: float, along: float, across: float) -> Point:
        return (
            x + distance * (along * ahead_x - across * ahead_y),
            y + distance * (along * ahead_y + across * ahead_x),
        )

    return subject.percepts(match, known, at)


def distance_of(nearness: float, half: float) -> float:
    """The distance whose nearness is half / (half + distance)."""
    return half / max(nearness, 1.0 / UNIT) - half
