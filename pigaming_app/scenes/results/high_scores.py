"""High-score page: two tables, either today and all time, or two achievements such as lap and race.

Left and right change rules, durations and numbers of people in the same arena, up and down the arena or game.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import pygame

from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.registry import level_of
from pigaming_app.games.arenas import score_name
from pigaming_app.games.game import ALLIES, RecordKind, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import arena_of_table, arena_title
from pigaming_app.scenes.flow.match_words import match_length
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.storage.scores import Score, Scores, ScoreTable
from pigaming_app.ui.draw import BODY, ICE, LABEL, MIST, text_width
from pigaming_app.ui.draw.layers import RIGHT, span, text
from pigaming_app.ui.i18n import Words, numeral
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.arrows import as_direction, draw_arrows
from pigaming_app.ui.widgets.score_board import BoardRow, ScoreBoard

NONE = "–"
STRONG_LEVEL = 3  # the weakest level that counts
STRONG = frozenset({"hand2", "hand3", "net", "planner", "q1", "q2"})
"""Other AIs no weaker than `hand2`. Of 200 matches of `duel pitanks NAME hand2 --matches 200` under
`pickups`, `hand3` wins 161 and loses 26, q1 187 and 9, q2 109 and 79; `hand1` wins 1, `fsm` 41 (and loses 125) and
`classic` none."""
WHERE_Y, LINE_Y = 112, 234  # px
ROOM, WHERE_ROOM = 1360, 800  # px: maximum width of the conditions, and of game and arena
STEPS = {Button.LEFT: -1, Button.RIGHT: 1, Button.UP: -1, Button.DOWN: 1}


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
        brain == "human" or brain in STRONG or brain in AUTO or level_of(brain) >= STRONG_LEVEL for brain in opponents
    )


def contest(setup: Setup, seat: int | None = None) -> ScoreTable:
    """The conditions of a match for a seat, or for the first person's: a table without a achievement."""
    people = [i for i, other in enumerate(setup.seats) if other.brain == "human"]
    own = setup.seats[seat if seat is not None else people[0] if people else 0]
    mates = [other for other in setup.seats if other.brain != "off" and other.team == own.team]
    side = sum(other.brain == "human" for other in mates) if len(mates) > 1 else 0
    length = setup.goal if games()[setup.game].variants[setup.variant].goals else setup.minutes
    arena, auto = score_name(setup.game, setup.arena), any(other.brain in AUTO for other in setup.seats)
    return ScoreTable(setup.game, arena, "", False, setup.variant, length, max(1, len(people)), side, auto)


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


