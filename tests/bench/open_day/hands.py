"""What a visitor or the operator holds: a virtual pad, a phone, or the keyboard. All press the arcade's own buttons."""

from collections.abc import Callable

import pygame

from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.input.phone_messages import BITS, Touches
from pigaming_app.ui.input.phone_pads import Phones
from tests.bench.open_day.handsets import Handset
from tests.ui.input.virtual_pad import VirtualPad

PAD = {
    Button.FIRE: "a", Button.BACK: "b", Button.X: "x", Button.Y: "y", Button.START: "start",
    Button.UP: "up", Button.DOWN: "down", Button.LEFT: "left", Button.RIGHT: "right",
}  # fmt: skip
STICK = {Button.UP: (0.0, -1.0), Button.DOWN: (0.0, 1.0), Button.LEFT: (-1.0, 0.0), Button.RIGHT: (1.0, 0.0)}
KEYS = {
    Button.FIRE: pygame.KSCAN_RCTRL, Button.BACK: pygame.KSCAN_ESCAPE, Button.UP: pygame.KSCAN_UP,
    Button.DOWN: pygame.KSCAN_DOWN, Button.LEFT: pygame.KSCAN_LEFT, Button.RIGHT: pygame.KSCAN_RIGHT,
    Button.START: pygame.KSCAN_RETURN,
}  # fmt: skip


class PadHands:
    """A pad that the visitors hand on."""

    def __init__(self) -> None:
        self.pad = VirtualPad()

    @property
    def device(self) -> Device | None:
        """The arcade's name of it; None while it is gone."""
        return Device("pad", self.pad.number) if self.pad.plugged else None

    def press(self, button: Button) -> None:
        if self.pad.plugged:
            self.pad.press(PAD[button])

    def release(self, button: Button) -> None:
        if self.pad.plugged:
            self.pad.release(PAD[button])

    def steer(self, x: float, y: float, fire: bool, turbo: bool) -> None:
        """Drive from now on; axes in [-1, 1], y down."""
        if self.pad.plugged:
            self.pad.stick(x, y)
            (self.pad.press if fire else self.pad.release)("a")
            (self.pad.press if turbo else self.pad.release)("rightshoulder")

    def unplug(self) -> None:
        self.pad.unplug()

    def plug(self) -> None:
        self.pad = VirtualPad()


class PhoneHands:
    """A visitor's phone, which scans the code at once. `number_of`: the arcade's number of the phone with a token."""

    def __init__(self, handset: Handset, phones: Phones, number_of: Callable[[str], int | None]) -> None:
        self.handset, self._phones, self._number_of = handset, phones, number_of
        self._number: int | None = None
        self._touches = Touches()

    @property
    def number(self) -> int | None:
        """The arcade's number of it; None until it is connected."""
        if self._number is None and self.handset.token:
            self._number = self._number_of(self.handset.token)
        return self._number

    @property
    def device(self) -> Device | None:
        """The arcade's name of it; None while it is away or others have their turn."""
        return Device("phone", self.number) if self.number in self._phones.plugged else None

    def press(self, button: Button) -> None:
        if button in STICK:
            self._send(*STICK[button], self._touches.buttons)
        else:
            self._send(self._touches.x, self._touches.y, self._touches.buttons | BITS[button])

    def release(self, button: Button) -> None:
        if button in STICK:
            self._send(0.0, 0.0, self._touches.buttons)
        else:
            self._send(self._touches.x, self._touches.y, self._touches.buttons & ~BITS[button])

    def steer(self, x: float, y: float, fire: bool, turbo: bool) -> None:
        self._send(x, y, BITS[Button.FIRE] * fire | BITS[Button.BACK] * turbo)

    def unplug(self) -> None:
        self.handset.lock()

    def plug(self) -> None:
        self._touches = Touches()
        self.handset.unlock()

    def _send(self, x: float, y: float, buttons: int) -> None:
        touches = Touches(x, y, buttons)
        if touches != self._touches:
            self._touches = touches
            self.handset.touch(touches)


class KeyHands:
    """The operator's keyboard."""

    device = Device("keys", 1)

    def press(self, button: Button) -> None:
        self._post(pygame.KEYDOWN, KEYS[button])

    def release(self, button: Button) -> None:
        self._post(pygame.KEYUP, KEYS[button])

    def steer(self, x: float, y: float, fire: bool, turbo: bool) -> None:
        """The operator does not drive."""

    def unplug(self) -> None:
        """A keyboard stays."""

    def plug(self) -> None:
        """A keyboard stays."""

    def hold_f10(self, down: bool) -> None:
        """Hold F10, or release it."""
        kind = pygame.KEYDOWN if down else pygame.KEYUP
        pygame.event.post(pygame.Event(kind, key=pygame.K_F10, unicode="", scancode=pygame.KSCAN_F10, mod=0))

    def type(self, letter: str) -> None:
        """Type a letter."""
        self._post(pygame.KEYDOWN, pygame.KSCAN_0, letter)
        self._post(pygame.KEYUP, pygame.KSCAN_0, letter)

    @staticmethod
    def _post(kind: int, scancode: int, letter: str = "") -> None:
        pygame.event.post(pygame.Event(kind, key=0, unicode=letter, scancode=scancode, mod=0))


Hands = PadHands | PhoneHands | KeyHands
