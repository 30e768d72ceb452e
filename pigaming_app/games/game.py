"""What a game is, who sits where, and how a match ended."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from pigaming_app.sim.arena import Arena


@dataclass(frozen=True)
class Seat:
    """One of the four places at a match: who plays there, and for which team (free-for-all: its own number)."""

    brain: str  # human, off, or a name in BRAINS
    team: int


@dataclass(frozen=True)
class Setup:
    """Everything that decides a match, but what the seats do."""

    game: str
    arena: str
    seats: tuple[Seat, Seat, Seat, Seat]
    minutes: float
    seed: int
    variant: str  # one of the game's variants


@dataclass(frozen=True)
class Row:
    """One seat in the table of results."""

    seat: int
    team: int
    place: int  # 1 is best; equal scores share a place
    score: int
    facts: Mapping[str, float]  # what the game counts, in the order of its columns


@dataclass(frozen=True)
class Outcome:
    """How a match ended: the best first."""

    rows: tuple[Row, ...]
    winners: tuple[int, ...]  # seats; all of the winning team; empty: a tie
    series: tuple[tuple[tuple[float, int], ...], ...]  # for each seat, (seconds, score) at each change
    seconds: float


@dataclass(frozen=True)
class Game:
    """The functions and words of one game. All of them but `facts` work in both bodies."""

    name: str
    state: type
    eyes: type  # the record that shapes a view
    view: type
    variants: tuple[str, ...]  # the first is the default
    minutes: tuple[int, ...]
    default_minutes: int
    columns: tuple[str, ...]  # keys of `facts`, as the table of results shows them
    start: Callable[[Any, Arena, Setup], None]  # fill a fresh state
    judge: Callable[[Any], None]  # one tick of the rules: read actions and poses, ask for speeds
    see: Callable[[Any, int, Any, Any], None]  # see(match, seat, eyes, view)
    facts: Callable[[Any, int], Mapping[str, float]]
