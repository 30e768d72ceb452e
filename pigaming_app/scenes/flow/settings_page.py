"""A page of setting rows: select, change, hold; changes apply and are saved immediately.

Pages of rows inherit from `SettingsPage` and say which values their rows have and what a change does.
"""

import logging
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import pygame

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import Home, StackOperation
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import LABEL
from pigaming_app.ui.draw.frame_budget import Job, PrewarmQueue
from pigaming_app.ui.draw.layers import backdrop
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.focus import Focus
from pigaming_app.ui.widgets.labels import black_out, call_to_action, frame, heading
from pigaming_app.ui.widgets.setting_row import SettingValue

IDLE = 90.0  # s without input until the title
SENTENCE_SECONDS = 4.0  # s for which a sentence is shown
PREWARM_MS = 2.0  # ms per frame for prewarming
HINTS = [
    (Button.RIGHT, "options.hint_change"),
    (Button.FIRE, "options.hint_ok"),
    (Button.BACK, "options.hint_back"),
]
log = logging.getLogger("pigaming")


class SettingsPage:
    """`table`: the table of the texts of the rows; `title`: key of the heading; `hold`: s until `held` is called for a
    row whose button is held.
    """

    def __init__(self, context: Context, table: str, title: str, rows: Sequence[str], hold: float = 1.0) -> None:
        self.context, self.table, self.title, self.rows = context, table, title, tuple(rows)
        self.subtitle = ""  # key of the text beside the heading
        self.clock = 0.0
        self.focus = Focus(dials.spots(self.rows))
        self.holding = HoldTimers(context.controls, hold)
        self.prewarm = PrewarmQueue(self._prewarm_jobs())
        self.navigation = Navigation(context, self.focus, HINTS, IDLE, SENTENCE_SECONDS)

    # ---- of the page

    def label(self, name: str) -> str:
        """The name of a row."""
        return self.context.words(f"{self.table}.{name}")

    def line(self, name: str) -> str:
        """The description of a row."""
        return self.context.words(f"{self.table}.{name}_line")

    def value(self, name: str) -> SettingValue:
        """The value of a row."""
        raise NotImplementedError

    def apply(self, name: str, chosen: int) -> None:
        """Apply a changed value."""
        raise NotImplementedError

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Do the action of a row of the kind "deed"."""
        raise NotImplementedError

    def held(self) -> StackOperation:
        """The button of a row was held long enough, see `holding`."""
        return None

    def when_idle(self) -> StackOperation:
        """Nobody has touched the page for a while."""
        return Home()

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        """Draw the picture of a row round dials.CENTRE."""
        raise NotImplementedError

    def render_picture(self, name: str, chosen: int) -> object:
        """Render the picture of a row before it is needed."""
        return None

    # ---- scene

    def on_enter(self) -> None:
        pass

    def handle(self, event: InputEvent) -> StackOperation:
        """Up and down select a row, left and right change it, FIRE changes or activates it."""
        event = self.navigation.prompts.as_button(event)
        match event.button:
            case Button.LEFT | Button.RIGHT:
                self._step(1 if event.button is Button.RIGHT else -1)
            case Button.FIRE | Button.START:
                return self._do(event)
            case Button.CLICK:
                self.focus.handle(event)
                return self._click(event)
            case _:
                before, turn = self.focus.name, self.navigation.handle(event)
                if self.focus.name != before:
                    self.holding.clear()
                return turn
        return None

    def update(self, seconds: float) -> StackOperation:
        self.clock += seconds
        if self.holding.update(seconds) and (turn := self.held()):
            return turn
        self.prewarm.work(PREWARM_MS)
        return self.when_idle() if self.navigation.update(seconds) else None

    def draw(self, screen: pygame.Surface) -> None:
        words, focus = self.context.words, self.focus.name
        screen.blit(backdrop(), (0, 0))
        heading(words(self.title), words(self.subtitle) if self.subtitle else "").draw(screen)
        black_out(screen, dials.PANEL)
        values = {name: self.value(name) for name in self.rows}
        dials.draw_rows(screen, self.focus, {name: self.label(name) for name in self.rows}, values)
        frame(*dials.PANEL.size).draw(screen, *dials.PANEL.topleft)
        dials.describe(screen, self.label(focus), self.line(focus))
        self.draw_picture(screen, focus, values[focus].chosen)
        if self.holding.share:
            dials.ring(screen, self.holding.share)
        if self.navigation.sentence:
            call_to_action(self.navigation.sentence, "", LABEL).draw(screen, 960, 926)
        self.navigation.prompts.draw(screen)

    # ---- rows

    def rewarm(self) -> None:
        """Render the widgets again that the next focus moves need."""
        self.prewarm = PrewarmQueue(self._prewarm_jobs())

    def save(self, write: Callable[[], None] | None = None) -> None:
        """Save the settings, or what `write` saves; on failure, show a sentence."""
        try:
            write() if write else self.context.settings.save(folders().config)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.navigation.show_message(self.context.words("app.unsaved"))

    def _prewarm_jobs(self) -> Iterator[Job]:
        """Jobs for the widgets that the next focus move needs, so that it need not wait for them."""
        for name in self.rows:
            yield partial(dials.label, self.label(name), True)
            yield partial(self._focused_value, name)
            yield partial(dials.description, self.label(name), self.line(name))
            yield partial(self._picture, name)

    def _focused_value(self, name: str) -> object:
        value = self.value(name)
        return dials.value(value.kind, value.options, value.chosen, True)

    def _picture(self, name: str) -> object:
        return self.render_picture(name, self.value(name).chosen)

    def _step(self, by: int) -> None:
        """Step the value of the focused row; it ends at its limits."""
        value = self.value(self.focus.name)
        if value.kind != "deed":
            self._set(self.focus.name, max(0, min(value.count - 1, value.chosen + by)))

    def _do(self, event: InputEvent) -> StackOperation:
        """FIRE: the next value, cyclically, or the action."""
        value = self.value(self.focus.name)
        if value.kind == "deed":
            return self.activate(self.focus.name, event)
        self._set(self.focus.name, (value.chosen + 1) % value.count)
        return None

    def _click(self, event: InputEvent) -> StackOperation:
        name = self.focus.spot_at(event)
        if name is None or event.at is None:
            return None
        value = self.value(name)
        if value.kind == "deed":
            return self._do(event)
        hit = dials.value_at(value.kind, value.options, value.chosen, event.at[0] - self.focus.rect(name).x)
        if hit is not None:
            self._set(name, hit)
        return None

    def _set(self, name: str, chosen: int) -> None:
        """Apply and save a value that differs."""
        if chosen != self.value(name).chosen:
            self.apply(name, chosen)
            self.context.sounds.play("hit" if name == "sounds" else "move")
            self.save()
