"""The Ladder: one person against one robot, from level 1 to level 5.

On each rung stands a robot, one level stronger than the one below. Two wins of three matches lead to the next rung;
whoever loses twice tries the same rung again. In a climb through all games, each match is of another game.

After two clear losses in a row the robots can be made a little easier: from then on each is one level weaker, and so
counts for one star less. A climb is worth the strongest robot that was beaten, one star for each level; among equal
climbs the one with fewer lost matches is better, then the earlier one.
"""

from dataclasses import dataclass, replace
from typing import Annotated

from msgspec import Meta

from pigaming_app.games.arenas import shipped_arenas
from pigaming_app.games.game import LadderMatches, Outcome, Seat, Setup, Variant
from pigaming_app.games.registry import games
from pigaming_app.storage.plugins.parts import hidden
from pigaming_app.storage.schema import Line, between
from pigaming_app.storage.scores import ScoreTable

LEVELS = 5  # rungs, and levels of robots
NEEDED = 2  # wins of three matches
OFFER_AFTER = 2  # clear losses in a row
ALL = "all"  # a climb through all games
MOST_LOST = 999  # lost matches that count
RULES = "party"  # short matches, and an overtime instead of a tie


@dataclass(frozen=True)
class Climb:
    """The state of a climb between two matches. `game`: of every match, or ALL."""

    game: Line
    rung: Annotated[int, between(1, LEVELS + 1)] = 1  # 1 to LEVELS; LEVELS + 1: at the top
    eased: tuple[int, ...] = ()  # rungs from which on robots are one level weaker, in the order of choice
    wins: Annotated[int, Meta(ge=0, lt=NEEDED)] = 0  # on this rung, and losses
    losses: Annotated[int, Meta(ge=0, lt=NEEDED)] = 0
    clear: Annotated[int, between(0, MOST_LOST)] = 0  # clear losses in a row, since the last offer
    beaten: Annotated[int, between(0, LEVELS)] = 0  # level of the strongest robot beaten
    lost: Annotated[int, between(0, 10 * MOST_LOST)] = 0  # lost matches of the whole climb

    @property
    def level(self) -> int:
        """Level of the robot on this rung."""
        return self.level_on(self.rung)

    def level_on(self, rung: int) -> int:
        """Level of the robot on a rung."""
        return rung - sum(start <= rung for start in self.eased)

    @property
    def at_top(self) -> bool:
        """True once the last rung is passed."""
        return self.rung > LEVELS

    @property
    def next_game(self) -> str:
        """Game of the next match. In a climb through all games a loss counts two, so that no game follows itself."""
        if self.game != ALL:
            return self.game
        names = climbed_games()
        return names[(NEEDED * (self.rung - 1) + self.wins + 2 * self.lost) % len(names)]

    @property
    def offers_easier(self) -> bool:
        """True if weaker robots may be offered: after clear losses, unless the robot is already the weakest."""
        return self.clear >= OFFER_AFTER and self.level > 1

    def made_easier(self) -> "Climb":
        """The climb with robots one level weaker from here on; the matches on this rung begin anew."""
        return replace(self, eased=(*self.eased, self.rung), wins=0, losses=0, clear=0)

    def kept_hard(self) -> "Climb":
        """The climb after weaker robots have been declined."""
        return replace(self, clear=0)

    def after(self, outcome: Outcome) -> "Climb":
        """The climb after the person's match on seat 0. A tie changes nothing."""
        if not outcome.winners:
            return self
        if 0 not in outcome.winners:
            return self.after_loss(is_clear_loss(self.next_game, outcome))
        if self.wins + 1 < NEEDED:
            return replace(self, wins=self.wins + 1, clear=0)
        return replace(self, rung=self.rung + 1, wins=0, losses=0, clear=0, beaten=max(self.beaten, self.level))

    def after_loss(self, clear: bool) -> "Climb":
        """The climb after a lost match; after NEEDED of them the matches on this rung begin anew."""
        again = self.losses + 1 == NEEDED
        return replace(
            self,
            wins=0 if again else self.wins,
            losses=0 if again else self.losses + 1,
            clear=self.clear + 1 if clear else 0,
            lost=self.lost + 1,
        )

    def setup(self, seed: int) -> Setup:
        """The next match: the person on seat 0, the robot on seat 1."""
        game, level = self.next_game, f"level{self.level}"
        rules, form = rules_of(game), matches_of(game)
        one, two, three, four = (
            Seat(driver, team) for driver, team in zip(("human", level, "off", "off"), rules.teams, strict=True)
        )
        arena = form.arenas[(self.rung - 1) % len(form.arenas)]
        return Setup(game, arena, (one, two, three, four), form.minutes, seed, rules.name, form.goal)


def climbed_games() -> list[str]:
    """The games that have a ladder."""
    return [name for name, game in games().items() if game.ladder and name not in hidden()]


def rules_of(game: str) -> Variant:
    """The rule set of a game's ladder. Raises ValueError if it has none."""
    opposed = [variant for variant in games()[game].variants.values() if variant.teams[0] != variant.teams[1]]
    return min(opposed, key=lambda variant: variant.name != RULES)


def matches_of(game: str) -> LadderMatches:
    """The matches of a game's ladder. Raises ValueError if it has none."""
    own, rules = games()[game].ladder, rules_of(game)
    if not own:
        raise ValueError(f"{game} has no ladder")
    return LadderMatches(
        own.minutes or min(rules.minutes),
        own.goal or rules.default_goal,
        own.arenas or tuple(shipped_arenas(game)),
        own.clear,
    )


def is_clear_loss(game: str, outcome: Outcome) -> bool:
    """True if seat 0 lost by at least the `clear` of the matches, or has not finished a race that another has."""
    own, best = next(row for row in outcome.rows if row.seat == 0), outcome.rows[0]
    clear, timed = matches_of(game).clear, games()[game].timed
    mine, theirs = (own.stats.get("total", 0.0), best.stats.get("total", 0.0)) if timed else (own.score, best.score)
    return (timed and not mine) or abs(mine - theirs) >= (clear or theirs / 2)


def table_of(game: str) -> ScoreTable:
    """The table of all climbs of a game, or of ALL."""
    return ScoreTable("ladder", game, "climb", rules=RULES, people=1)


def worth(climb: Climb) -> int:
    """A climb as a score: more for a stronger robot, then for fewer lost matches; 0 if none was beaten."""
    return (MOST_LOST + 1) * climb.beaten - min(MOST_LOST, climb.lost) if climb.beaten else 0


def stars_and_losses(score: int) -> tuple[int, int]:
    """Level of the strongest robot beaten, and lost matches, from a score."""
    level = min(LEVELS, max(1, -(-score // (MOST_LOST + 1))))
    return level, max(0, level * (MOST_LOST + 1) - score)
