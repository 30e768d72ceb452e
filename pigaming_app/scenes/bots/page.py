"""The operator's page of bots: who may connect, where, and the key of each."""

import pygame

from pigaming_app.ai.bots import brains
from pigaming_app.ai.bots.book import LONGEST_NAME, PREFIX
from pigaming_app.scenes.bots.host import bot_host
from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LINE, MIST, GlowCanvas
from pigaming_app.ui.draw.layers import LEFT, RIGHT, SMALLEST, LitImage, fit_text, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.setting_row import SettingValue

SWITCHES = {"enabled": "bots", "vision": "bots_vision"}  # settings of the rows that are switches
ROWS = (*SWITCHES, "new")
SHOWN = 6  # bots; the others are left to the command line
LETTERS = "abcdefghijklmnopqrstuvwxyz0123456789-_"
STATUS_Y = 924  # px: the address
KEY_ROW, KEY_SIZE, KEY_PITCH = 8, 54, 72  # digits of a key in a row; px, of a digit and from row to row


class BotsPage(SettingsPage):
    """The page. Changes apply and are saved at once; holding FIRE on a bot removes it."""

    right = Right.SETTINGS
    table, title = "bots", "bots.title"

    def __init__(self, context: Context) -> None:
        self.host = context.shared(bot_host)
        super().__init__(context, self._rows())

    def _rows(self) -> tuple[str, ...]:
        return (*ROWS, *(PREFIX + name for name in sorted(brains.book().keys)[:SHOWN]))

    def label(self, name: str) -> str:
        return super().label(name) if name in ROWS else name.removeprefix(PREFIX)

    def line(self, name: str) -> str:
        if name in ROWS:
            return super().line(name)
        return self.context.words("bots.plays" if brains.line_of(self.label(name)).connected else "bots.away")

    def value(self, name: str) -> SettingValue:
        if name in SWITCHES:
            return self.switch(getattr(self.context.settings, SWITCHES[name]))
        return self.action("options.open" if name == "new" else "bots.remove")

    def apply(self, name: str, chosen: int) -> None:
        setattr(self.context.settings, SWITCHES[name], bool(chosen))

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Type the name of a new bot, or begin to remove one."""
        if name == "new":
            self.context.sounds.play("accept")
            label = self.label("new")
            return Push(TextPage(self.context, label, "", LONGEST_NAME, self._add, True, LETTERS))
        self.holding.begin(event)
        return None

    def held(self) -> StackOperation:
        """Remove the bot with the focus."""
        try:
            brains.book().remove(self.label(self.focus.name))
        except (ValueError, NotSaved) as reason:
            self.show_message(str(reason), wrong=True)
        self.context.sounds.play("back")
        self.show_rows(self._rows())
        return None

    def _add(self, name: str) -> str:
        """Add a bot; the reason why not, if it cannot be."""
        name = name.lower()
        if name in brains.book().keys:
            return self.context.words("bots.taken")
        try:
            brains.book().add(name)
        except (ValueError, NotSaved):
            return self.context.words("bots.wrong")
        self.show_rows(self._rows())
        self.focus.move_to(PREFIX + name)
        return ""

    def paint(self, screen: pygame.Surface) -> None:
        super().paint(screen)
        if not self.message:
            line, size = fit_text(self._status(), SMALLEST, RIGHT - LEFT - 40, "body")
            text(line, size, ALARM if self.host.trouble else MIST, "body", "l").draw(screen, LEFT + 40, STATUS_Y)

    def _status(self) -> str:
        words, host = self.context.words, self.host
        if host.trouble:
            return words(f"phones.{host.trouble.key}", **host.trouble.values)
        return words("bots.listening", address=host.url) if host.url else words("bots.are_off")

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        """A program, or the key of a bot."""
        key, (x, y) = brains.book().keys.get(name.removeprefix(PREFIX), ""), dials.CENTRE
        if not key:
            picture(chosen).draw(screen, x, y)
        for row, start in enumerate(range(0, len(key), KEY_ROW)):
            digits = f"{key[start : start + KEY_ROW // 2]} {key[start + KEY_ROW // 2 : start + KEY_ROW]}"
            text(digits, KEY_SIZE, ICE, "head", "c").draw(screen, x, y + KEY_PITCH * (row - 1.5))


def sketch(ink: GlowCanvas, beat: int) -> None:
    """Draw a program: two brackets, and a line of text between them that grows."""
    for side in (-1, 1):
        ink.line([(side * 80, -90), (side * 150, 0), (side * 80, 90)], FOCUS, LINE)
    for row, width in enumerate((60, 90 if beat else 30)):
        y = -24 + 48 * row
        ink.line([(-45, y), (-45 + width, y)], ICE, LINE)


@cached
def picture(chosen: int) -> LitImage:
    """A program, centred on (0, 0)."""
    ink = GlowCanvas(480, 340).set_transform(240, 170)
    sketch(ink, chosen)
    return LitImage(ink.lit(), (-240, -170))
