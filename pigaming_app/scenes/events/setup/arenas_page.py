"""The arenas of a new event: a column for each game, whose arenas take turns in the order in which they were chosen."""

import pygame

from pigaming_app.scenes.events.setup.draft import Draft
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import arena_title, playable_arenas
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, THIN, cut_box, text_width
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, text, wrap_balanced
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out

HEAD_Y, TOP, HIGH, PITCH, GAP, WIDEST = 246, 300, 94, 104, 24, 640  # px
ROWS = 6  # arenas of a game that fit


class ArenasPage(Page):
    """The page of a draft."""

    title, idle = "events.arena", 120.0
    hints = ((Button.FIRE, "events.hint_turn"), (Button.BACK, "events.hint_back"))

    def __init__(self, context: Context, draft: Draft) -> None:
        self.draft = draft
        self.cells = {
            f"{game} {arena}": (game, arena) for game in draft.games for arena in playable_arenas(game)[:ROWS]
        }
        super().__init__(context, Focus(self._spots()))

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE chooses an arena, or leaves it out; START and BACK return."""
        if event.button is Button.START:
            self.context.sounds.play("accept")
            return Pop()
        return super().press(event)

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        self.context.sounds.play("move" if self.draft.toggle_arena(*self.cells[name]) else "refused")
        return None

    @property
    def subtitle(self) -> str:
        return self.context.words("events.arenas_line")

    def paint(self, screen: pygame.Surface) -> None:
        """Draw a column for each game."""
        words = self.context.words
        black_out(screen, *(spot.rect for spot in self.focus.spots))
        for i, game in enumerate(self.draft.games):
            text(words(f"games.{game}"), LABEL, ICE, "head", "l", self._width).draw(screen, self._left(i), HEAD_Y)
        for spot in self.focus.spots:
            game, arena = self.cells[spot.name]
            turns, title = self.draft.arenas(game), arena_title(load_cached(game, arena), words.language)
            turn = str(1 + turns.index(arena)) if arena in turns else ""
            cell(title, turn, spot.rect.w, spot.name == self.focus.name).draw(screen, *spot.rect.topleft)
        self.focus.draw(screen)

    # ---- inside

    @property
    def _width(self) -> int:
        count = len(self.draft.games)
        return min(WIDEST, (RIGHT - LEFT - GAP * (count - 1)) // count)

    def _left(self, column: int) -> int:
        return LEFT + (self._width + GAP) * column

    def _spots(self) -> list[FocusSpot]:
        games, count = self.draft.games, dict.fromkeys(self.draft.games, 0)
        spots = []
        for name, (game, _) in self.cells.items():
            box = pygame.Rect(self._left(games.index(game)), TOP + PITCH * count[game], self._width, HIGH)
            spots.append(FocusSpot(name, box))
            count[game] += 1
        return spots


@cached
def cell(title: str, turn: str, w: int, hot: bool) -> LitImage:
    """An arena with its turn, if it has one; top left at (0, 0)."""
    layer = Layer(0, 0, w, HIGH)
    edge = FOCUS if hot else ICE if turn else STEEL
    layer.glow.line(cut_box(0, 0, w, HIGH, 16), edge, THIN, True)
    layer.glow.line(cut_box(20, 18, 64, HIGH - 36, 12), ICE if turn else STEEL, THIN, True)
    layer.canvas.text(turn, BODY, 52, HIGH / 2, FOCUS, "head", "c")
    lines, largest = [title], LABEL
    if text_width(title, BODY) > w - 132:
        lines, largest = wrap_balanced(title, 2, BODY, "head"), BODY
    for i, line in enumerate(lines):
        y = HIGH / 2 + 42 * (i - (len(lines) - 1) / 2)
        layer.canvas.text(line, fit_size(line, largest, w - 132), 104, y, ICE if turn or hot else MIST, "head")
    return layer.render()
