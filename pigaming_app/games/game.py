"""Interface of a game, setup of a match, and its outcome."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Annotated, Any

from msgspec import Meta

from pigaming_app.games import simple
from pigaming_app.sim.arena import Arena, Layout
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.schema import between

FREE, ALONE, PAIRS, ALLIES = "free", "alone", "pairs", "allies"
"""Team modes: free choice; none; two teams of at most two robots; all robots in one team."""


@dataclass(frozen=True)
class Seat:
    """One of the four seats of a match: its player and its team (free-for-all: the seat's own number)."""

    brain: str  # human, off, the name of a registered brain, or the path of its file
    team: Annotated[int, between(0, ROBOTS - 1)]


@dataclass(frozen=True)
class Setup:
    """Everything that determines a match, except the actions of the seats."""

    game: str
    arena: str
    seats: tuple[Seat, Seat, Seat, Seat]
    minutes: Annotated[float, Meta(gt=0.0, le=60.0)]
    seed: int
    variant: str  # one of the game's variants
    goal: int = 0  # laps to drive, pallets to deliver; 0 in a game without a goal
    sudden_death: bool = False  # it is over as soon as one team has more points than all others, or a lap


@dataclass(frozen=True)
class Row:
    """One seat in the results table."""

    seat: int
    team: int
    place: int  # 1 is best; ties share a place
    score: int
    stats: Mapping[str, float]  # the game's statistics, in the order of its columns
    records: Mapping[str, int]  # candidates for the high scores: points, or milliseconds
    times: tuple[float, ...]  # s for each stage towards the goal, such as a lap


@dataclass(frozen=True)
class Outcome:
    """Final standings of a match, best first."""

    rows: tuple[Row, ...]
    winners: tuple[int, ...]  # all seats of the winning team; empty: a tie, or allies that have not won
    series: tuple[tuple[tuple[float, int], ...], ...]  # for each seat, (seconds, score) at each change
    seconds: float


@dataclass(frozen=True)
class RecordKind:
    """A high-score table. `timed`: milliseconds, lower is better; else points, higher is better."""

    name: str
    timed: bool = False
    by_goal: bool = False  # one table for each goal, since only equal goals are comparable


@dataclass(frozen=True)
class Variant:
    """One rule set of a game, with the choices that it offers."""

    name: str
    minutes: tuple[int, ...]
    default_minutes: int
    goals: tuple[int, ...] = ()  # the choices; empty: the variant has no goal, only a time limit
    default_goal: int = 0
    team_mode: str = FREE  # free (choice), alone, pairs (two teams of at most two), allies (all in one team)
    teams: tuple[int, int, int, int] = (0, 1, 2, 3)  # default team of each seat
    overtime: float = 0.0  # s, by which a level match may exceed its minutes
    columns: tuple[str, ...] = ()  # of the results table; empty: those of the game
    achievements: tuple[str, ...] = ()  # names of its high-score tables; empty: all of the game

    def __post_init__(self) -> None:
        if self.team_mode not in (FREE, ALONE, PAIRS, ALLIES):
            raise ValueError(f"{self.name}: {self.team_mode} is no team mode; there are free, alone, pairs and allies")

    @staticmethod
    def by_name(*variants: "Variant") -> Mapping[str, "Variant"]:
        """Variants for `Game.variants`; the first is the default."""
        return {variant.name: variant for variant in variants}


@dataclass(frozen=True)
class LadderMatches:
    """The matches of a ladder: one against one, by the rules `party` or the first ones that set seats 0 and 1 apart."""

    minutes: float = 0.0  # 0: the fewest of these rules
    goal: int = 0  # 0: their default
    arenas: tuple[str, ...] = ()  # of the rungs, in turn; empty: all that come with the game
    clear: float = 0.0  # points, or s in a timed game, by which a loss is clear; 0: half of the winner's


Reroute = Callable[[Arena, Any, tuple[ThingSpec, ...]], Callable[[Any], None]]
"""reroute(arena, rules, things), once things have moved: the slow part of a new plan, for any thread. Its result is to
be called with the match, between two ticks. Raises FieldError if robots cannot pass the things."""


@dataclass(frozen=True, kw_only=True)
class Game:
    """The functions and properties of one game. `judge` and `observe` are kernels: they run plain and compiled.

    The defaults are those of a simple game: walls, robots, points.
    """

    name: str
    state: type
    variants: Mapping[str, Variant]  # by name; the first is the default
    start: Callable[[Any, Arena, Setup], None]  # fill a fresh state
    judge: Callable[[Any], None]  # one tick of the rules: read actions and poses, request speeds
    rules: Callable[[Setup], Any] = simple.rules_of  # the rule record of a match
    senses: type = simple.Senses  # record with the parameters of an observation
    observation: type = simple.Observation
    observe: Callable[[Any, int, Any, Any], None] = simple.observe  # observe(match, seat, senses, observation)
    arena: str = "classic"  # the default one
    read: Callable[[TomlTable], Layout] = simple.read  # parse an arena file, except its title; raises FieldError
    faults: Callable[[TomlTable], Iterable[FieldError]] | None = None  # where `read` is slow or ends at the first
    ranking_key: Callable[[Any, int], float] = simple.team_points  # of a seat, with its team; allies win above 0
    columns: tuple[str, ...] = ()  # keys of `stats`, in the order of the results table
    stats: Callable[[Any, int], Mapping[str, float]] = simple.no_stats
    record_kinds: tuple[RecordKind, ...] = (RecordKind("points"),)
    records: Callable[[Any, int], Mapping[str, int]] = simple.own_points  # by `record_kinds`; only those achieved
    times: Callable[[Any, int], tuple[float, ...]] = simple.no_times
    goal: str = ""  # unit of `goals`: laps, pallets
    goal_of: Callable[[TomlTable], int] | None = None  # the default one of a match in an arena; 0: that of the variant
    rounds: tuple[int, ...] = (1,)  # the choices: the number of rounds of which most decide a match
    round_minutes: int = 1  # length of a round
    surprise: Callable[[int], str] | None = None  # the text of an arena file, from a seed
    reroute: Reroute | None = None  # for AIs that do not plan from the walls alone
    timed: bool = False  # the fastest wins: the clock counts up, and results compare the stages' times
    scored: bool = True  # the results table begins with the score
    ladder: LadderMatches | None = None  # for a game whose five levels differ

    def records_of(self, variant: str) -> tuple[RecordKind, ...]:
        """The high-score tables of a variant; of an unknown one, those of the default."""
        achievements = self.variants.get(variant, self.default).achievements
        return tuple(kind for kind in self.record_kinds if not achievements or kind.name in achievements)

    @property
    def default(self) -> Variant:
        """The variant that is played unless another one is chosen."""
        return next(iter(self.variants.values()))
