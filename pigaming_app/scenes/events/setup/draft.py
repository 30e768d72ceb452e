"""A new event while it is set up: what can be chosen for it, and its entrants."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import date
from itertools import permutations

from pigaming_app.events.formats.field import FormatKind
from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.match_setup import time_record
from pigaming_app.events.spec import DEFAULT_AI, Entrant, EventSpec, Format
from pigaming_app.games.game import Variant
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.match_choice import first_arena
from pigaming_app.scenes.views.registry import shown_games

BY_TURNS = "turns"  # another game in every round
MOST_ORDERED = 5  # games of which all orders are offered
LENGTHS = ("short", "normal", "long")
RULES = "party"  # short matches, and an overtime instead of a tie
TIMES = (1, 2, 3)  # how often a Grand Prix plays each game


@dataclass
class Draft:
    """What has been chosen so far. `game`: one, or BY_TURNS; `order`: of several games; `chosen`: arenas by game,
    in the order of their turns; `length`: one of LENGTHS; `fill`: true if AIs take the seats that would stay empty.
    """

    format: Format = Format.KNOCKOUT
    game: str = ""
    order: tuple[str, ...] = ()
    length: str = "normal"
    rounds: int = 0
    seats: int = 2
    fill: bool = True
    entrants: list[Entrant] = field(default_factory=list)
    chosen: dict[str, tuple[str, ...]] = field(default_factory=dict)
    classes: dict[str, str] = field(default_factory=dict)  # by name, of a list that has them

    def __post_init__(self) -> None:
        names = tuple(shown_games())
        self.game, self.order = self.game or names[0], self.order or names

    @property
    def games(self) -> tuple[str, ...]:
        """The games that are played, in their order."""
        return self.order if self.kind.series or self.game == BY_TURNS else (self.game,)

    @property
    def kind(self) -> FormatKind:
        """The format."""
        return KINDS[self.format]

    def arenas(self, game: str) -> tuple[str, ...]:
        """The arenas of a game, in the order of their turns; at least one."""
        found = self.chosen.get(game) or (first_arena(game),)
        return found[:1] if self.kind.single else found

    def toggle_arena(self, game: str, arena: str) -> bool:
        """Add an arena behind the others of a game, or leave it out; false for the only one."""
        now = self.arenas(game)
        if self.kind.single:
            self.chosen[game] = (arena,)
            return True
        left = tuple(other for other in now if other != arena) if arena in now else (*now, arena)
        if left:
            self.chosen[game] = left
        return bool(left)

    @property
    def rows(self) -> tuple[str, ...]:
        """The rows that offer a choice."""
        kind = self.kind
        rows = (
            "format",
            *(() if kind.series else ("game",)),
            *(("order",) if len(self.games) > 1 else ()),
            "length",
            "seats",
            "rounds",
            *(("fill",) if kind.fills and not kind.single else ()),
        )
        return tuple(row for row in rows if len(self.options(row)) > 1)

    def options(self, row: str) -> tuple[object, ...]:
        """The choices of a row."""
        if row == "format":
            return tuple(Format)
        if row == "game":
            names = [name for name in shown_games() if not self.kind.timed or time_record(name, variant_of(name))]
            return (*names, *(() if self.kind.single else (BY_TURNS,)))
        if row == "order":
            return _orders(shown_games())
        if row == "length":
            return LENGTHS if any(len(variant_of(game).minutes) > 1 for game in self.games) else ("normal",)
        if row == "rounds":
            return tuple(n * len(self.games) for n in TIMES) if self.kind.series else tuple(sorted(self.kind.rounds))
        if row == "seats":
            alone = all(time_record(game, variant_of(game)) for game in self.games)  # only against the clock
            return tuple(count for count in sorted(self.kind.seats) if count > 1 or alone)
        return (False, True)

    def choose(self, row: str, option: object) -> None:
        """Choose an option of a row; other rows follow where they have to."""
        setattr(self, row, option)
        if row == "format":
            self.seats = self.kind.seats[0]
        for other in ("game", "length", "seats", "rounds"):
            choices = self.options(other)
            if getattr(self, other) not in choices:
                usual = {"length": "normal", "seats": self.kind.seats[0], "rounds": self.kind.rounds[0]}.get(other)
                setattr(self, other, usual if usual in choices else choices[0])

    def minutes(self, game: str) -> float:
        """Minutes of a match of a game; 0: its default."""
        offered = variant_of(game).minutes
        if self.length == "normal" or len(offered) == 1:
            return 0.0
        return float(offered[0] if self.length == "short" else offered[-1])

    def spec(self, title: str, seed: int) -> EventSpec:
        """The event as it was chosen."""
        kind, rounds = self.kind, self.rounds
        if self.format is Format.SWISS and self.seats == 2:
            rounds = min(rounds, len(self.entrants) - 1)  # nobody meets anybody again
        return EventSpec(
            title=title,
            format=self.format,
            games=self.games,
            entrants=tuple(self.entrants),
            rounds=rounds,
            seats=self.seats,
            arenas={game: self.arenas(game) for game in self.games},
            minutes={game: minutes for game in self.games if (minutes := self.minutes(game))},
            variants={game: RULES for game in self.games if RULES in games()[game].variants},
            seed=seed,
            fill=DEFAULT_AI if (self.seats > 1 if kind.single else kind.fills and self.fill) else "",
            start=date.today().isoformat() if self.format is Format.CHALLENGE else "",
        )


def _orders(names: Sequence[str]) -> tuple[tuple[str, ...], ...]:
    """All orders of a few games; of more of them, those that begin with another one."""
    if len(names) <= MOST_ORDERED:
        return tuple(permutations(names))
    return tuple((*names[i:], *names[:i]) for i in range(len(names)))


def variant_of(game: str) -> Variant:
    """The rule set of events in a game."""
    rules = games()[game]
    return rules.variants.get(RULES, rules.default)
