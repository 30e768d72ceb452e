"""One arena of the user: draw on, play, rename, share as a file, delete with a second press."""

import pygame

from pigaming_app.games.arenas import load
from pigaming_app.games.drawing.values import Drawing
from pigaming_app.scenes.editor import store
from pigaming_app.scenes.editor.gallery import view
from pigaming_app.scenes.editor.icons import draw_icon
from pigaming_app.scenes.editor.naming import NamePage
from pigaming_app.scenes.editor.play_test import PlayTest
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.editor.scene import Editor
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import Pop, Push, StackOperation
from pigaming_app.sim.arena import ArenaError
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, THIN, cut_box
from pigaming_app.ui.draw.layers import LEFT, Layer, LitImage, backdrop, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size, text
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, frame, heading

IDLE, STAY, CONFIRM_SECONDS = 90.0, 6.0, 3.0  # s
FRAME = pygame.Rect(LEFT, 216, span(0, 8)[1], 660)
ROW_X, ROW_W = span(8, 4)
ROW_H, PITCH = 96, 114  # px
SIGNS = {"edit": "pencil", "play": "play", "rename": "rename", "share": "share", "delete": "delete"}
SENTENCE_Y = 906


class DrawingPage:
    """The page of an arena or a draft of the user."""

    def __init__(self, context: Context, game: str, name: str) -> None:
        self.context, self.game, self.name = context, game, name
        self.drawing = store.opened(game, name)
        self.confirm_left = 0.0
        self.focus = Focus([FocusSpot(row, row_box(i)) for i, row in enumerate(self.rows)])
        hints = [(Button.FIRE, "editor.hint_choose"), (Button.BACK, "editor.hint_back")]
        self.navigation = Navigation(context, self.focus, hints, IDLE, STAY)

    @property
    def rows(self) -> list[str]:
        """What can be done. In a kiosk nothing can be deleted or renamed."""
        return [row for row in SIGNS if not self.context.kiosk or row in ("edit", "play")]

    def on_enter(self) -> None:
        """Read the drawing again, as it may have been changed and renamed."""
        self.context.sounds.music(True)
        self.drawing = store.opened(self.game, self.name)

    def handle(self, event: InputEvent) -> StackOperation:
        event = self.navigation.prompts.as_button(event)
        chosen = self.focus.activated(event)
        if chosen:
            self.focus.move_to(chosen)
            return self._do(chosen, event, self.drawing) if self.drawing else Pop()
        before, turn = self.focus.name, self.navigation.handle(event)
        self.confirm_left = self.confirm_left if self.focus.name == before else 0.0
        return turn

    def update(self, seconds: float) -> StackOperation:
        self.confirm_left -= seconds
        if self.drawing is None:
            return Pop()
        return self.navigation.update(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        words = self.context.words
        screen.blit(backdrop(), (0, 0))
        heading(self.title, words(f"games.{self.game}")).draw(screen)
        black_out(screen, FRAME, *(spot.rect for spot in self.focus.spots))
        if self.drawing:
            inner = FRAME.inflate(-24, -24)
            view.picture(EDITORS[self.game], self.drawing, *inner.size).draw(screen, *inner.topleft)
        frame(*FRAME.size).draw(screen, *FRAME.topleft)
        for spot in self.focus.spots:
            asked = spot.name == "delete" and self.confirm_left > 0.0
            key = "editor.sure" if asked else f"editor.{spot.name}"
            row(SIGNS[spot.name], words(key), spot.name == self.focus.name).draw(screen, *spot.rect.topleft)
        if sentence := self.navigation.sentence:
            text(sentence, BODY, FOCUS).draw(screen, 960, SENTENCE_Y)
        self.focus.draw(screen)
        self.navigation.prompts.draw(screen)

    @property
    def title(self) -> str:
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
                return Push(NamePage(self.context, self.game, self.name, self.title, self._rename))
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
        self.navigation.show_message(self.context.words(key, **values))
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
