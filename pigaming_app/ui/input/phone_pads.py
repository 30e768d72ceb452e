"""The phones that play, shared by two threads: the server writes what they send, the main loop reads it as a pad's.

Buttons reach the main loop as a queue of changes, so no tap is lost; the stick is read at the tick that uses it. A
phone that has been silent for a moment stands still, and is unplugged by the server soon after.
"""

import time
from collections import deque
from collections.abc import Callable, Iterator, Mapping

from pigaming_app.ui.input.events import Button, StickState
from pigaming_app.ui.input.filters import ButtonChange, StickDirection, apply_dead_zone
from pigaming_app.ui.input.phone_messages import BITS, SeatView, Touches, rumble_text, state_text, texts_text

MAX_PHONES = 4  # that may act at a time; the others wait, see `phones/roster.py`
FRESH_SECONDS = 0.6  # age of the last message after which a stick counts as released
MAX_CHANGES = 1024  # queued changes of all phones, while the main loop does not read

LABELS = {
    Button.FIRE: "A",
    Button.BACK: "B",
    Button.LEAVE_SEAT: "B",
    Button.X: "X",
    Button.Y: "Y",
    Button.START: "START",
}
LABELS |= {Button.BRAIN: "Y", Button.UP: "↑", Button.DOWN: "↓", Button.LEFT: "←", Button.RIGHT: "→"}


class Phone:
    """A connected phone. The server writes `touches` and `heard_at`, the main loop `down`."""

    def __init__(self, now: float) -> None:
        self.touches, self.heard_at = Touches(), now
        self.direction = StickDirection()
        self.down: set[Button] = set()  # as far as the main loop has read the changes


class Phones:
    """The phones by device number. `send`: passes a text to a phone's page; set by the server while it runs."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self.clock = clock
        self.plugged: dict[int, Phone] = {}  # for the main loop
        self.send: Callable[[int, str], None] = lambda number, text: None
        self.names: dict[int, str] = {}  # of all phones, waiting ones too; empty: none
        self.called: dict[int, str] = {}  # of those whose turn it is: the name of the person who is called, if any
        self.watching: set[int] = set()  # phones that wait: they are shown things, and do nothing
        self._connected: dict[int, Phone] = {}  # for the server
        self._queue: deque[tuple[int, ButtonChange | Button]] = deque()
        self._shown: dict[int, SeatView] = {}
        self._texts: dict[int, Mapping[str, str]] = {}  # last sent to each phone
        self._ballots: dict[int, str] = {}
        self._next = 0

    # ---- for the server's thread

    @property
    def full(self) -> bool:
        """True if four phones may act."""
        return len(self._connected) >= MAX_PHONES

    def new_number(self) -> int:
        """A device number that no phone has had."""
        self._next += 1
        return self._next - 1

    def reserve(self, numbers: int) -> None:
        """New numbers begin here, or later."""
        self._next = max(self._next, numbers)

    def plug(self, number: int, on: bool) -> None:
        """Connect or disconnect a phone unless it already is."""
        if on and number not in self._connected:
            self.connect(number)
        elif not on:
            self.disconnect(number)

    def connect(self, number: int | None = None) -> int:
        """Connect a phone, with the device number that it had before, if any. Returns its number."""
        if number is None:
            number = self.new_number()
        self._connected[number] = Phone(self.clock())
        self._queue.append((number, Button.FOUND))
        return number

    def disconnect(self, number: int) -> None:
        """The phone is gone: locked, closed, out of reach, or refused."""
        if self._connected.pop(number, None):
            self._queue.append((number, Button.LOST))

    def receive(self, number: int, touches: Touches) -> bool:
        """Note what a phone has sent, if it may act. False if the main loop has not read for too long to queue more."""
        phone = self._connected.get(number)
        if phone is None:
            return True
        before, phone.touches, phone.heard_at = phone.touches, touches, self.clock()
        for button, bit in BITS.items():
            if (before.buttons ^ touches.buttons) & bit:
                self._queue.append((number, ButtonChange(button, bool(touches.buttons & bit))))
        for change in phone.direction.moved(touches.x, touches.y):
            self._queue.append((number, change))
        return len(self._queue) < MAX_CHANGES

    # ---- for the main loop

    def changes(self) -> Iterator[tuple[int, ButtonChange | Button]]:
        """What has happened since the last call: Button.FOUND, Button.LOST, or a change of a button, by number."""
        for _ in range(len(self._queue)):
            number, change = self._queue.popleft()
            if change is Button.FOUND:
                if phone := self._connected.get(number):
                    self.plugged[number] = phone
                    self.forget_shown(number)
                    yield number, change
            elif change is Button.LOST:
                if self.plugged.pop(number, None):
                    yield number, change
            elif isinstance(change, ButtonChange) and number in self.plugged:
                self._press(self.plugged[number], change)
                yield number, change

    def drive(self, number: int) -> StickState:
        """The current state of a phone, neutral if it has fallen silent."""
        phone = self.plugged.get(number)
        if phone is None or self.clock() - phone.heard_at > FRESH_SECONDS:
            return StickState()
        x, y = apply_dead_zone(phone.touches.x, phone.touches.y)
        return StickState(-y, x, Button.FIRE in phone.down, Button.BACK in phone.down)

    def rumble(self, number: int, strong: float, weak: float, seconds: float) -> None:
        """Shake a phone, or make its page flash where the browser cannot."""
        self.send(number, rumble_text(strong, weak, seconds))

    def stop_rumble(self) -> None:
        """Stop the shaking of all phones."""
        for number in self.plugged:
            self.rumble(number, 0.0, 0.0, 0.0)

    def forget_shown(self, number: int) -> None:
        """A phone is new or was reloaded: it knows neither its seat nor its texts."""
        self._shown.pop(number, None)
        self._texts.pop(number, None)
        self._ballots.pop(number, None)

    def forget(self, number: int) -> None:
        """A phone is gone for good."""
        self.disconnect(number)
        self.forget_shown(number)
        self.names.pop(number, None)

    def show(self, number: int, view: SeatView) -> None:
        """Tell a phone its seat or its place in the queue, if that has changed."""
        if self._reads(number) and self._shown.get(number) != view:
            self._shown[number] = view
            self.send(number, state_text(view))

    def translate(self, number: int, texts: Mapping[str, str]) -> None:
        """Send a phone the texts of its page, if they have changed or it has just come."""
        if self._reads(number) and self._texts.get(number) != texts:
            self._texts[number] = texts
            self.send(number, texts_text(texts))

    def offer(self, number: int, ballot: str) -> None:
        """Send a phone the message with what it may vote for, if that has changed or it has just come."""
        if self._reads(number) and self._ballots.get(number) != ballot:
            self._ballots[number] = ballot
            self.send(number, ballot)

    def _reads(self, number: int) -> bool:
        return number in self.plugged or number in self.watching

    @staticmethod
    def _press(phone: Phone, change: ButtonChange) -> None:
        if change.button:
            (phone.down.add if change.down else phone.down.discard)(change.button)
