"""Table and bracket of an event on pages that turn by themselves, a poster of it, and the way to its results."""

import logging

import pygame

from pigaming_app.scenes.events import bracket_view, table_view
from pigaming_app.scenes.events.manage.corrections import ResultsList
from pigaming_app.scenes.events.manage.event_page import EventPage
from pigaming_app.scenes.events.overview import BRACKET, GROUPS, TEAM_FIGURES, heads_of, overview
from pigaming_app.scenes.events.paper.poster import print_poster
from pigaming_app.scenes.events.paper.sheet import PrintJob
from pigaming_app.scenes.events.running import RunningEvent, progress_line
from pigaming_app.scenes.flow.scene import Context, Home, Pop, Push, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.arrows import Arrows, as_direction, draw_arrows
from pigaming_app.ui.widgets.labels import heading

LOOK = 1.0  # s between two looks at the file
TURN = 10.0  # s without input after which the next page is shown
ARROWS: Arrows = {Button.LEFT: (56, 592), Button.RIGHT: (1864, 592)}

log = logging.getLogger("pigaming")


class TablePage(Page):
    """The pages of an event: those of a knock-out begin with its bracket, all others with the table."""

    idle, when_idle, stay = 60.0, Pop(), 5.0
    closing = Button.FIRE, Button.START
    hints = (
        (Button.RIGHT, "events.hint_page"),
        (Button.X, "events.hint_results"),
        (Button.Y, "events.hint_poster"),
        (Button.DOWN, "events.hint_manage"),
        (Button.BACK, "events.hint_back"),
    )

    def __init__(self, context: Context, running: RunningEvent) -> None:
        super().__init__(context)
        self.running, self.turned, self.looked = running, 0.0, 0.0
        self.poster: PrintJob | None = None
        self._read()

    def on_enter(self) -> None:
        """First display, or return from the results, of which one may have been corrected."""
        self._read()
        self.untouched = 0.0

    @property
    def resting(self) -> float:
        return 0.0 if self.running.event.over else self.untouched

    def press(self, event: InputEvent) -> StackOperation:
        """LEFT and RIGHT turn the page, X shows the results, Y makes the poster, DOWN manages the event."""
        event = as_direction(event, ARROWS if len(self.overview.pages) > 1 else {})
        match event.button:
            case Button.LEFT | Button.RIGHT:
                self._turn(1 if event.button is Button.RIGHT else -1)
                self.context.sounds.play("move")
            case Button.X:
                self.context.sounds.play("accept")
                return Push(ResultsList(self.context, self.running))
            case Button.DOWN:
                self.context.sounds.play("accept")
                return Push(EventPage(self.context, self.running.path, self.running, Home()))
            case Button.Y if self.poster is None:
                self.context.sounds.play("accept")
                self.wrong = False
                self.poster = print_poster(self.running.event, self.running.path, self.context.words)
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Turn the pages when idle; draw the poster, part by part."""
        self.turned += seconds
        self.looked += seconds
        if self.looked > LOOK:
            self._look()
        if self.poster and self.poster.work():
            self._posted(self.poster)
            self.poster = None
        if len(self.overview.pages) > 1 and self.untouched > TURN and self.turned > TURN:
            self._turn(1)
        return None

    @property
    def heading(self) -> LitImage:
        words, event = self.context.words, self.running.event
        return heading(event.spec.title, words("events.over") if event.over else progress_line(words, event))

    def paint(self, screen: pygame.Surface) -> None:
        """Draw a page of the table, or of the bracket."""
        kind, number = self.overview.pages[self.page]
        if kind == BRACKET:
            bracket_view.draw_bracket(screen, self.overview.bracket[number], self.overview.stages(number))
        elif kind == GROUPS:
            table_view.draw_groups(screen, self.overview.groups, heads_of(self.context.words, TEAM_FIGURES), number)
        else:
            table_view.draw_table(screen, *self.overview.table(kind), number, self.turned)
        if len(self.overview.pages) > 1:
            draw_arrows(screen, ARROWS)

    @property
    def message(self) -> str:
        return self.context.words("events.drawing") if self.poster else super().message

    # ---- inside

    def _read(self) -> None:
        """Derive the pages from the event, and open the one with the next match."""
        self.overview = overview(self.context.words, self.running.event)
        self.page = self.overview.first

    def _look(self) -> None:
        """Follow what others have changed, on the same page."""
        before, self.looked = self.running.event, 0.0
        self.running.refresh()
        if self.running.event is not before:
            page = self.page
            self._read()
            self.page = min(page, len(self.overview.pages) - 1)

    def _turn(self, by: int) -> None:
        self.page = (self.page + by) % len(self.overview.pages)
        self.turned = 0.0

    def _posted(self, poster: PrintJob) -> None:
        words = self.context.words
        line = words("events.poster", name=poster.name) if poster.saved else words("app.unsaved")
        self.show_message(line, wrong=not poster.saved)
        self.context.sounds.play("ready" if poster.saved else "error")
