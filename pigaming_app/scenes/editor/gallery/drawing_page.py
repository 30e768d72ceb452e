"""One arena of the user: draw on, play, rename, share as a file, delete with a second press."""

import pygame

from pigaming_app.games.arenas import load
from pigaming_app.games.drawing.values import Drawing
from pigaming_app.scenes.editor import store
from pigaming_app.scenes.editor.gallery import view
from pigaming_app.scenes.editor.icons import draw_icon
from pigaming_app.scenes.editor.naming import ArenaNamePage
from pigaming_app.scenes.editor.play_test import PlayTest
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.editor.scene import Editor
from pigaming_app.scenes.flow.scene import Context, Pop, Push, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.sim.arena import ArenaError
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, MIST, STEEL, THIN, cut_box
from pigaming_app.ui.draw.layers import LEFT, Layer, LitImage, fit_size, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, frame, heading

CONFIRM_SECONDS = 3.0
FRAME = pygame.Rect(LEFT, 216, span(0, 8)[1], 660)
ROW_X, ROW_W = span(8, 4)
ROW_H, PITCH = 96, 114  # px
SIGNS = {"edit": "pencil", "play": "play", "rename": "rename", "share": "share", "delete": "delete"}


class DrawingPage(Page):
    """The page of an arena or a draft of the user."""

    stay = 6.0
    hints = ((Button.FIRE, "editor.hint_choose"), (Button.BACK, "editor.hint_back"))

    def __init__(self, context: Context, game: str, name: str) -> None:
        self.game, self.name = game, name
        self.drawing = store.opened(game, name)
        self.confirm_left = 0.0
        rows = [row for row in SIGNS if not context.kiosk or row in ("edit", "play")]  # nothing is deleted or renamed
        super().__init__(context, Focus([FocusSpot(row, row_box(i)) for i, row in enumerate(rows)]))

    def on_enter(self) -> None:
        """Read the drawing again, as it may have been changed and renamed."""
        self.context.sounds.music("title")
        self.drawing = store.opened(self.game, self.name)

    def press(self, event: InputEvent) -> StackOperation:
        """Whoever moves on does not delete."""
        before = self.focus.name
        turn = super().press(event)
        self.confirm_left = self.confirm_left if self.focus.name == before else 0.0
        return turn

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        return self._do(name, event, self.drawing) if self.drawing else Pop()

    def advance(self, seconds: float) -> StackOperation:
        self.confirm_left -= seconds
        return None if self.drawing else Pop()

    @property
    def heading(self) -> LitImage:
        return heading(self.drawing_title, self.context.words(f"games.{self.game}"))

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the arena and the rows."""
        words = self.context.words
        black_out(screen, FRAME, *(spot.rect for spot in self.focus.spots))
        if self.drawing:
            inner = FRAME.inflate(-24, -24)
            view.picture(EDITORS[self.game], self.drawing, *inner.size).draw(screen, *inner.topleft)
        frame(*FRAME.size).draw(screen, *FRAME.topleft)
        for spot in self.focus.spots:
            asked = spot.name == "delete" and self.confirm_left > 0.0
            key = "editor.sure" if asked else f"editor.{spot.name}"
            row(SIGNS[spot.name], words(key), spot.name == self.focus.name).draw(screen, *spot.rect.topleft)
        self.focus.draw(screen)

    @property
    def drawing_title(self) -> str:
        found = store.title_of(self.drawing, self.context.words.language) if self.drawing else ""
        return found or self.name

    # ---- inside

    def _do(self, what: str, event: InputEvent, drawing: Drawing) -> StackOperation:
        """Do what a row says."""
        match what:
            case "edit":
                self.context.sounds.play("accept")
                named = drawing if store.title_of(drawing, "en") else store.titled(drawing, self.name)
                return Push(Editor(self.context, self.game, self.name, named))
            case "play":
                return self._play(event)
            case "rename":
                self.context.sounds.play("accept")
                return Push(ArenaNamePage(self.context, self.game, self.name, self.drawing_title, self._rename))
            case "share":
                self._share(drawing)
            case _:
                return self._delete()
        return None

    def _play(self, event: InputEvent) -> StackOperation:
        """Play the arena as it was saved; a draft has to be finished first."""
        try:
            arena = load(self.game, self.name)
        except ArenaError:
            self._say("editor.unfinished", wrong=True)
            return None
        self.context.sounds.play("accept")
        return Push(PlayTest(self.context, self.game, arena, event.device))

    def _rename(self, title: str) -> None:
        try:
            self.name = store.rename(self.game, self.name, title)
        except NotSaved:
            self._say("editor.disk", wrong=True)

    def _share(self, drawing: Drawing) -> None:
        try:
            path = store.export(self.game, self.name, drawing)
        except NotSaved:
            self._say("editor.disk", wrong=True)
            return
        self._say("editor.shared", file=str(path))

    def _delete(self) -> StackOperation:
        """Ask at the first press, delete at the second."""
        if self.confirm_left <= 0.0:
            self.confirm_left = CONFIRM_SECONDS
            self.context.sounds.play("move")
            return None
        try:
            store.delete(self.game, self.name)
        except NotSaved:
            self._say("editor.disk", wrong=True)
            return None
        self.context.sounds.play("back")
        return Pop()

    def _say(self, key: str, wrong: bool = False, **values: object) -> None:
        self.show_message(self.context.words(key, **values), wrong)
        self.context.sounds.play("refused" if wrong else "accept")


def row_box(i: int) -> pygame.Rect:
    """Rectangle of the i-th row."""
    return pygame.Rect(ROW_X, FRAME.y + PITCH * i, ROW_W, ROW_H)


@cached
def row(sign: str, word: str, hot: bool) -> LitImage:
    """A row; top left at (0, 0)."""
    layer = Layer(0, 0, ROW_W, ROW_H)
    layer.glow.line(cut_box(0, 0, ROW_W, ROW_H, 16), ICE if hot else STEEL, THIN, True)
    draw_icon(layer.glow, sign, 60, ROW_H / 2, 24, FOCUS if hot else MIST)
    size = fit_size(word, LABEL, ROW_W - 140)
    layer.canvas.text(word, size, 112, ROW_H / 2, ICE if hot else MIST)
    return layer.render()
