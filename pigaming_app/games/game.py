"""What a game is, who sits where, and how a match ended."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from pigaming_app.sim.arena import Arena, Layout
from pigaming_app.sim.toml_table import TomlTable

FREE, ALONE, PAIRS = "free", "alone", "pairs"  # teams: as people wish; none; two teams of at most two robots


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
    goal: int = 0  # laps to drive, pallets to deliver; 0 in a game without a goal


@dataclass(frozen=True)
class Row:
    """One seat in the table of results."""

    seat: int
    team: int
    place: int  # 1 is best; equals share a place
    score: int
    stats: Mapping[str, float]  # what the game counts, in the order of its columns
    records: Mapping[str, int]  # what may enter the tables of the best: points, or milliseconds
    times: tuple[float, ...]  # s for each part of the way to the goal, such as a lap


@dataclass(frozen=True)
class Outcome:
    """How a match ended: the best first."""

    rows: tuple[Row, ...]
    winners: tuple[int, ...]  # seats; all of the winning team; empty: a tie
    series: tuple[tuple[tuple[float, int], ...], ...]  # for each seat, (seconds, score) at each change
    seconds: float


@dataclass(frozen=True)
class RecordKind:
    """A table of the best. `timed`: it holds milliseconds, and less is better; else points, and more is."""

    name: str
    timed: bool = False
    by_goal: bool = False  # only those with the same goal can be compared


@dataclass(frozen=True)
class Game:
    """The functions and words of one game. `judge` and `observe` work in both bodies."""

    name: str
    state: type
    senses: type  # the record that shapes an observation
    observation: type
    variants: tuple[str, ...]  # the first is the default
    minutes: tuple[int, ...]
    default_minutes: int
    goals: tuple[int, ...]  # what may be chosen; empty: the game has no goal, only time
    default_goal: int
    team_mode: str  # FREE, ALONE or PAIRS
    teams: tuple[int, int, int, int]  # of the seats, if nobody says otherwise
    columns: tuple[str, ...]  # keys of `stats`, as the table of results shows them
    record_kinds: tuple[RecordKind, ...]
    read: Callable[[TomlTable], Layout]  # what an arena file of this game holds besides its title; raises Wrong
    start: Callable[[Any, Arena, Setup], None]  # fill a fresh state
    judge: Callable[[Any], None]  # one tick of the rules: read actions and poses, ask for speeds
    observe: Callable[[Any, int, Any, Any], None]  # observe(match, seat, senses, observation)
    ranking_key: Callable[[Any, int], float]  # of a seat, with its team: more is better, and what the order goes by
    stats: Callable[[Any, int], Mapping[str, float]]
    records: Callable[[Any, int], Mapping[str, int]]  # by the names of `record_kinds`; only those that were achieved
    times: Callable[[Any, int], tuple[float, ...]]
    goal: str = ""  # what `goals` count: laps, pallets
