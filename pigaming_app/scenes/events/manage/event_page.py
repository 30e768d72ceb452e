"""An event as its operator sees it: another title, an entrant who withdraws, the end of the event and its files.

Whatever cannot be undone needs a button that is held; in a kiosk everything does, much longer.
"""

import logging
from pathlib import Path

import pygame

from pigaming_app.events import event_files
from pigaming_app.events.spec import MAX_TITLE
from pigaming_app.scenes.events.manage.text_page import TextPage
from pigaming_app.scenes.events.running import RunningEvent, progress_line
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import Pop, Push, StackOperation
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import ALARM, FOCUS, GlowCanvas, icon
from pigaming_app.ui.draw.layers import LitImage, backdrop
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets import setting_row
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.focus import Focus
from pigaming_app.ui.widgets.labels import black_out, frame, heading
from pigaming_app.ui.widgets.setting_row import SettingValue

IDLE, MESSAGE_SECONDS = 60.0, 5.0  # s
HOLD, HOLD_IN_KIOSK = 1.0, 5.0  # s
RENAME, WITHDRAW, DELETE = "rename", "withdraw", "delete"
SIGNS = {RENAME: "pencil", WITHDRAW: "cross", DELETE: "cross"}

log = logging.getLogger("pigaming")


class EventPage:
    """The event in a file; `running` is None if the file is damaged. `gone`: the way out after it has been deleted."""

    def __init__(self, context: Context, path: Path, running: RunningEvent | None, gone: StackOperation) -> None:
        self.context, self.path, self.running, self.gone = context, path, running, gone
        self.chosen = 0  # among those who have not withdrawn
        self.focus = Focus(setting_row.spots(self.rows))
        self.holding = HoldTimers(context.controls, HOLD_IN_KIOSK if context.kiosk else HOLD)
        hints = [
            (Button.RIGHT, "options.hint_change"),
            (Button.FIRE, "options.hint_ok"),
            (Button.BACK, "events.hint_back"),
        ]
        self.navigation = Navigation(context, self.focus, hints, IDLE, MESSAGE_SECONDS)
        self.wrong = False  # the message is bad news

    def on_enter(self) -> None:
        """First display, or return from the title."""
        self.holding.clear()

    @property
    def rows(self) -> tuple[str, ...]:
        if self.running is None:
            return (DELETE,)
        return (RENAME, WITHDRAW, DELETE) if self.present and not self.running.event.over else (RENAME, DELETE)

    @property
    def present(self) -> list[str]:
        """Who has not withdrawn."""
        event = self.running.event if self.running else None
        return [one.name for one in event.entrants if one.name not in event.withdrawn] if event else []

    def handle(self, event: InputEvent) -> StackOperation:
        """LEFT and RIGHT choose an entrant, FIRE renames; held, it withdraws or deletes."""
        event = self.navigation.prompts.as_button(event)
        row = self.focus.name
        if event.button is Button.CLICK:
            self.focus.handle(event)
            row = self.focus.spot_at(event) or ""
        if row == WITHDRAW and (by := setting_row.step_of(event, self.focus, self._value(row))):
            self.holding.clear()
            if event.button is not Button.CLICK or (event.at and not self._on_name(event.at[0])):
                self.chosen = (self.chosen + by) % len(self.present)
                self.context.sounds.play("move")
                return None
        if row and event.button in (Button.FIRE, Button.START, Button.CLICK):
            return self._activate(row, event)
        if event.button in (Button.UP, Button.DOWN, Button.POINT, Button.BACK):
            before, turn = self.focus.name, self.navigation.handle(event)
            if self.focus.name != before:
                self.holding.clear()
            return turn
        return None

    def update(self, seconds: float) -> StackOperation:
        """Animate; act once a button has been held long enough; leave when idle."""
        self.navigation.update(seconds)
        if self.holding.update(seconds):
            return {RENAME: self._open_title, DELETE: self._delete}.get(self.focus.name, self._withdraw)()
        return Pop() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        words, row = self.context.words, self.focus.name
        screen.blit(backdrop(), (0, 0))
        if self.running:
            event = self.running.event
            heading(event.spec.title, words("events.over") if event.over else progress_line(words, event)).draw(screen)
        else:
            heading(words("events.damaged", name=self.path.name)).draw(screen)
        black_out(screen, setting_row.PANEL)
        setting_row.draw(screen, words, self.focus, "events", {name: self._value(name) for name in self.rows})
        frame(*setting_row.PANEL.size).draw(screen, *setting_row.PANEL.topleft)
        sign(SIGNS[row], row != RENAME).draw(screen, *setting_row.CENTRE)
        setting_row.describe(screen, words(f"events.{row}"), words(f"events.{row}_line"))
        if self.holding.share:
            setting_row.ring(screen, self.holding.share)
        if self.navigation.sentence:
            caption(self.navigation.sentence, ALARM if self.wrong else FOCUS).draw(
                screen, 960, self.navigation.prompts.y
            )
        else:
            self.navigation.prompts.draw(screen)

    # ---- inside

    def _value(self, row: str) -> SettingValue:
        words = self.context.words
        if row == WITHDRAW:
            return SettingValue("arrows", tuple(self.present), min(self.chosen, len(self.present) - 1))
        return SettingValue("deed", (words("events.change" if row == RENAME else "options.clear"),))

    def _on_name(self, x: float) -> bool:
        """True between the two arrows of a row."""
        across = x - self.focus.spot.rect.x - setting_row.AT
        return 60 < across < setting_row.ROOM - 60

    def _activate(self, row: str, event: InputEvent) -> StackOperation:
        if row == RENAME and not self.context.kiosk:
            return self._open_title()
        self.context.sounds.play("move")
        self.holding.begin(event)
        return None

    def _open_title(self) -> StackOperation:
        assert self.running
        self.context.sounds.play("accept")
        title = self.running.event.spec.title
        return Push(TextPage(self.context, self.context.words("events.rename"), title, MAX_TITLE, self._rename))

    def _rename(self, title: str) -> str:
        """Take another title; returns the sentence why not, or an empty one."""
        assert self.running
        words = self.context.words
        try:
            return "" if self.running.change(lambda event: event.renamed(title)) else words("app.unsaved")
        except ValueError as reason:
            log.warning("%s", reason)
            return words("events.no_title")

    def _withdraw(self) -> StackOperation:
        assert self.running
        words, name = self.context.words, self.present[min(self.chosen, len(self.present) - 1)]
        try:
            saved = self.running.change(lambda event: event.withdraw(name))
            self._tell(words("events.withdrew", name=name) if saved else words("app.unsaved"), not saved)
        except ValueError as reason:
            log.warning("%s", reason)
            self._tell(words("events.elsewhere"), True)
        self.chosen = 0
        self.focus.set_spots(setting_row.spots(self.rows))
        return None

    def _delete(self) -> StackOperation:
        try:
            event_files.delete(self.path)
        except NotSaved as reason:
            log.warning("%s", reason)
            self._tell(self.context.words("events.undeleted"), True)
            return None
        self.context.sounds.play("ready")
        return self.gone

    def _tell(self, sentence: str, wrong: bool) -> None:
        self.wrong = wrong
        self.navigation.show_message(sentence)
        self.context.sounds.play("error" if wrong else "ready")


@cached
def sign(name: str, grave: bool) -> LitImage:
    """The picture of a row, centred on (0, 0)."""
    half = 160
    ink = GlowCanvas(2 * half, 2 * half)
    icon(ink, name, half, half, 70, ALARM if grave else FOCUS, 8)
    return LitImage(ink.lit(1.0), (-half, -half))
