"""The arenas of a new event: a column for each game, whose arenas take turns in the order in which they were chosen."""

import pygame

from pigaming_app.scenes.events.setup.draft import Draft
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_choice import arena_title, load_cached, playable_arenas
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import Pop, StackOperation
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, THIN, cut_box, text_width
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, backdrop
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size, text, wrap_balanced
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, heading

IDLE = 120.0  # s without input before the return to the title
HEAD_Y, TOP, HIGH, PITCH, GAP, WIDEST = 246, 300, 94, 104, 24, 640  # px
ROWS = 6  # arenas of a game that fit


class ArenasPage:
    """The page of a draft."""

    def __init__(self, context: Context, draft: Draft) -> None:
        self.context, self.draft = context, draft
        self.cells = {
            f"{game} {arena}": (game, arena) for game in draft.games for arena in playable_arenas(game)[:ROWS]
        }
        self.focus = Focus(self._spots())
        hints = [(Button.FIRE, "events.hint_turn"), (Button.BACK, "events.hint_back")]
        self.navigation = Navigation(context, self.focus, hints, IDLE)

    def on_enter(self) -> None:
        """Nothing to do."""

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE chooses an arena, or leaves it out; START and BACK return."""
        event = self.navigation.prompts.as_button(event)
        if event.button is Button.START:
            self.context.sounds.play("accept")
            return Pop()
        if event.button is Button.CLICK:
            self.focus.handle(event)
        if chosen := self.focus.activated(event):
            self.context.sounds.play("move" if self.draft.toggle_arena(*self.cells[chosen]) else "refused")
            return None
        return self.navigation.handle(event)

    def update(self, seconds: float) -> StackOperation:
        return self.navigation.update(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        words = self.context.words
        screen.blit(backdrop(), (0, 0))
        heading(words("events.arena"), words("events.arenas_line")).draw(screen)
        black_out(screen, *(spot.rect for spot in self.focus.spots))
        for i, game in enumerate(self.draft.games):
            text(words(f"games.{game}"), LABEL, ICE, "head", "l", self._width).draw(screen, self._left(i), HEAD_Y)
        for spot in self.focus.spots:
            game, arena = self.cells[spot.name]
            turns, title = self.draft.arenas(game), arena_title(load_cached(game, arena), words.language)
            turn = str(1 + turns.index(arena)) if arena in turns else ""
            cell(title, turn, spot.rect.w, spot.name == self.focus.name).draw(screen, *spot.rect.topleft)
        self.focus.draw(screen)
        self.navigation.prompts.draw(screen)

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
