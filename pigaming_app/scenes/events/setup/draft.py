"""A new event while it is set up: what can be chosen for it, and its entrants."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import permutations

from pigaming_app.events.spec import DEFAULT_AI, SEATS, Entrant, EventSpec, Format
from pigaming_app.games.game import Variant
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.match_choice import first_arena
from pigaming_app.scenes.views.registry import shown_games

BY_TURNS = "turns"  # another game in every round
MOST_ORDERED = 5  # games of which all orders are offered
LENGTHS = ("short", "normal", "long")
RULES = "party"  # short matches, and an overtime instead of a tie
ROUNDS = {
    Format.KNOCKOUT: (1,),
    Format.ROUND_ROBIN: (1, 2),
    Format.SWISS: (3, 4, 5, 6, 7, 8, 9),
}
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
    rounds: int = 1
    seats: int = 2
    fill: bool = True
    entrants: list[Entrant] = field(default_factory=list)
    chosen: dict[str, tuple[str, ...]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        names = tuple(shown_games())
        self.game, self.order = self.game or names[0], self.order or names

    @property
    def games(self) -> tuple[str, ...]:
        """The games that are played, in their order."""
        return self.order if self.format is Format.GRAND_PRIX or self.game == BY_TURNS else (self.game,)

    def arenas(self, game: str) -> tuple[str, ...]:
        """The arenas of a game, in the order of their turns; at least one."""
        return self.chosen.get(game) or (first_arena(game),)

    def toggle_arena(self, game: str, arena: str) -> bool:
        """Add an arena behind the others of a game, or leave it out; false for the only one."""
        now = self.arenas(game)
        left = tuple(other for other in now if other != arena) if arena in now else (*now, arena)
        if left:
            self.chosen[game] = left
        return bool(left)

    @property
    def rows(self) -> tuple[str, ...]:
        """The rows that offer a choice."""
        prix = self.format is Format.GRAND_PRIX
        rows = (
            "format",
            *(() if prix else ("game",)),
            *(("order",) if len(self.games) > 1 else ()),
            "length",
            "seats",
            "rounds",
            *(("fill",) if prix else ()),
        )
        return tuple(row for row in rows if len(self.options(row)) > 1)

    def options(self, row: str) -> tuple[object, ...]:
        """The choices of a row."""
        if row == "format":
            return tuple(Format)
        if row == "game":
            return (*shown_games(), BY_TURNS)
        if row == "order":
            return _orders(shown_games())
        if row == "length":
            return LENGTHS if any(len(variant_of(game).minutes) > 1 for game in self.games) else ("normal",)
        if row == "rounds":
            prix = self.format is Format.GRAND_PRIX
            return tuple(n * len(self.games) for n in TIMES) if prix else ROUNDS[self.format]
        return SEATS if row == "seats" else (False, True)

    def choose(self, row: str, option: object) -> None:
        """Choose an option of a row; other rows follow where they have to."""
        setattr(self, row, option)
        if row == "format":
            self.seats = 4 if self.format is Format.GRAND_PRIX else 2
        for other in ("length", "rounds"):
            choices = self.options(other)
            if getattr(self, other) not in choices:
                setattr(self, other, "normal" if other == "length" else choices[0])

    def minutes(self, game: str) -> float:
        """Minutes of a match of a game; 0: its default."""
        offered = variant_of(game).minutes
        if self.length == "normal" or len(offered) == 1:
            return 0.0
        return float(offered[0] if self.length == "short" else offered[-1])

    def spec(self, title: str, seed: int) -> EventSpec:
        """The event as it was chosen."""
        prix, rounds = self.format is Format.GRAND_PRIX, self.rounds
        if self.format is Format.SWISS and self.seats == 2:
            rounds = min(rounds, len(self.entrants) - 1)  # nobody meets anybody again
        return EventSpec(
            title=title,
            format=self.format,
            games=self.games,
            entrants=tuple(self.entrants),
            rounds=0 if self.format is Format.KNOCKOUT else rounds,
            seats=self.seats,
            arenas={game: self.arenas(game) for game in self.games},
            minutes={game: minutes for game in self.games if (minutes := self.minutes(game))},
            variants={game: RULES for game in self.games if RULES in games()[game].variants},
            seed=seed,
            fill=DEFAULT_AI if prix and self.fill else "",
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
