"""An event as its operator sees it: another title, an entrant who withdraws, the end of the event and its files.

Whatever cannot be undone needs a button that is held; in a kiosk everything does, much longer.
"""

import logging
from pathlib import Path

from pigaming_app.events import event_files
from pigaming_app.events.spec import MAX_TITLE
from pigaming_app.scenes.events.desk.host import can_serve
from pigaming_app.scenes.events.manage.desk_page import DeskPage
from pigaming_app.scenes.events.running import RunningEvent, progress_line
from pigaming_app.scenes.flow.access import HOLD, Right, Roles
from pigaming_app.scenes.flow.scene import Context, Pop, Push, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import ALARM, FOCUS, GlowCanvas, icon
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets import setting_row
from pigaming_app.ui.widgets.labels import heading
from pigaming_app.ui.widgets.setting_row import SettingValue

RENAME, WITHDRAW, DESK, DELETE = "rename", "withdraw", "desk", "delete"
WEEK, DAY = "close_week", "close_day"
SIGNS = {RENAME: "pencil", WITHDRAW: "cross", DESK: "phone", DELETE: "cross", WEEK: "check", DAY: "check"}

log = logging.getLogger("pigaming")


class EventPage(SettingsPage):
    """The event in a file; `running` is None if the file is damaged. `gone`: the way out after it has been deleted."""

    right, table, saves = Right.EVENTS, "events", False
    idle, when_idle, stay = 60.0, Pop(), 5.0

    def __init__(self, context: Context, path: Path, running: RunningEvent | None, gone: StackOperation) -> None:
        self.path, self.running, self.gone = path, running, gone
        self.roles = context.shared(Roles)
        self.hold = self.roles.hold
        self.serves = can_serve()
        self.chosen = 0  # among those who have not withdrawn
        super().__init__(context, self._rows)

    def on_enter(self) -> None:
        """First display, or return from the title."""
        self.holding.clear()

    @property
    def _rows(self) -> tuple[str, ...]:
        if self.running is None:
            return (DELETE,)
        event, desk = self.running.event, (DESK,) if self.serves else ()
        if event.over or not self.present:
            return (RENAME, *desk, DELETE)
        on_call = event.progress.kind.on_call
        close = (WEEK if on_call.periods(event.spec) > 1 else DAY,) if on_call else ()
        return (RENAME, *close, WITHDRAW, *desk, DELETE)

    @property
    def present(self) -> list[str]:
        """Who has not withdrawn."""
        event = self.running.event if self.running else None
        return [one.name for one in event.entrants if one.name not in event.withdrawn] if event else []

    @property
    def heading(self) -> LitImage:
        words = self.context.words
        if not self.running:
            return heading(words("events.damaged", name=self.path.name))
        event = self.running.event
        return heading(event.spec.title, words("events.over") if event.over else progress_line(words, event))

    def value(self, name: str) -> SettingValue:
        if name == WITHDRAW:
            return SettingValue("arrows", tuple(self.present), min(self.chosen, len(self.present) - 1), endless=True)
        texts = {RENAME: "events.change", DESK: "options.open", DELETE: "options.clear"}
        return self.action(texts.get(name, "events.close"))

    def apply(self, name: str, chosen: int) -> None:
        self.holding.clear()
        self.chosen = chosen

    def fire(self, name: str, event: InputEvent) -> StackOperation:
        """FIRE renames, or opens the page of the desk; held, it withdraws or deletes."""
        if name == DESK:
            self.context.sounds.play("accept")
            return Push(DeskPage(self.context))
        if name == RENAME and self.hold == HOLD:
            return self._open_title()
        self.context.sounds.play("move")
        self.holding.begin(event)
        return None

    def click_value(self, name: str, across: float, event: InputEvent) -> StackOperation:
        """A click between the arrows of a row withdraws, held."""
        on_name = 60 < across - setting_row.AT < setting_row.ROOM - 60
        return self.fire(name, event) if on_name else super().click_value(name, across, event)

    def advance(self, seconds: float) -> StackOperation:
        """Follow the event, which changes elsewhere, too."""
        self.show_rows(self._rows)
        return None

    def held(self) -> StackOperation:
        acts = {RENAME: self._open_title, DELETE: self._delete, WEEK: self._close, DAY: self._close}
        return acts.get(self.focus.name, self._withdraw)()

    def picture(self, name: str, chosen: int) -> LitImage:
        return sign(SIGNS[name], name not in (RENAME, DESK))

    draw_foot = Page.draw_foot

    # ---- inside

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
        return None

    def _close(self) -> StackOperation:
        assert self.running
        words = self.context.words
        try:
            saved = self.running.change(lambda event: event.close())
            self._tell(words("events.closed") if saved else words("app.unsaved"), not saved)
        except ValueError as reason:
            log.warning("%s", reason)
            self._tell(words("events.elsewhere"), True)
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
        self.show_message(sentence, wrong)
        self.context.sounds.play("error" if wrong else "ready")


@cached
def sign(name: str, grave: bool) -> LitImage:
    """The picture of a row, centred on (0, 0)."""
    half = 160
    ink = GlowCanvas(2 * half, 2 * half)
    icon(ink, name, half, half, 70, ALARM if grave else FOCUS, 8)
    return LitImage(ink.lit(1.0), (-half, -half))
