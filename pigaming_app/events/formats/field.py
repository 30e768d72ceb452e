"""A format: what its draws may look at and decide, and the functions that each one supplies."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations

from pigaming_app.events.spec import SEATS, EventSpec, Fixture, Result, Round, Standing

Pair = frozenset[str]


@dataclass(frozen=True)
class EntrantField:
    """The event so far. `entrants`: all by their seeding, late ones last; `outcomes`: by fixture, with walkovers."""

    spec: EventSpec
    entrants: tuple[str, ...]
    late: frozenset[str]  # entrants since the first round
    withdrawn: frozenset[str]
    rounds: tuple[Round, ...]
    outcomes: Mapping[int, Result]
    closed: int = 0  # periods of a format on call, see `OnCall`
    joined: Mapping[str, int] = field(default_factory=dict)  # periods that were closed before somebody entered late
    left: Mapping[str, int] = field(default_factory=dict)  # round that was open as somebody withdrew

    @property
    def complete(self) -> bool:
        """True if every match that is drawn has a result."""
        return all(one.number in self.outcomes for drawn in self.rounds for one in drawn.fixtures)

    @property
    def busy(self) -> frozenset[str]:
        """Those in a match that is open."""
        matches = (one for drawn in self.rounds for one in drawn.fixtures if one.number not in self.outcomes)
        return frozenset(name for one in matches for name in one.entrants)

    @property
    def present(self) -> tuple[str, ...]:
        """Everybody who has not withdrawn."""
        return tuple(name for name in self.entrants if name not in self.withdrawn)

    def meetings(self) -> dict[Pair, int]:
        """How often each two have met, or were drawn to meet."""
        return meetings(group for drawn in self.rounds for group in (one.entrants for one in drawn.fixtures))

    def byes(self) -> dict[str, int]:
        """The byes of each entrant."""
        found = dict.fromkeys(self.entrants, 0)
        for drawn in self.rounds:
            for name in drawn.byes:
                found[name] += 1
        return found


@dataclass(frozen=True)
class MatchUp:
    """A match that is drawn: its entrants, in the order of the seats if `seated`."""

    entrants: tuple[str, ...]
    stage: str = ""
    seated: bool = False


@dataclass(frozen=True)
class Draw:
    """The matches of one round, in order of play, and the byes."""

    matches: tuple[MatchUp, ...]
    byes: tuple[str, ...] = ()


def nobody(spec: EventSpec, fixture: Fixture) -> int:
    """A match that decides about no other one."""
    return 0


def no_stages(spec: EventSpec) -> frozenset[str]:
    """A format without a bracket."""
    return frozenset()


def unknown(spec: EventSpec, count: int) -> int:
    """Matches of a format that draws all of them at once."""
    return 0


def nothing(field: EntrantField) -> Mapping[str, tuple[Standing, ...]]:
    """No tables of parts."""
    return {}


def no_one(field: EntrantField) -> frozenset[str]:
    """A table that decides nothing."""
    return frozenset()


def unchecked(spec: EventSpec) -> None:
    """Whatever `check_spec` permits."""


@dataclass(frozen=True, kw_only=True)
class FormatKind:
    """A format as data and functions; formats/registry.py has one for each `Format`.

    `draws`: the rounds that can be drawn now; `table`: everybody, best first; `wins`: how many go on from a match, 0 if
    that decides nothing, so that it may be tied; `check` raises ValueError for a spec that the format cannot play.
    `qualified`: who goes on by the table, once the matches that follow from it are drawn; else nobody.
    """

    draws: Callable[[EntrantField], Sequence[Draw]]
    table: Callable[[EntrantField], tuple[Standing, ...]]
    parts: Callable[[EntrantField], Mapping[str, tuple[Standing, ...]]] = nothing  # tables of groups, by name
    wins: Callable[[EventSpec, Fixture], int] = nobody
    qualified: Callable[[EntrantField], frozenset[str]] = no_one
    check: Callable[[EventSpec], None] = unchecked
    follows_results: bool = True  # rounds that have not begun are drawn anew after a correction
    follows_withdrawals: bool = True
    exchanges: bool = True  # two entrants can exchange their places in a round
    matches: Callable[[EventSpec, int], int] = unknown  # of so many entrants, where they are not drawn yet; roughly
    seats: tuple[int, ...] = SEATS  # of a match; the first one is the default
    rounds: tuple[int, ...] = (0,)  # choices of the arcade; 0: the default
    fills: bool = False  # AIs may take empty seats
    timed: bool = False  # times count, the shortest is best
    single: bool = False  # of one game in one arena
    series: bool = False  # all games by turns, so many times
    figures: tuple[str, ...] = ("points", "wins", "played")  # of a table, the most important one first
    sides: Mapping[str, tuple[str, ...]] = field(default_factory=dict)  # stages of each side of a bracket, by its name
    bound: Callable[[EventSpec], frozenset[str]] = no_stages  # stages whose matches to come follow from the bracket
    on_call: "OnCall | None" = None  # its matches are arranged by those who play


@dataclass(frozen=True, kw_only=True)
class OnCall:
    """A format without a draw: who wants to play arranges a match, until the last period is closed by hand.

    `check` raises ValueError if these entrants cannot play a match now; `next`: whom an event of AIs would let play,
    None if a period is over; `periods`: how many there are.
    """

    stage: str  # of its matches
    check: Callable[[EntrantField, tuple[str, ...]], None]
    next: Callable[[EntrantField], tuple[str, ...] | None]
    periods: Callable[[EventSpec], int]


def meetings(groups: Iterator[tuple[str, ...]]) -> dict[Pair, int]:
    """How often each two are in one group."""
    found: dict[Pair, int] = {}
    for group in groups:
        for pair in combinations(group, 2):
            found[frozenset(pair)] = found.get(frozenset(pair), 0) + 1
    return found
