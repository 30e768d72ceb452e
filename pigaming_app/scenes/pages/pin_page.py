"""The operator's PIN, typed on the keyboard or chosen digit by digit with pad or mouse: entered, or set by typing it
twice.
"""

import logging
import math

import pygame

from pigaming_app.scenes.flow.access import Right, Roles
from pigaming_app.scenes.flow.scene import Context, Pop, Push, Scene, StackOperation, Swap
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.storage.pin import LONGEST, SHORTEST, is_easy
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import Layer, LitImage, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import LEVELS, dimmed

W, H, GAP, TOP = 196, 112, 22, 384  # px: a key, between two, the first row
ROWS = ("123", "456", "789", "<0>")  # < erases, > is OK
SIGNS = {"<": "turn_left", ">": "check"}
DOTS_Y, LINE_Y = 300, 230  # px
DOT, PITCH = 13, 62  # px, of a digit that was typed

log = logging.getLogger("pigaming")


class DigitsPage(Page):
    """Asks for digits. `right`: visitors may try."""

    right = Right.PLAY
    title, when_idle, idle = "access.title", Pop(), 30.0
    back = "options.hint_back"  # key of what BACK does

    def __init__(self, context: Context) -> None:
        super().__init__(context, Focus([FocusSpot(sign, box) for sign, box in boxes().items()], "5"))
        self.roles = context.shared(Roles)
        self.device: Device | None = None  # which has begun; nobody else types into it
        self.digits = ""
        self.line, self.bad = "", False

    # ---- of the page

    def complete(self, device: Device) -> StackOperation:
        """Act on the digits."""
        raise NotImplementedError

    # ---- scene

    @property
    def hints(self) -> Hints:
        typed = self.context.controls.last.kind == "keys"
        ways_out = [(Button.START, "options.hint_ok"), (Button.BACK, self.back)]
        return [*([] if typed else [(Button.FIRE, "access.hint_digit")]), *ways_out]

    def on_enter(self) -> None:
        """Take over the digits of the keyboard."""
        self.context.controls.typist = self.type

    def on_leave(self) -> None:
        """Give the keyboard back."""
        self.context.controls.typist = None

    def type(self, letter: str) -> None:
        """A typed digit, or a backspace."""
        self.untouched = 0.0
        if letter == "\b":
            self._erase()
        elif letter.isascii() and letter.isdigit():
            self._add(letter)

    def handle(self, event: InputEvent) -> StackOperation:
        """Act on the device that has begun; phones never do."""
        mine = event.device if event.device.kind == "pad" else Device("keys")
        if event.device.kind == "phone" or self.device not in (None, mine):
            return None
        if event.button not in (Button.POINT, Button.FOUND, Button.LOST):
            self.device = mine
        return super().handle(event)

    def press(self, event: InputEvent) -> StackOperation:
        """X erases, START is OK."""
        if event.button is Button.START:
            return self.complete(event.device)
        if event.button is Button.X:
            self._erase()
            return None
        return super().press(event)

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        if name == ">":
            return self.complete(event.device)
        if name == "<":
            self._erase()
        else:
            self._add(name)
        return None

    def leave(self) -> StackOperation:
        """Erase the last digit; leave without any."""
        if not self.digits:
            return super().leave()
        self._erase()
        return None

    @property
    def resting(self) -> float:
        return self.untouched

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the sentence, a dot for each digit, and the keys."""
        line, color = self.sentence
        text(line, kit.BODY, color, "body", "c", 1700).draw(screen, 960, LINE_Y)
        count = len(self.digits)
        for i in range(max(count, SHORTEST)):
            x = 960 + (i - (max(count, SHORTEST) - 1) / 2) * PITCH
            dot(i < count).draw(screen, x, DOTS_Y)
        for spot in self.focus.spots:
            key(spot.name, spot.name == self.focus.name).draw(screen, *spot.rect.topleft)
        self.focus.draw(screen)

    @property
    def sentence(self) -> tuple[str, kit.Color]:
        """What is asked, or what was wrong, and its colour."""
        return self.line, kit.ALARM if self.bad else kit.ICE

    def tell(self, key: str, bad: bool = False) -> None:
        """Say what comes next, and begin anew with the digits."""
        self.digits, self.line, self.bad = "", self.context.words(key, least=SHORTEST, most=LONGEST), bad
        self.context.sounds.play("refused" if bad else "accept")

    # ---- inside

    def _add(self, digit: str) -> None:
        full = len(self.digits) >= LONGEST
        self.digits += "" if full else digit
        self.context.sounds.play("refused" if full else "move")

    def _erase(self) -> None:
        self.context.sounds.play("back" if self.digits else "refused")
        self.digits = self.digits[:-1]


class PinPage(DigitsPage):
    """Asks for the PIN; then the step `then` is taken, or, without one, the screen `below` goes on."""

    def __init__(self, context: Context, then: StackOperation = None, below: Scene | None = None) -> None:
        super().__init__(context)
        self.then = then
        self.behind = then.scene if isinstance(then, Push) else below
        self.line = context.words("access.ask")

    def complete(self, device: Device) -> StackOperation:
        if self.waiting:
            self.tell("access.ask", True)
            return None
        if not self.roles.pin.check(self.digits):
            self.tell("access.wrong", True)
            return None
        self.context.sounds.play("ready")
        self.roles.begin(device)
        match self.then:
            case None:
                return Pop()
            case Push(scene):
                return Swap(scene)
            case step:
                return step

    def advance(self, seconds: float) -> StackOperation:
        """The screen behind goes on, which may keep a match at rest."""
        if isinstance(self.behind, Page):
            self.behind.advance(seconds)
        return None

    @property
    def waiting(self) -> int:
        """Seconds until the next attempt."""
        return math.ceil(self.roles.pin.wait())

    @property
    def sentence(self) -> tuple[str, kit.Color]:
        if seconds := self.waiting:
            return self.context.words("access.wait", seconds=seconds), kit.ALARM
        return super().sentence


class NewPinPage(DigitsPage):
    """Sets the PIN. `first`: at the first start of a kiosk."""

    right, title = Right.OPERATE, "access.new_title"

    def __init__(self, context: Context, first: bool = False) -> None:
        super().__init__(context)
        self.first, self.chosen = first, ""  # typed once
        self.back = "access.hint_without" if first else self.back
        self.idle = 60.0 if first else self.idle
        self.line = context.words("access.new", least=SHORTEST, most=LONGEST)

    def on_leave(self) -> None:
        super().on_leave()
        if self.first:
            self.save()

    def complete(self, device: Device) -> StackOperation:
        digits = self.digits
        if len(digits) < SHORTEST:
            self.tell("access.new", True)
        elif not self.chosen:
            self.chosen = digits
            self.tell("access.easy" if is_easy(digits) else "access.again")
        elif digits != self.chosen:
            self.chosen = ""
            self.tell("access.different", True)
        else:
            return self._set(digits)
        return None

    def _set(self, digits: str) -> StackOperation:
        try:
            self.roles.pin.set(digits)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.show_message(self.context.words("app.unsaved"), wrong=True)
            return None
        self.context.sounds.play("ready")
        self.context.notices.add(self.context.words("access.saved"))
        return Pop()


def boxes() -> dict[str, pygame.Rect]:
    """The place of each key."""
    return {
        sign: pygame.Rect(960 + (column - 1) * (W + GAP) - W // 2, TOP + row * (H + GAP), W, H)
        for row, signs in enumerate(ROWS)
        for column, sign in enumerate(signs)
    }


@cached
def key(sign: str, focused: bool) -> LitImage:
    """A key, upper left corner at (0, 0)."""
    layer = Layer(0, 0, W, H)
    color = kit.FOCUS if focused else kit.ICE
    layer.glow.line(kit.cut_box(0, 0, W, H, 16), kit.FOCUS if focused else kit.STEEL, kit.THIN, True)
    if sign in SIGNS:
        kit.icon(layer.glow, SIGNS[sign], W / 2, H / 2, 30, color, kit.LINE)
    else:
        layer.canvas.crisp.text(sign, kit.SUB, W / 2, H / 2, color, "head", "c")
    return layer.render()


@cached
def dot(typed: bool) -> LitImage:
    """A digit, centred on (0, 0): typed, or still missing."""
    layer = Layer(-DOT - 4, -DOT - 4, 2 * DOT + 8, 2 * DOT + 8)
    if typed:
        layer.glow.disc(0, 0, DOT, kit.FOCUS)
    else:
        layer.glow.ring(0, 0, DOT, kit.STEEL, kit.THIN)
    return layer.render() if typed else dimmed(layer.render(), 6 / LEVELS)
