"""Table and bracket of an event on pages that turn by themselves, a poster of it, and the way to its results."""

import logging

import pygame

from pigaming_app.scenes.events import bracket_view, table_view
from pigaming_app.scenes.events.manage.corrections import ResultsList
from pigaming_app.scenes.events.manage.event_page import EventPage
from pigaming_app.scenes.events.overview import BRACKET, overview
from pigaming_app.scenes.events.poster import PosterJob
from pigaming_app.scenes.events.running import RunningEvent, progress_line
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Home, Pop, Push, StackOperation
from pigaming_app.ui.draw import ALARM, FOCUS
from pigaming_app.ui.draw.layers import backdrop
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.arrows import Arrows, as_direction, draw_arrows
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.labels import heading

IDLE = 60.0  # s without input before the return to the next match
TURN = 10.0  # s without input after which the next page is shown
MESSAGE_SECONDS = 5.0
ARROWS: Arrows = {Button.LEFT: (56, 592), Button.RIGHT: (1864, 592)}

log = logging.getLogger("pigaming")


class TablePage:
    """The pages of an event: those of a knock-out begin with its bracket, all others with the table."""

    def __init__(self, context: Context, running: RunningEvent) -> None:
        self.context, self.running = context, running
        self.age = self.idle = 0.0
        self.poster: PosterJob | None = None
        self.message, self.message_left, self.wrong = "", 0.0, False
        hints = [
            (Button.RIGHT, "events.hint_page"),
            (Button.X, "events.hint_results"),
            (Button.Y, "events.hint_poster"),
            (Button.DOWN, "events.hint_manage"),
            (Button.BACK, "events.hint_back"),
        ]
        self.prompts = context.prompts(hints)
        self._read()

    def on_enter(self) -> None:
        """First display, or return from the results, of which one may have been corrected."""
        self._read()
        self.idle = 0.0

    def handle(self, event: InputEvent) -> StackOperation:
        """LEFT and RIGHT turn the page, X shows the results, Y makes the poster, DOWN manages the event."""
        event = as_direction(self.prompts.as_button(event), ARROWS if len(self.overview.pages) > 1 else {})
        self.idle = 0.0
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
                self.poster = PosterJob(self.running.event, self.running.path, self.context.words)
            case Button.BACK | Button.FIRE | Button.START:
                self.context.sounds.play("back")
                return Pop()
            case _:
                pass
        return None

    def update(self, seconds: float) -> StackOperation:
        """Turn the pages when idle; draw the poster, part by part."""
        self.age += seconds
        self.idle += seconds
        self.message_left -= seconds
        if self.poster and self.poster.work():
            self._posted(self.poster)
            self.poster = None
        if len(self.overview.pages) > 1 and self.idle > TURN and self.age > TURN:
            self._turn(1)
        return Pop() if self.idle > IDLE and not self.running.event.over else None

    def draw(self, screen: pygame.Surface) -> None:
        words, event = self.context.words, self.running.event
        kind, number = self.overview.pages[self.page]
        screen.blit(backdrop(), (0, 0))
        line = words("events.over") if event.over else progress_line(words, event)
        heading(event.spec.title, line).draw(screen)
        if kind == BRACKET:
            bracket_view.draw_bracket(screen, self.overview.bracket[number], self.overview.stages(number))
        else:
            table_view.draw_table(screen, *self.overview.table(kind), number, self.age)
        if len(self.overview.pages) > 1:
            draw_arrows(screen, ARROWS)
        if self.poster:
            caption(words("events.drawing"), FOCUS).draw(screen, 960, self.prompts.y)
        elif self.message_left > 0.0:
            caption(self.message, ALARM if self.wrong else FOCUS).draw(screen, 960, self.prompts.y)
        else:
            self.prompts.draw(screen)

    # ---- inside

    def _read(self) -> None:
        """Derive the pages from the event, and open the one with the next match."""
        self.overview = overview(self.context.words, self.running.event)
        self.page = self.overview.first

    def _turn(self, by: int) -> None:
        self.page = (self.page + by) % len(self.overview.pages)
        self.age = 0.0

    def _posted(self, poster: PosterJob) -> None:
        self.wrong = not poster.saved
        self.message = (
            self.context.words("events.poster", name=poster.name) if poster.saved else self.context.words("app.unsaved")
        )
        self.message_left = MESSAGE_SECONDS
        self.context.sounds.play("error" if self.wrong else "ready")
