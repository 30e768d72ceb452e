"""The gallery of a game: a new arena, a surprise, the user's own, and ours as templates."""

import secrets
import threading
from collections.abc import Callable
from dataclasses import dataclass

import pygame

from pigaming_app.games.arenas import MOST_OWN, shipped_arenas
from pigaming_app.games.drawing.values import Drawing, drawing_of
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor import store
from pigaming_app.scenes.editor.gallery import view
from pigaming_app.scenes.editor.gallery.drawing_page import DrawingPage
from pigaming_app.scenes.editor.gallery.view import COLUMNS, ROWS
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.editor.scene import Editor
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.sim.arena import ArenaError
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out

SHOWN = COLUMNS * ROWS
SURPRISES = 1_000_000  # seeds


@dataclass(frozen=True)
class Card:
    """A card: its name, its drawing, and the scene that it opens. `sign`: in place of a picture, or beside the name."""

    title: str
    open: Callable[[], StackOperation]
    drawing: Drawing | None = None
    sign: str = ""
    own: bool = False
    name: str = ""


class Surprise:
    """A made-up arena of a game, made in a thread, as that takes up to half a second."""

    def __init__(self, game: str) -> None:
        self.drawing: Drawing | None = None
        self._make = games()[game].surprise
        threading.Thread(target=self._work, name="surprise", daemon=True).start()

    def _work(self) -> None:
        if self._make:
            self.drawing = drawing_of(self._make(secrets.randbelow(SURPRISES)))


class Gallery(Page):
    """The gallery of a game, which Y changes to the next one."""

    title = "editor.title"
    hints = ((Button.FIRE, "editor.hint_open"), (Button.Y, "editor.hint_game"), (Button.BACK, "editor.hint_back"))

    def __init__(self, context: Context, game: str) -> None:
        self.context = context
        self.game = game if game in EDITORS else next(iter(EDITORS))
        self.first = 0  # card at the upper left
        self.cards: list[Card] = []
        self.surprise: Surprise | None = None  # being made since it was asked for
        self._read()
        super().__init__(context, Focus(self._spots()))

    def on_enter(self) -> None:
        """First display, or return from a drawing."""
        self.context.sounds.music("title")
        self.surprise = None
        self._read()
        self._scroll()

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE opens a card, Y shows the next game."""
        if event.button is Button.Y:
            names = [game for game in games() if game in EDITORS]
            self.game = names[(names.index(self.game) + 1) % len(names)]
            self.first = 0
            self.focus.move_to("0")
            self.on_enter()
            self.context.sounds.play("move")
            return None
        if event.button is Button.DOWN and not event.repeat and self._further():
            self.context.sounds.play("move")
            return None
        if event.button is Button.UP and self.first and int(self.focus.name) < self.first + COLUMNS:
            self._show(int(self.focus.name) - COLUMNS)
            self.context.sounds.play("move")
            return None
        return super().press(event)

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        self.context.sounds.play("accept")
        return self.cards[int(name)].open()

    def advance(self, seconds: float) -> StackOperation:
        """Open the surprise that was asked for."""
        return self._surprise() if self.surprise else None

    @property
    def subtitle(self) -> str:
        return self.context.words(f"games.{self.game}")

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the cards."""
        for i, one in enumerate(self.cards[self.first : self.first + SHOWN], self.first):
            box = view.card_box(i - self.first)
            black_out(screen, box)
            sign = one.sign if one.drawing else ""
            view.card(one.title, sign, one.own, str(i) == self.focus.name).draw(screen, *box.topleft)
            if one.drawing:
                at = box.x + view.PICTURE.x, box.y + view.PICTURE.y
                view.picture(EDITORS[self.game], one.drawing, *view.PICTURE.size).draw(screen, *at)
            else:
                view.big_sign(one.sign).draw(screen, *box.topleft)
        self.focus.draw(screen)

    # ---- cards

    def _read(self) -> None:
        """All cards of the game."""
        words = self.context.words
        self.cards = [Card(words("editor.new"), self._new, sign="plus")]
        if games()[self.game].surprise:
            self.cards.append(Card(words("editor.surprise"), self._surprise, sign="dice"))
        for name in store.own_names(self.game)[:MOST_OWN]:
            self.cards += self._own_card(name)
        for name in shipped_arenas(self.game):
            self.cards += self._template_card(name)

    def _own_card(self, name: str) -> list[Card]:
        drawing = store.opened(self.game, name)
        if drawing is None:
            return []
        title = store.title_of(drawing, self.context.words.language) or name
        sign = "pencil" if store.is_draft(self.game, name) else ""

        def opened() -> StackOperation:
            return Push(DrawingPage(self.context, self.game, name))

        return [Card(title, opened, drawing, sign, True, name)]

    def _template_card(self, name: str) -> list[Card]:
        try:
            arena = load_cached(self.game, name)
        except ArenaError:
            return []
        drawing = drawing_of(arena.source)
        title = store.title_of(drawing, self.context.words.language)
        return [Card(title, lambda: self._begin(drawing), drawing)]

    def _new(self) -> StackOperation:
        tools = EDITORS[self.game]
        return self._begin(tools.empty or drawing_of(load_cached(self.game, tools.template).source))

    def _surprise(self) -> StackOperation:
        """Open a made-up arena, as soon as it is made."""
        self.surprise = self.surprise or Surprise(self.game)
        if self.surprise.drawing is None:
            return None
        drawing, self.surprise = self.surprise.drawing, None
        return self._begin(drawing, True)

    def _begin(self, drawing: Drawing, reveal: bool = False) -> StackOperation:
        """Draw on a copy."""
        words = self.context.words
        drawing = store.titled(drawing, words("editor.new"))
        return Push(Editor(self.context, self.game, store.free_name(self.game), drawing, reveal))

    # ---- scrolling

    def _spots(self) -> list[FocusSpot]:
        shown = range(self.first, min(len(self.cards), self.first + SHOWN))
        return [FocusSpot(str(i), view.card_box(i - self.first)) for i in shown]

    def _further(self) -> bool:
        """Scroll down by a row, if the focus is in the last one; true if so."""
        below = int(self.focus.name) + COLUMNS
        if below < self.first + SHOWN or self.first + SHOWN >= len(self.cards):
            return False
        self._show(min(below, len(self.cards) - 1))
        return True

    def _show(self, i: int) -> None:
        """Focus a card, and scroll until it is there."""
        row, last = i // COLUMNS, self.first // COLUMNS
        self.first = COLUMNS * min(max(last, row - ROWS + 1), row)
        self.focus.set_spots(self._spots())
        self.focus.move_to(str(i))

    def _scroll(self) -> None:
        """Keep the focus on a card that exists."""
        self.first = min(self.first, max(0, COLUMNS * ((len(self.cards) - 1) // COLUMNS - ROWS + 1)))
        self.focus.set_spots(self._spots())
