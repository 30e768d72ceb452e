"""The best climbers: today and of all time, for each game and for all games together."""

from collections.abc import Sequence

import pygame

from pigaming_app.events.ladder import ALL, climbed_games, stars_and_losses, table_of
from pigaming_app.scenes.flow.brain_names import LIT
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Pop, StackOperation
from pigaming_app.storage.scores import Score, ScoreTable
from pigaming_app.ui.draw import ICE, LABEL, text_width
from pigaming_app.ui.draw.layers import backdrop, span
from pigaming_app.ui.draw.text import text
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.arrows import Arrows, as_direction, draw_arrows
from pigaming_app.ui.widgets.labels import heading
from pigaming_app.ui.widgets.score_board import Board, BoardRow

SPANS = {"results.today": 1, "results.ever": None}  # headings and their spans in days
STAY = 20.0  # s without input
INPUT_LOCKOUT = 0.4  # s during which input is ignored
LINE_Y = 234  # px
CLOSING = Button.FIRE, Button.START, Button.BACK, Button.Y, Button.CLICK


class Climbers:
    """The tables of a game, or of ALL. `fresh`: new rows, highlighted."""

    def __init__(self, context: Context, game: str, fresh: Sequence[Score] = ()) -> None:
        self.context, self.game, self.fresh = context, game, list(fresh)
        self.age = self.turned = self.idle = 0.0
        hints = [(Button.FIRE, "results.on"), (Button.RIGHT, "ladder.hint_games")]
        self.prompts = context.prompts(hints)

    @property
    def arrows(self) -> Arrows:
        """Beside the name of the game."""
        reach = text_width(self._title(), LABEL) / 2 + 60
        return {Button.LEFT: (960 - reach, LINE_Y), Button.RIGHT: (960 + reach, LINE_Y)}

    def on_enter(self) -> None:
        """Nothing to do."""

    def handle(self, event: InputEvent) -> StackOperation:
        """LEFT and RIGHT change the game; any button continues."""
        event = as_direction(self.prompts.as_button(event), self.arrows)
        self.idle = 0.0
        if event.button in (Button.LEFT, Button.RIGHT):
            step = 1 if event.button is Button.RIGHT else -1
            tables = [*climbed_games(), ALL]
            self.game, self.turned = tables[(tables.index(self.game) + step) % len(tables)], 0.0
            self.context.sounds.play("move")
        elif self.age > INPUT_LOCKOUT and event.button in CLOSING:
            self.context.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> StackOperation:
        """Continue after a while without input."""
        self.age += seconds
        self.turned += seconds
        self.idle += seconds
        return Pop() if self.idle > STAY else None

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the tables and the prompts."""
        self.paint(screen)
        draw_arrows(screen, self.arrows)
        self.prompts.draw(screen)

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the tables only."""
        words, table = self.context.words, table_of(self.game)
        screen.blit(backdrop(), (0, 0))
        heading(words("ladder.climbers"), words("ladder.measure")).draw(screen)
        text(self._title(), LABEL, ICE, "head").draw(screen, 960, LINE_Y)
        for column, (title, days) in zip((0, 6), SPANS.items(), strict=True):
            rows = [self._row(row) for row in self.context.scores.best(table, days)]
            board = Board(words(title), rows, words("best.first"), words("ladder.lost_column"))
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
