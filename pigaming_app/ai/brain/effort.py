"""Effort: a brain between an easy and a hard one of the same kind, whose place there follows the score.

Who is behind tries harder, who leads tries less. Effort changes slowly, so that nobody sees a robot become another
one, and the hard brain drives by the same stick and buttons as a person.
"""

from collections.abc import Callable, Iterator
from functools import cache
from typing import Annotated, Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import fields_of, record
from pigaming_app.sim.world import DT, ROBOTS

Path = tuple[str, ...]  # names of a field of a mind, and of the records that it is in
Lead = Callable[[Any, int], float]  # points by which a seat's team is ahead; a kernel
KNOBS = 10  # numbers in which an easy and a hard brain may differ, at most
MOST = 6.0  # points of a lead that count
CHANGE = 0.003  # of effort, per second and point
PERIOD = 10  # ticks between changes
AUTO = tuple(f"auto{number}" for number in range(1, 10))  # brains that follow people, the weakest start first
REACH = 0.3  # of their effort, up and down from the start; the strongest start does not ease


@record
class Effort:
    """Present effort with its bounds, and the numbers of the brain at both ends."""

    now: float  # 0: as the easy brain .. 1: as the hard one
    floor: float  # as hard as this it plays at least, if its effort is less
    least: float
    most: float
    easy: Annotated[list[float], KNOBS]
    hard: Annotated[list[float], KNOBS]


def between(easy: BrainKind, hard: BrainKind, lead: Lead | None = None) -> tuple[BrainKind, ...]:
    """The brains AUTO between two that differ in numbers only. `lead`: by which points; default: `margin`.

    Raises ValueError for brains that differ in more, or in more than KNOBS numbers.
    """
    if (easy.think, easy.mind) != (hard.think, hard.mind):
        raise ValueError(f"{easy.name} and {hard.name} are not of one kind")
    knobs = tuple(_differences(_fresh(easy, 1), _fresh(hard, 1)))
    if len(knobs) > KNOBS:
        raise ValueError(f"{easy.name} and {hard.name} differ in more than {KNOBS} numbers")
    think, mind = _make_think(easy.think, knobs, lead or margin), _mind_record(easy.mind)

    def kind(name: str, start: float) -> BrainKind:
        return BrainKind(name, mind, think, _make_reset(easy, hard, knobs, start), easy.weights)

    return tuple(kind(name, number / (len(AUTO) - 1)) for number, name in enumerate(AUTO))


def _make_reset(easy: BrainKind, hard: BrainKind, knobs: tuple[Path, ...], start: float) -> Callable[[Any, int], None]:
    def reset(mind: Any, seed: int) -> None:
        easy.begin(mind.inner, seed)
        other, effort = _fresh(hard, seed), mind.effort
        effort.now, effort.least, effort.most = start, max(0.0, start - REACH), min(1.0, start + REACH)
        effort.floor = max(0.0, start - min(REACH, 1.0 - start))
        for i, path in enumerate(knobs):
            effort.easy[i], effort.hard[i] = _value(mind.inner, path), _value(other, path)

    return reset


@kernel
def margin(match: MatchState, seat: int) -> float:
    """Points of a seat's team less the mean of the other teams; 0 without others."""
    own, others, teams = 0.0, 0.0, 0
    for team in range(ROBOTS):
        points, members = 0.0, 0
        for robot in match.robots:
            if robot.present and robot.team == team:
                points += robot.score
                members += 1
        if team == match.robots[seat].team:
            own = points
        elif members:
            others += points
            teams += 1
    return own - others / teams if teams else 0.0


@kernel
def follow(effort: Effort, lead: float, seconds: float) -> None:
    """Let the effort follow the score for some seconds."""
    points = lead if lead > -MOST else -MOST
    points = points if points < MOST else MOST
    now = effort.now - CHANGE * points * seconds
    now = now if now > effort.least else effort.least
    effort.now = now if now < effort.most else effort.most


@kernel
def knob(effort: Effort, i: int) -> float:
    """Number i at the present effort."""
    now: float = effort.now if effort.now > effort.floor else effort.floor
    value: float = effort.easy[i] + now * (effort.hard[i] - effort.easy[i])
    return value


@cache
def _mind_record(inner: type) -> type:
    hints = {"effort": Effort, "inner": inner}
    return record(type("EffortMind", (), {"__annotations__": hints, "__module__": __name__}))


@cache
def _make_think(think: Callable[[Any, int, Any, Any], None], knobs: tuple[Path, ...], lead: Lead) -> Any:
    """The decision function: now and then follow the score and turn the knobs; then think."""
    turn: Callable[[Any, Effort], None] = _end
    for i, path in enumerate(knobs):
        turn = _turn(path, i, turn)

    def think_harder(match: MatchState, seat: int, mind: Any, weights: Any) -> None:
        if match.tick % PERIOD == 0:
            follow(mind.effort, lead(match, seat), PERIOD * DT)
            turn(mind.inner, mind.effort)
        think(match, seat, mind.inner, weights)

    return kernel(think_harder)


@kernel
def _end(mind: Any, effort: Effort) -> None:
    """The end of a chain of knobs."""


@cache
def _turn(path: Path, i: int, others: Callable[[Any, Effort], None]) -> Callable[[Any, Effort], None]:
    """A kernel that sets number `i` of a mind to its value at the present effort, and then the others."""
    first, last = path[0], path[-1]

    def own(mind: Any, effort: Effort) -> None:
        mind[last] = knob(effort, i)
        others(mind, effort)

    def inner(mind: Any, effort: Effort) -> None:
        getattr(mind, first)[last] = knob(effort, i)
        others(mind, effort)

    return kernel(own if len(path) == 1 else inner)


def _fresh(kind: BrainKind, seed: int) -> Any:
    mind = kind.mind()
    kind.begin(mind, seed)
    return mind


def _value(mind: Any, path: Path) -> float:
    for name in path:
        mind = getattr(mind, name)
    return float(mind)


def _differences(easy: Any, hard: Any, path: Path = ()) -> Iterator[Path]:
    """The numbers in which two minds differ. Raises ValueError for whole numbers, lists, and what lies deep."""
    for field in fields_of(type(easy)):
        one, other, here = getattr(easy, field.name), getattr(hard, field.name), (*path, field.name)
        if field.count is None and not field.code:
            yield from _differences(one, other, here)
        elif field.count is not None and not field.code:
            continue
        elif one != other:
            if field.kind is not float or field.count is not None or len(here) > 2:
                raise ValueError(f"{'.'.join(here)}: only single numbers may differ")
            yield here
