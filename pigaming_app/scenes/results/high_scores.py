"""High-score page: two tables, either today and all time, or two achievements such as lap and race.

Left and right change rules, durations and numbers of people in the same arena, up and down the arena or game.
"""

from collections.abc import Sequence

import pygame

from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_choice import arena_of_table, arena_title, load_cached
from pigaming_app.scenes.flow.match_words import match_length
from pigaming_app.scenes.flow.stack import Pop, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.results.high_score_tables import (
    HighScoreTable,
    contests,
    format_score,
    high_score_tables,
)
from pigaming_app.storage.scores import Score, ScoreTable
from pigaming_app.ui.draw import BODY, ICE, LABEL, MIST, text_width
from pigaming_app.ui.draw.layers import RIGHT, span
from pigaming_app.ui.draw.text import text
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.arrows import as_direction, draw_arrows
from pigaming_app.ui.widgets.score_board import BoardRow, ScoreBoard

WHERE_Y, LINE_Y = 112, 234  # px
ROOM, WHERE_ROOM = 1360, 800  # px: maximum width of the conditions, and of game and arena
STEPS = {Button.LEFT: -1, Button.RIGHT: 1, Button.UP: -1, Button.DOWN: 1}


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
    return "  ·  ".join(parts)
