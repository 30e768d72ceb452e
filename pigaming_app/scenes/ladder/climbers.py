"""The best climbers: today and of all time, for each game and for all games together."""

from collections.abc import Sequence

import pygame

from pigaming_app.events.ladder import ALL, climbed_games, stars_and_losses, table_of
from pigaming_app.scenes.flow.match_words import LIT
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.storage.scores import Score, ScoreTable
from pigaming_app.ui.draw import ICE, LABEL, text_width
from pigaming_app.ui.draw.layers import span, text
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.arrows import Arrows, as_direction, draw_arrows
from pigaming_app.ui.widgets.score_board import BoardRow, ScoreBoard

SPANS = {"results.today": 1, "results.ever": None}  # headings and their spans in days
LINE_Y = 234  # px


class Climbers(Page):
    """The tables of a game, or of ALL. `fresh`: new rows, highlighted."""

    title = "ladder.climbers"
    idle, when_idle, lockout = 20.0, Pop(), 0.4
    closing = Button.FIRE, Button.START, Button.Y, Button.CLICK
    hints = ((Button.FIRE, "results.on"), (Button.RIGHT, "ladder.hint_games"))

    def __init__(self, context: Context, game: str, fresh: Sequence[Score] = ()) -> None:
        super().__init__(context)
        self.game, self.fresh, self.turned = game, list(fresh), 0.0

    @property
    def arrows(self) -> Arrows:
        """Beside the name of the game."""
        reach = text_width(self._title(), LABEL) / 2 + 60
        return {Button.LEFT: (960 - reach, LINE_Y), Button.RIGHT: (960 + reach, LINE_Y)}

    @property
    def resting(self) -> float:
        return self.untouched

    def handle(self, event: InputEvent) -> StackOperation:
        """LEFT and RIGHT change the game, as do the arrows; any button continues."""
        return super().handle(as_direction(event, self.arrows))

    def press(self, event: InputEvent) -> StackOperation:
        if event.button in (Button.LEFT, Button.RIGHT):
            step = 1 if event.button is Button.RIGHT else -1
            tables = [*climbed_games(), ALL]
            self.game, self.turned = tables[(tables.index(self.game) + step) % len(tables)], 0.0
            self.context.sounds.play("move")
        return None

    def advance(self, seconds: float) -> StackOperation:
        self.turned += seconds
        return None

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the arrows, too."""
        draw_arrows(screen, self.arrows)
        super().draw_foot(screen)

    @property
    def subtitle(self) -> str:
        return self.context.words("ladder.measure")

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the tables; their rows are revealed one after the other."""
        words, table = self.context.words, table_of(self.game)
        text(self._title(), LABEL, ICE, "head").draw(screen, 960, LINE_Y)
        for column, (title, days) in zip((0, 6), SPANS.items(), strict=True):
            rows = [self._row(row) for row in self.context.scores.best(table, days)]
            board = ScoreBoard(words(title), rows, words("best.first"), words("ladder.lost_column"))
            board.draw(screen, *span(column, 6), self.turned)

    def _title(self) -> str:
        return game_name(self.context.words, self.game)

    def _row(self, row: Score) -> BoardRow:
        level, lost = stars_and_losses(row.score)
        return BoardRow(row.initials, str(lost), row in self.fresh, LIT * level)


def game_name(words: Words, game: str) -> str:
    """The name of a game, or of all."""
    return words("ladder.all", count=len(climbed_games())) if game == ALL else words(f"games.{game}")


def format_climb(score: int, table: ScoreTable) -> str:
    """A climb's value: its stars."""
    return LIT * stars_and_losses(score)[0]
