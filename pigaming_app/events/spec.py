"""The data types of an event: its spec, which never changes, and the values derived from spec and journal."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date
from enum import StrEnum

from pigaming_app.events.refusals import Refused
from pigaming_app.storage.schema import Finite, Line, is_line

FEWEST, MOST = 3, 64  # entrants
SEATS = (2, 3, 4)  # entrants of a match
MAX_ROUNDS = 64
MAX_NAME = 24  # characters of an entrant or a team
MAX_TITLE = 60  # characters
MAX_SEED = 10**12
MAX_MINUTES = 3600.0  # or laps, of a match
WEEK = "week"  # stage of the matches of a ladder
WALKOVER = "walkover"  # note of an outcome without a match: the opponent has withdrawn
DEFAULT_AI = "level3"  # takes the seat of an entrant without a brain, where nobody can play


class Format(StrEnum):
    """How entrants are matched."""

    KNOCKOUT = "knockout"
    ROUND_ROBIN = "roundrobin"
    SWISS = "swiss"
    GRAND_PRIX = "grandprix"
    GROUPS = "groups"
    CHALLENGE = "challenge"
    TIME_TRIAL = "timetrial"
    HIGH_SCORE = "highscore"


class Advance(StrEnum):
    """Who wins a knock-out match: the better half (of four two, of three two, of two one), or the best quarter: one."""

    HALF = "half"
    QUARTER = "quarter"


@dataclass(frozen=True)
class Entrant:
    """A person (`brain` is empty) or an AI. `brain`: a registered name, or the path of a file."""

    name: Line
    brain: Line = ""
    team: Line = ""


@dataclass(frozen=True)
class EventSpec:
    """Everything that is decided before the first match. Entrants stand in the order of their seeding, best first.

    `rounds`: of a Swiss or a Grand Prix; of a round robin or of groups, how often everybody meets everybody; weeks of a
    challenge ladder; most tries of everybody in a time trial or for a high score; 0: the default of the format. A
    knock-out ends with its final, whatever the number. Round n is of game n, again from the first after the last.
    `arenas`, `minutes` and `variants` are by game; what is missing, empty or 0 is the game's default. Several arenas of
    a game take turns in its rounds, as games do. `fill`: the AI on seats that would stay empty; empty: they stay empty.
    `reach`: how many places up a challenge may go. `start`: first day of a ladder, YYYY-MM-DD, from which its weeks
    count; empty: they are closed by hand.
    """

    title: Line
    format: Format
    games: tuple[Line, ...]
    entrants: tuple[Entrant, ...]
    rounds: int = 0
    seats: int = 2
    arenas: Mapping[Line, tuple[Line, ...]] = field(default_factory=dict)
    minutes: Mapping[Line, Finite] = field(default_factory=dict)
    variants: Mapping[Line, Line] = field(default_factory=dict)
    seed: int = 1
    advance: Advance = Advance.HALF
    fill: Line = ""
    reach: int = 3
    start: Line = ""

    def game_of(self, round_number: int) -> str:
        """The game of a round, from 1."""
        return self.games[(round_number - 1) % len(self.games)]

    def arena_of(self, round_number: int) -> str:
        """The arena of a round, from 1; empty: the game's default."""
        game = self.game_of(round_number)
        before = sum(self.game_of(number) == game for number in range(1, round_number))
        arenas = self.arenas.get(game) or ("",)
        return arenas[before % len(arenas)]


@dataclass(frozen=True)
class Fixture:
    """A match of the event. `entrants`: names in the order of the seats; `fill`: seats behind them that AIs take."""

    number: int  # from 1
    round: int  # from 1
    stage: (
        str  # "", or as the format has it: "winners", "losers", "final"; "group A", "knockout", "last"; "week"; "try"
    )
    game: str
    arena: str  # empty: the game's default
    entrants: tuple[str, ...]
    seed: int
    fill: int = 0
    extra: int = 0  # number of an extra match of those who are tied, from 1; 0: the match itself


@dataclass(frozen=True)
class Result:
    """Result of a fixture. `places`: the entrants of each place, best first; equal ones together, sorted by name."""

    fixture: int
    places: tuple[tuple[Line, ...], ...]
    scores: Mapping[Line, Finite] = field(default_factory=dict)
    note: Line = ""
    extra: int = 0  # see Fixture


@dataclass(frozen=True)
class Standing:
    """One row of the table. `tie_breaks`: by name, in the order in which they count; `place`: equal rows share one."""

    place: int
    entrant: str
    points: float
    wins: int
    played: int
    tie_breaks: Mapping[str, float]


@dataclass(frozen=True)
class Round:
    """A drawn round: its fixtures, and the entrants who have a bye."""

    number: int
    fixtures: tuple[Fixture, ...]
    byes: tuple[str, ...] = ()


class NameRefused(Refused):
    """A name is empty, too long or unprintable."""


def check_name(name: str, refusal: str = "bad_name") -> None:
    """Raises NameRefused, with this key, unless this can be the name of an entrant, a team or an arcade."""
    if not 0 < len(name) <= MAX_NAME or not is_line(name) or name != name.strip():
        raise NameRefused(refusal, name=repr(name[:40]), most=MAX_NAME)


def check_spec(spec: EventSpec) -> None:
    """Raises ValueError, with one sentence, for a spec that cannot be played."""
    count = len(spec.entrants)
    if not FEWEST <= count <= MOST:
        raise ValueError(f"an event has {FEWEST} to {MOST} entrants, not {count}")
    names = [entrant.name for entrant in spec.entrants]
    for entrant in spec.entrants:
        check_name(entrant.name)
        if entrant.team:
            check_name(entrant.team, "bad_team")
        if names.count(entrant.name) > 1:
            raise ValueError(f"{entrant.name} is entered twice")
    if not spec.games:
        raise ValueError("an event needs a game")
    if any(len(arenas) > MAX_ROUNDS for arenas in spec.arenas.values()):
        raise ValueError(f"at most {MAX_ROUNDS} arenas of a game take turns")
    if not 0 <= spec.rounds <= MAX_ROUNDS:
        raise ValueError(f"an event has at most {MAX_ROUNDS} rounds, not {spec.rounds}")
    if not all(0.0 <= minutes <= MAX_MINUTES for minutes in spec.minutes.values()):
        raise ValueError(f"a match has at most {MAX_MINUTES:.0f} minutes")
    if not 1 <= spec.reach < MOST:
        raise ValueError(f"a challenge goes 1 to {MOST - 1} places up, not {spec.reach}")
    if spec.start:
        date.fromisoformat(spec.start)
    if not 0 <= spec.seed <= MAX_SEED:
        raise ValueError(f"a seed is a number from 0 to {MAX_SEED}, not {spec.seed}")
    if not 0 < len(spec.title) <= MAX_TITLE or not is_line(spec.title):
        raise ValueError(f"a title has 1 to {MAX_TITLE} printable characters")
