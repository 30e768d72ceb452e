"""A page of rows: select, change, hold. What it changes applies at once, and settings are saved at once.

Pages of rows inherit from `SettingsPage` and say which values their rows have and what a change does.
"""

from collections.abc import Iterator, Sequence
from functools import partial

import pygame

from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.ui.draw import LABEL
from pigaming_app.ui.draw.frame_budget import Job, PrewarmQueue
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.focus import Focus
from pigaming_app.ui.widgets.labels import black_out, call_to_action, frame
from pigaming_app.ui.widgets.setting_row import SettingValue

PREWARM_MS = 2.0  # ms per frame for prewarming


class SettingsPage(Page):
    """`table`: the table of the texts of the rows; `saves`: changes are those of settings."""

    table = ""
    saves = True
    hold = 1.0  # s until `held` is called for a row whose button is held
    hints: Hints = (
        (Button.RIGHT, "options.hint_change"),
        (Button.FIRE, "options.hint_ok"),
        (Button.BACK, "options.hint_back"),
    )

    def __init__(self, context: Context, rows: Sequence[str], focused: str | None = None) -> None:
        super().__init__(context, Focus(dials.spots(rows), focused))
        self.holding = HoldTimers(context.controls, self.hold)
        self.prewarm = PrewarmQueue(self._prewarm_jobs())

    # ---- of the page

    def label(self, name: str) -> str:
        """The name of a row."""
        return self.context.words(f"{self.table}.{name}")

    def line(self, name: str) -> str:
        """The description of a row."""
        return self.context.words(f"{self.table}.{name}_line")

    def description(self, name: str) -> tuple[str, str]:
        """Heading and sentence of the panel for a row."""
        return self.label(name), self.line(name)

    def value(self, name: str) -> SettingValue:
        """The value of a row."""
        raise NotImplementedError

    def apply(self, name: str, chosen: int) -> None:
        """Apply a changed value."""
        raise NotImplementedError

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Do the action of a row of the kind "action"."""
        raise NotImplementedError

    def held(self) -> StackOperation:
        """The button of a row was held long enough, see `holding`."""
        return None

    def picture(self, name: str, chosen: int) -> LitImage:
        """The picture of a row, centred on (0, 0)."""
        raise NotImplementedError

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        """Draw the picture of a row round dials.CENTRE."""
        self.picture(name, chosen).draw(screen, *dials.CENTRE)

    # ---- values

    def action(self, key: str) -> SettingValue:
        """The value of a row with an action; `key`: of its text."""
        return SettingValue("action", (self.context.words(key),))

    def switch(self, on: bool) -> SettingValue:
        """The value of a row that is on or off."""
        return SettingValue("toggle", (self.context.words("options.off"), self.context.words("options.on")), int(on))

    # ---- rows

    @property
    def rows(self) -> tuple[str, ...]:
        """The names of the rows."""
        return tuple(spot.name for spot in self.focus.spots)

    def show_rows(self, rows: Sequence[str]) -> None:
        """Show other rows; the focus stays on its row if that is among them."""
        if self.rows != tuple(rows):
            self.focus.set_spots(dials.spots(rows))
            self.rewarm()

    def step(self, name: str, by: int) -> None:
        """Step the value of a row; it ends at its limits, or goes round."""
        value = self.value(name)
        if value.kind != "action":
            new = value.chosen + by
            self.set(name, new % value.count if value.endless else max(0, min(value.count - 1, new)))

    def fire(self, name: str, event: InputEvent) -> StackOperation:
        """FIRE on a row: its action, or the next value, cyclically."""
        value = self.value(name)
        if value.kind == "action":
            return self.activate(name, event)
        self.set(name, (value.chosen + 1) % value.count)
        return None

    def click_value(self, name: str, across: float, event: InputEvent) -> StackOperation:
        """A click `across` px from a row's left edge: does an action, steps by an arrow, or sets the value hit."""
        value = self.value(name)
        if value.kind == "action":
            return self.fire(name, event)
        if value.kind == "arrows":
            if across >= dials.AT:
                self.step(name, -1 if across < dials.AT + dials.ROOM / 2 else 1)
        elif (hit := dials.value_at(value.kind, value.options, across)) is not None:
            self.set(name, hit)
        return None

    def set(self, name: str, chosen: int) -> None:
        """Apply a value that differs, and save the settings."""
        if chosen != self.value(name).chosen:
            self.apply(name, chosen)
            self.context.sounds.play("hit" if name == "sounds" else "move")
            if self.saves:
                self.save()

    def rewarm(self) -> None:
        """Render the widgets again that the next focus moves need."""
        self.prewarm = PrewarmQueue(self._prewarm_jobs())

    # ---- scene

    def press(self, event: InputEvent) -> StackOperation:
        """Up and down select a row, left and right change it, FIRE changes or activates it."""
        before = self.focus.name
        match event.button:
            case Button.LEFT | Button.RIGHT:
                self.step(before, 1 if event.button is Button.RIGHT else -1)
            case Button.FIRE | Button.START:
                return self.fire(before, event)
            case _:
                if self.focus.handle(event) and event.button is not Button.CLICK:
                    self.context.sounds.play("move")
                if self.focus.name != before:
                    self.holding.clear()
                if event.button is Button.CLICK:
                    return self._click(event)
        return None

    def update(self, seconds: float) -> StackOperation:
        if self.holding.update(seconds) and (turn := self.held()):
            return turn
        self.prewarm.work(PREWARM_MS)
        return super().update(seconds)

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the rows, and picture and description of the focused one."""
        focus = self.focus.name
        black_out(screen, dials.PANEL)
        self.draw_rows(screen)
        frame(*dials.PANEL.size).draw(screen, *dials.PANEL.topleft)
        self.describe(screen, focus)
        self.draw_picture(screen, focus, self.value(focus).chosen)
        if self.holding.share:
            dials.ring(screen, self.holding.share)

    def draw_rows(self, screen: pygame.Surface) -> None:
        """Draw names and values of the rows."""
        labels = {name: self.label(name) for name in self.rows}
        dials.draw_rows(screen, self.focus, labels, {name: self.value(name) for name in self.rows})

    def describe(self, screen: pygame.Surface, name: str) -> None:
        """Draw the description of a row."""
        dials.describe(screen, *self.description(name))

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the message above the prompts."""
        if self.message:
            call_to_action(self.message, "", LABEL).draw(screen, 960, 926)
        self.prompts.draw(screen)

    # ---- inside

    def _prewarm_jobs(self) -> Iterator[Job]:
        """Jobs for the widgets that the next focus move needs, so that it need not wait for them."""
        for name in self.rows:
            yield partial(dials.label, self.label(name), True)
            yield partial(self._focused_value, name)
            yield partial(dials.description, *self.description(name))
            yield partial(self._picture, name)

    def _focused_value(self, name: str) -> object:
        value = self.value(name)
        return dials.value(value.kind, value.options, value.chosen, True)

    def _picture(self, name: str) -> None:
        """Render the picture of a row: draw it where nothing shows."""
        self.draw_picture(pygame.Surface((1, 1)), name, self.value(name).chosen)

    def _click(self, event: InputEvent) -> StackOperation:
        name = self.focus.spot_at(event)
        return self.click_value(name, event.at[0] - self.focus.rect(name).x, event) if name and event.at else None
