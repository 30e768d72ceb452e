"""What was deleted in the last 30 days, to be brought back; outside a kiosk, to be deleted for good."""

import logging
from datetime import datetime

import pygame

from pigaming_app.scenes.flow.access import Right, Roles
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.storage import trash
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.trash import Deleted
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, THIN, cut_box, icon
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, fit_text, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out

ROWS, TOP, HIGH, PITCH = 7, 212, 88, 104  # px
SIGNS = {"events": "crown", "arenas": "pencil", "robots": "ai", "replays": "play"}
NONE = "none"

log = logging.getLogger("pigaming")


class TrashPage(Page):
    """Paged rows, what was deleted last first."""

    right, untimed = Right.RESTORE, True
    title, stay = "trash.title", 5.0

    def __init__(self, context: Context) -> None:
        super().__init__(context, Focus([FocusSpot(NONE, row_box(0))]))
        self.roles = context.shared(Roles)
        self.holding = HoldTimers(context.controls, self.roles.hold)
        self.page = 0
        self.found: list[Deleted] = []
        self._read()

    @property
    def hints(self) -> Hints:
        if not self.found:
            return ((Button.BACK, "options.hint_back"),)
        page = [(Button.RIGHT, "lab.hint_page")] if self.pages > 1 else []
        own = [] if self.context.kiosk else [(Button.X, "trash.hint_empty")]
        return [(Button.FIRE, "trash.hint_restore"), *page, *own, (Button.BACK, "options.hint_back")]

    @property
    def subtitle(self) -> str:
        return f"{self.page + 1} / {self.pages}" if self.pages > 1 else ""

    @property
    def pages(self) -> int:
        return max(1, -(-len(self.found) // ROWS))

    def press(self, event: InputEvent) -> StackOperation:
        """LEFT and RIGHT turn the page, X held empties the trash."""
        if event.button in (Button.LEFT, Button.RIGHT):
            self.page = (self.page + (1 if event.button is Button.RIGHT else -1)) % self.pages
            self._show()
            self.context.sounds.play("move")
            return None
        if event.button is Button.X and self.found and self.roles.may(event.device, Right.OWN):
            self.holding.begin(event)
            self.show_message(self.context.words("trash.hold"))
            return None
        return super().press(event)

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        """Bring it back."""
        if name == NONE:
            return self.leave()
        one = self.found[int(name)]
        try:
            place = trash.restore(one)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.show_message(self.context.words("app.unsaved"), wrong=True)
            self.context.sounds.play("error")
            return None
        self._read()
        self.show_message(self.context.words("trash.restored", name=place.stem))
        self.context.sounds.play("ready")
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Empty the trash once X has been held long enough."""
        if self.holding.update(seconds):
            trash.empty()
            self._read()
            self.show_message(self.context.words("trash.emptied"))
            self.context.sounds.play("ready")
        return None

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the rows of this page."""
        words, now = self.context.words, datetime.now()
        if not self.found:
            text(words("trash.none"), LABEL, MIST, "head").draw(screen, 960, 520)
            return
        black_out(screen, *(spot.rect for spot in self.focus.spots))
        for spot in self.focus.spots:
            one = self.found[int(spot.name)]
            kind = words(f"trash.{one.kind}") if one.kind in SIGNS else one.kind
            left = words("trash.left", when=words.moment(one.at), days=one.days_left(now))
            sign = SIGNS.get(one.kind, "list")
            row(sign, one.name, kind, left, spot.name == self.focus.name).draw(screen, *spot.rect.topleft)
        self.focus.draw(screen)

    # ---- inside

    def _read(self) -> None:
        self.found = trash.deleted()
        self.page = min(self.page, self.pages - 1)
        self._show()

    def _show(self) -> None:
        shown = range(self.page * ROWS, min(len(self.found), (self.page + 1) * ROWS))
        spots = [FocusSpot(str(place), row_box(i)) for i, place in enumerate(shown)]
        self.focus.set_spots(spots or [FocusSpot(NONE, row_box(0))])


def row_box(i: int) -> pygame.Rect:
    """Rectangle of the i-th row."""
    return pygame.Rect(LEFT, TOP + PITCH * i, RIGHT - LEFT, HIGH)


@cached
def row(sign: str, name: str, kind: str, left: str, hot: bool) -> LitImage:
    """A row; top left at (0, 0)."""
    w = RIGHT - LEFT
    layer = Layer(0, 0, w, HIGH)
    layer.glow.line(cut_box(0, 0, w, HIGH, 16), FOCUS if hot else STEEL, THIN, True)
    icon(layer.glow, sign, 58, HIGH / 2, 22, FOCUS if hot else MIST, 4)
    name, size = fit_text(name, LABEL, 690, "head", BODY)
    layer.canvas.text(name, size, 116, HIGH / 2, FOCUS if hot else ICE, "head")
    layer.canvas.body(kind, 830, HIGH / 2, MIST, "l", fit_size(kind, BODY, 240, "body"))
    layer.canvas.body(left, w - 40, HIGH / 2, ICE if hot else MIST, "r", fit_size(left, BODY, 600, "body"))
    return layer.render()