class HighScores(Page):
    """The tables of a contest, or of the first one with rows if they are empty. `fresh`: new rows, highlighted."""

    title = "results.scores"
    idle, when_idle, lockout = 12.0, Pop(), 0.4
    closing = Button.FIRE, Button.START, Button.Y, Button.CLICK
    hints = ((Button.FIRE, "results.on"),)

    def __init__(self, context: Context, contest: ScoreTable, fresh: Sequence[Score] = ()) -> None:
        super().__init__(context)
        self.fresh = list(fresh)
        self.shelf = [table for table in contests(context.scores) if arena_of_table(table.game, table.arena)]
        self._show(nearest(contest, self.shelf))

    @property
    def game(self) -> str:
        """The game on display."""
        return self.contest.game

    @property
    def resting(self) -> float:
        return self.untouched

    def handle(self, event: InputEvent) -> StackOperation:
        """Directions and arrows select other tables; any button continues."""
        return super().handle(as_direction(event, self.arrows))

    def press(self, event: InputEvent) -> StackOperation:
        if event.button in STEPS:
            self._step(event.button)
        return None

    def advance(self, seconds: float) -> StackOperation:
        self.turned += seconds
        return None

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the arrows, too."""
        draw_arrows(screen, self.arrows)
        super().draw_foot(screen)

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the tables; their rows are revealed one after the other."""
        words, contest = self.context.words, self.contest
        text(self._where(), BODY, MIST, "body", "r", WHERE_ROOM).draw(screen, RIGHT, WHERE_Y)
        text(conditions(words, contest), LABEL, ICE, "head", "c", ROOM).draw(screen, 960, LINE_Y)
        tables = high_score_tables(contest)
        for column, board in zip((0, 6) if len(tables) > 1 else (3,), tables, strict=False):
            self._board(screen, board, *span(column, 6))

    # ---- inside

    def _step(self, button: Button) -> None:
        """Show the next table in a direction, wrapping around."""
        ring = self._ring(button)
        if len(ring) > 1:
            self._show(ring[(ring.index(self.contest) + STEPS[button]) % len(ring)])
            self.context.sounds.play("move")

    def _show(self, contest: ScoreTable) -> None:
        """Show the tables of a contest, with arrows where others exist."""
        self.contest, self.turned = contest, 0.0
        width = min(WHERE_ROOM, text_width(self._where(), BODY, "body"))
        line = min(ROOM, text_width(conditions(self.context.words, contest), LABEL, "head")) / 2
        self.arrows: dict[Button, tuple[float, float]] = {}
        if len(self._ring(Button.UP)) > 1:
            self.arrows[Button.UP] = RIGHT - width - 52, WHERE_Y - 24
            self.arrows[Button.DOWN] = RIGHT - width - 52, WHERE_Y + 24
        if len(self._ring(Button.LEFT)) > 1:
            self.arrows[Button.LEFT] = 960 - line - 60, LINE_Y
            self.arrows[Button.RIGHT] = 960 + line + 60, LINE_Y

    def _ring(self, button: Button) -> list[ScoreTable]:
        """Contests reachable by a direction: in the same arena for left and right, one per arena for up and down."""
        here = place_of(self.contest)
        if button in (Button.LEFT, Button.RIGHT):
            return [table for table in self.shelf if place_of(table) == here]
        firsts: dict[tuple[str, str], ScoreTable] = {}
        for table in self.shelf:
            firsts.setdefault(place_of(table), self.contest if place_of(table) == here else table)
        return list(firsts.values())

    def _where(self) -> str:
        """Game and arena titles."""
        words, contest = self.context.words, self.contest
        name = arena_of_table(contest.game, contest.arena)
        arena = arena_title(load_cached(contest.game, name), words.language) if name else contest.arena
        return f"{words('games.' + contest.game)}  ·  {arena}"

    def _board(self, screen: pygame.Surface, board: HighScoreTable, x: int, w: int) -> None:
        """Draw a table below its heading."""
        words = self.context.words
        rows = [
            BoardRow(row.initials, words.decimal(format_score(row.score, board.table)), row in self.fresh)
            for row in self.context.scores.best(board.table, board.days)
        ]
        title = words.counted(board.heading, board.table.length, goal=f"{board.table.length:g}")
        ScoreBoard(title, rows, words("best.first")).draw(screen, x, w, self.turned)


def nearest(contest: ScoreTable, shelf: Sequence[ScoreTable]) -> ScoreTable:
    """The contest itself if it has rows or none has, else one of its arena, of its game, or any other."""
    near = [table for table in shelf if place_of(table) == place_of(contest)] or [
        table for table in shelf if table.game == contest.game
    ]
    return contest if contest in shelf or not shelf else next(iter(near or shelf))


def place_of(contest: ScoreTable) -> tuple[str, str]:
    """Game and arena."""
    return contest.game, contest.arena


def conditions(words: Words, contest: ScoreTable) -> str:
    """Rules, duration and number of people of a contest in one line."""
    game = games()[contest.game]
    parts: list[str] = []
    if len(game.variants) > 1 and contest.rules:
        parts.append(words(f"setup.{contest.game}_{contest.rules}"))
    if contest.length:
        by_goal = game.variants.get(contest.rules, game.default).goals
        parts.append(match_length(words, game, contest.length, round(contest.length) if by_goal else 0))
    if contest.people:
        parts.append(words("best.person") if contest.people == 1 else words("best.people", count=contest.people))
    if contest.side == contest.people and contest.side:
        parts.append(words("best.team"))
    elif contest.side:
        parts.append(words("best.against", side=contest.side, others=contest.people - contest.side))
    if contest.auto:
        parts.append(words("best.auto"))
    return "  ·  ".join(parts)
