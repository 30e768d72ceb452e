"""What the views of the results share: the reveal of rows, and the head with headline, match and line below."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import pygame

from pigaming_app.games.arenas import load
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.match_words import match_length
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.results.headline import EndedMatch, headline, is_allied, stars, winning_color
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, budget, finished_within
from pigaming_app.ui.draw.layers import LEFT, MARGIN, RIGHT, Layer, LitImage, backdrop, fit_size

SHORT = 218  # px, line below a title without a winner

FIRST, APART, WIPE = 0.25, 0.22, 0.3  # s: delay of the first row, delay from row to row, wipe of one row


@dataclass(frozen=True)
class RevealedPart:
    """A widget with its reveal: wiped in from the left over `duration` seconds."""

    lit: LitImage
    starts: float
    duration: float = WIPE

    def draw(self, screen: pygame.Surface, age: float) -> None:
        """Draw it `age` seconds after the page was opened."""
        share = (age - self.starts) / self.duration
        if share > 0.0:
            self.lit.draw(screen, share=1 - (1 - min(1.0, share)) ** 2)


class PageHead:
    """The head of the page about an ended match; its title appears at `title_at` s."""

    def __init__(self, context: Context, ended: EndedMatch, finished: bool, title_at: float) -> None:
        self.context, self.ended, self.finished, self.title_at = context, ended, finished, title_at
        self.winners = ended.outcome.winners if finished else ()
        self.stars = stars(ended.outcome) if finished and is_allied(ended.setup) else 0
        self.length = RIGHT - LEFT if self.winners else SHORT
        self.parts: list[RevealedPart] = []

    def render_parts(self) -> Steps[None]:
        """Render one widget per step."""
        self.colored = line(self._color(), self.length)
        self.steel = line(kit.STEEL, RIGHT - LEFT, kit.THIN)
        yield
        self.room = float(RIGHT)  # px, right limit of the title
        where = self._where()
        if any(self.ended.names) and self._size() < kit.TITLE:  # the names need the room
            self.room = float(RIGHT)
        else:
            self.parts.append(RevealedPart(where, 0.1))
        yield
        self.parts.append(RevealedPart(self._title(), self.title_at))
        yield

    def draw(self, screen: pygame.Surface, age: float) -> None:
        """Draw the head `age` seconds after the page was opened."""
        for part in self.parts:
            part.draw(screen, age)
        if age < self.title_at:
            self.steel.draw(screen)
        else:
            reach = self._reach(age)
            self.steel.draw(screen, begin=share_of(self.steel, LEFT + reach))
            self.colored.draw(screen, share=share_of(self.colored, LEFT + reach))

    def _color(self) -> kit.Color:
        return winning_color(self.ended.outcome, self.ended.setup) if self.winners else kit.ICE

    def _title(self) -> LitImage:
        """Headline in the winner's colour, with a crown."""
        layer = Layer(LEFT, 54, RIGHT - LEFT, 116)
        for i, seat in enumerate(() if self.stars else self.winners):
            kit.badge(layer.glow, seat, LEFT + 128 * i + 52, 110, 50)
        text, size, x = self._text(), self._size(), self._text_x
        layer.canvas.text(text, size, x, 112, self._color())
        if self.winners and not self.stars:
            at = x + kit.text_width(text, size) + 70
            kit.icon(layer.glow, "crown", at, 108, 40, kit.FOCUS, kit.LINE)
        return layer.render()

    @property
    def _text_x(self) -> int:
        """The left edge of the title, px."""
        return LEFT + (128 * len(self.winners) + 14 if self.winners and not self.stars else 0)

    def _text(self) -> str:
        words = self.context.words
        return headline(words, self.ended) if self.finished else words("results.ended")

    def _size(self) -> int:
        """The size of the title in its room, px."""
        return fit_size(self._text(), kit.TITLE, self.room - self._text_x - (130 if self.winners else 0))

    def _where(self) -> LitImage:
        """Game, duration, arena."""
        words, setup = self.context.words, self.ended.setup
        minutes = match_length(words, games()[setup.game], setup.minutes, setup.goal)
        arena = load(setup.game, setup.arena).title.get(words.language, setup.arena)
        line = f"{words('games.' + setup.game)}  ·  {arena}  ·  {minutes}"
        size = fit_size(line, kit.BODY, 720, "body")
        self.room = RIGHT - kit.text_width(line, size, "body") - 40
        layer = Layer(self.room, 60, RIGHT - self.room, 100)
        layer.canvas.body(line, RIGHT, 112, kit.MIST, "r", size)
        return layer.render()

    def _reach(self, age: float) -> float:
        """Coloured length of the line below the title, px."""
        return (self.length + MARGIN) * (1.0 - (1.0 - min(1.0, (age - self.title_at) / WIPE)) ** 2)


class RevealedPage:
    """A view of the results: its head, and a part for each team, revealed one after the other."""

    def __init__(self, context: Context, ended: EndedMatch, finished: bool) -> None:
        self.context, self.ended, self.finished = context, ended, finished
        self.teams = [list(rows) for _, rows in groupby(ended.outcome.rows, key=lambda row: row.team)]
        self.head = PageHead(context, ended, finished, title_starts(len(self.teams)))
        self.ready_at = self.head.title_at + 0.4
        self.parts: list[RevealedPart] = []
        self._rendering = self._render_parts()

    def prewarm(self, milliseconds: float) -> bool:
        """Render widgets for at most this many milliseconds; True when all are ready."""
        return finished_within(self._finish, milliseconds)

    def sounds(self) -> list[tuple[float, str, int | None]]:
        """Sounds of the reveal: (seconds, name, player)."""
        return row_sounds([team[0].seat for team in self.teams])

    def draw(self, screen: pygame.Surface, age: float) -> None:
        """Draw the page `age` seconds after it was opened."""
        self._finish()
        screen.blit(backdrop(), (0, 0))
        self.head.draw(screen, age)
        for part in self.parts:
            part.draw(screen, age)

    def _finish(self) -> None:
        """Render the remaining widgets. Raises Unfinished if the frame budget is exhausted."""
        for _ in self._rendering:
            budget.pause()

    def _render_parts(self) -> Steps[None]:
        """Render one widget per step."""
        yield from self.head.render_parts()


def share_of(lit: LitImage, x: float) -> float:
    """Share of a widget that lies left of canvas x."""
    return (x - lit.at[0]) / lit.image.get_width()


def line(color: kit.Color, length: float, width: int = kit.LINE) -> LitImage:
    """The line below a title."""
    layer = Layer(LEFT, 170, length, 12)
    layer.glow.line([(LEFT, 176), (LEFT + length, 176)], color, width)
    return layer.render()


def row_starts(row: int, rows: int) -> float:
    """When the reveal of a row begins, s; of row `rows`, the title."""
    return FIRST + APART * (rows - 1 - row)


def title_starts(rows: int) -> float:
    """When the reveal of the title begins, s."""
    return FIRST + APART * rows + 0.15


def row_sounds(seats: Sequence[int]) -> list[tuple[float, str, int | None]]:
    """Sounds of the reveal of rows, best first: (seconds, name, player)."""
    return [(row_starts(i, len(seats)), "move", seat) for i, seat in reversed(list(enumerate(seats)))]
