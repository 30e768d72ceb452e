"""Which table of scores a feat belongs to, which matches count, and how values are written.

A table compares feats of one arena under the same rules, over the same minutes, laps or pallets, and with the same
number of people. A match counts for a seat only if every opponent is a person or an AI that is no weaker than `normal`.
"""

from dataclasses import dataclass, replace

from pigaming_app.games import GAMES
from pigaming_app.games.game import Feat, Setup
from pigaming_app.storage.scores import Scores, Table

NONE = "–"
STRONG = frozenset({"normal", "hard", "fsm", "q1", "q2"})
"""AIs no weaker than `normal`. `duel pitanks NAME normal --matches 200`: `fsm` wins 46 and loses 46 (it is the same
machine), q1 180 and 8, q2 132 and 35. `classic` wins none, and 1 of 200 against `easy`."""


@dataclass(frozen=True)
class HighScoreTable:
    """A table as it is shown. `heading`: key of its text; `days`: of so many last days; None: of all time."""

    heading: str
    table: Table
    days: int | None = None


def counts(setup: Setup, seat: int) -> bool:
    """Whether what a seat does in a match can enter a table."""
    own = setup.seats[seat]
    opponents = [one.brain for one in setup.seats if one.brain != "off" and one.team != own.team]
    return bool(opponents) and all(brain == "human" or brain in STRONG for brain in opponents)


def contest(setup: Setup, seat: int | None = None) -> Table:
    """The conditions of a match for a seat, or for the first person's: a table without a feat."""
    people = [i for i, one in enumerate(setup.seats) if one.brain == "human"]
    own = setup.seats[seat if seat is not None else people[0] if people else 0]
    mates = [one for one in setup.seats if one.brain != "off" and one.team == own.team]
    side = sum(one.brain == "human" for one in mates) if len(mates) > 1 else 0
    length = setup.goal if GAMES[setup.game].goals else setup.minutes
    return Table(setup.game, setup.arena, "", False, setup.variant, length, max(1, len(people)), side)


def table_of(contest: Table, feat: Feat) -> Table:
    """The table of a feat under the conditions of a contest."""
    return replace(contest, feat=feat.name, timed=feat.timed)


def high_score_tables(contest: Table) -> list[HighScoreTable]:
    """The two tables shown side by side: of each feat, or of the only one today's and that of all time."""
    feats = GAMES[contest.game].feats
    tables = [table_of(contest, feat) for feat in feats]
    if len(feats) > 1:
        return [HighScoreTable(f"results.best_{table.feat}", table) for table in tables[:2]]
    return [HighScoreTable("results.today", tables[0], 1), HighScoreTable("results.ever", tables[0])]


def older_tables(contest: Table, scores: Scores) -> list[HighScoreTable]:
    """The tables of all time that have rows, of a contest of version 1.3.0."""
    tables = [table_of(contest, feat) for feat in GAMES[contest.game].feats]
    return [HighScoreTable(f"results.best_{table.feat}", table) for table in tables if scores.best(table)]


def contests(scores: Scores) -> list[Table]:
    """The contests of which something can be shown, by game and arena, older ones last in each arena."""
    found = {replace(table, feat="", timed=False) for table in scores.tables() if _is_known(table)}
    games = list(GAMES)
    return sorted(found, key=lambda one: (games.index(one.game), one.arena != "classic", one.arena, one.older, one))


def format_score(value: int, feat: Feat | Table) -> str:
    """Points, or milliseconds as minutes and seconds."""
    return clock(value / 1000.0) if feat.timed else str(value).replace("-", "−")


def clock(seconds: float) -> str:
    """A time to the hundredth; 0 is none."""
    if seconds <= 0.0:
        return NONE
    hundredths = round(100 * seconds)
    minutes, rest = divmod(hundredths, 6000)
    return f"{minutes}:{rest // 100:02}.{rest % 100:02}" if minutes else f"{rest // 100}.{rest % 100:02}"


def _is_known(table: Table) -> bool:
    """Whether there is such a game, with such a feat and such rules; a file may hold anything."""
    game = GAMES.get(table.game)
    if not game or not any((feat.name, feat.timed) == (table.feat, table.timed) for feat in game.feats):
        return False
    return table.older or (table.rules in game.variants and table.people <= 4 and table.side <= table.people)
