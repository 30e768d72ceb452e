"""High-score rules: the table of each achievement, the matches that count, the format of values.

A table covers one arena, one set of rules, one duration (minutes, laps or pallets) and one number of people. A match
counts for a seat only if every opponent is a person or an AI at least as strong as level 3; allies have no opponents.
"""

from dataclasses import dataclass, replace

from pigaming_app.ai.registry import level_of
from pigaming_app.games.arenas import score_name
from pigaming_app.games.game import ALLIES, RecordKind, Setup
from pigaming_app.games.registry import games
from pigaming_app.storage.scores import Scores, ScoreTable
from pigaming_app.ui.numbers import numeral

NONE = "–"
STRONG_LEVEL = 3  # the weakest level that counts
STRONG = frozenset({"hand2", "hand3", "net", "q1", "q2"})
"""Other AIs no weaker than `hand2`. Of 200 matches of `duel pitanks NAME hand2 --matches 200` under
`pickups`, `hand3` wins 161 and loses 26, q1 187 and 9, q2 109 and 79; `hand1` wins 1, `fsm` 41 (and loses 125) and
`classic` none."""


@dataclass(frozen=True)
class HighScoreTable:
    """A table on display. `heading`: its text key; `days`: restricted to the last days; None: all time."""

    heading: str
    table: ScoreTable
    days: int | None = None


def counts(setup: Setup, seat: int) -> bool:
    """True if a seat's results in this match can enter a table."""
    own = setup.seats[seat]
    if games()[setup.game].variants[setup.variant].team_mode == ALLIES:
        return True
    opponents = [other.brain for other in setup.seats if other.brain != "off" and other.team != own.team]
    return bool(opponents) and all(
        brain == "human" or brain in STRONG or level_of(brain) >= STRONG_LEVEL for brain in opponents
    )


def contest(setup: Setup, seat: int | None = None) -> ScoreTable:
    """The conditions of a match for a seat, or for the first person's: a table without a achievement."""
    people = [i for i, other in enumerate(setup.seats) if other.brain == "human"]
    own = setup.seats[seat if seat is not None else people[0] if people else 0]
    mates = [other for other in setup.seats if other.brain != "off" and other.team == own.team]
    side = sum(other.brain == "human" for other in mates) if len(mates) > 1 else 0
    length = setup.goal if games()[setup.game].variants[setup.variant].goals else setup.minutes
    arena = score_name(setup.game, setup.arena)
    return ScoreTable(setup.game, arena, "", False, setup.variant, length, max(1, len(people)), side)


def table_of(contest: ScoreTable, achievement: RecordKind) -> ScoreTable:
    """The table of a achievement under the conditions of a contest."""
    return replace(contest, achievement=achievement.name, timed=achievement.timed)


def high_score_tables(contest: ScoreTable) -> list[HighScoreTable]:
    """The two tables shown side by side: one per achievement; of a single one, today and all time."""
    achievements = games()[contest.game].records_of(contest.rules)
    tables = [table_of(contest, achievement) for achievement in achievements]
    if len(achievements) > 1:
        return [HighScoreTable(f"results.best_{table.achievement}", table) for table in tables[:2]]
    return [HighScoreTable("results.today", tables[0], 1), HighScoreTable("results.ever", tables[0])]


def contests(scores: Scores) -> list[ScoreTable]:
    """The contests with displayable rows, by game and arena."""
    known = {replace(table, achievement="", timed=False) for table in scores.tables() if _is_known(table)}
    names = list(games())
    return sorted(known, key=lambda c: (names.index(c.game), c.arena != games()[c.game].arena, c.arena, c))


def format_score(value: int, achievement: RecordKind | ScoreTable) -> str:
    """Points, or milliseconds as minutes and seconds."""
    return clock(value / 1000.0) if achievement.timed else numeral(value)


def clock(seconds: float) -> str:
    """Seconds as minutes and seconds to the hundredth; 0 means no time."""
    if seconds <= 0.0:
        return NONE
    hundredths = round(100 * seconds)
    minutes, rest = divmod(hundredths, 6000)
    return f"{minutes}:{rest // 100:02}.{rest % 100:02}" if minutes else f"{rest // 100}.{rest % 100:02}"


def _is_known(table: ScoreTable) -> bool:
    """True if game, achievement and rules exist; the file may contain anything."""
    game = games().get(table.game)
    if not game or not any(
        (achievement.name, achievement.timed) == (table.achievement, table.timed) for achievement in game.record_kinds
    ):
        return False
    return table.rules in game.variants and 0 < table.people <= 4 and table.side <= table.people
