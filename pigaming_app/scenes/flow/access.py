"""Access control: which devices may act on which screen.

A device is seated when it drives a seat, or holds one in the lobby, and is plugged in; all others are free.

| screen          | seated device                      | free device                              |
| lobby           | its seat, AIs, teams, begin        | FIRE, START: join                        |
| setup           | everything                         | nothing                                  |
| taking places   | begin, simulate, leave             | nothing                                  |
| countdown, match| drive; START, Escape: pause        | FIRE held: take an AI's seat             |
| pause           | its owner, for 20 s; then all      | nothing                                  |
| pad unplugged   | AI now, menu                       | FIRE, START: take the seat               |
| robot fault     | simulate, menu, FIRE: release      | nothing                                  |
| results         | vote, START, change, tables, leave | FIRE: an absent person's seat; held: an AI's |
| initials        | its own three letters              | nothing                                  |

While nobody is seated, every device counts. Keyboard and mouse always count: the mouse acts on the element under it,
F1 stops robots, F4 shows AI thoughts, and Escape held for a second acts even if the keyboard is free: it pauses a
match, takes over a pause, and leaves any other screen.

Besides, a screen may need a right, which devices have by their role (LOWEST, `Roles`).
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from enum import Enum, IntEnum

from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.settings import folders
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.input.hold import HoldTimers

OWNER_SECONDS = 20.0  # seconds for which a pause belongs to its owner
ESCAPE_SECONDS = 1.0  # seconds for which an operator holds Escape
TAKE_SECONDS = 0.6  # seconds for which FIRE is held to take an AI's seat
ALWAYS = (Button.FOUND, Button.LOST, Button.STOP, Button.POINT, Button.CLICK)  # accepted from any device

SESSION, BREAK = (
    120.0,
    30.0,
)  # s without a press for which an operator's session lasts: on a screen of theirs, elsewhere
HOLD, HOLD_WITHOUT_PIN = 1.0, 5.0  # s for which a button is held for what cannot be undone; the latter in a kiosk

Devices = Sequence[Device | None]


class Role(IntEnum):
    """Whom a device stands for. Phones are visitors' everywhere."""

    VISITOR = 0  # in a kiosk
    OPERATOR = 1  # in a kiosk: after the PIN; without one, everybody at a pad or the keyboard
    OWNER = 2  # outside a kiosk: whoever has started the arcade


class Right(Enum):
    """What a screen may need."""

    PLAY = "play"  # with everything that visitors choose, draw and train for themselves
    EVENTS = "events"  # corrections, withdrawals, another title, deletion
    ROBOTS = "robots"  # real robots, camera, calibration
    SETTINGS = "settings"  # of the house
    OPERATE = "operate"  # the operator's page, the second screen
    RESTORE = "restore"  # what was deleted
    CLOSE = "close"  # the arcade
    OWN = "own"  # another PIN or none, deletion for good


LOWEST: Mapping[Right, Role] = {
    Right.PLAY: Role.VISITOR,
    Right.EVENTS: Role.OPERATOR,
    Right.ROBOTS: Role.OPERATOR,
    Right.SETTINGS: Role.OPERATOR,
    Right.OPERATE: Role.OPERATOR,
    Right.RESTORE: Role.OPERATOR,
    Right.CLOSE: Role.OPERATOR,
    Right.OWN: Role.OWNER,
}  # the lowest role with each right


def right_of(scenes: Sequence[Scene]) -> Right:
    """The right that the scene on top needs: its attribute `right`, else that of the next scene below with one."""
    rights = (getattr(scene, "right", None) for scene in reversed(scenes))
    return next((right for right in rights if isinstance(right, Right)), Right.PLAY)


class Roles:
    """The roles of devices, and the session of an operator, which a PIN begins on one device."""

    def __init__(self, context: Context) -> None:
        self.context, self.pin = context, PinFile(folders().config)
        self._who: Device | None = None  # in session
        self._left = 0.0  # s of the session
        self._unused = 0.0  # s since the last press on a screen that needs a right

    @property
    def guarded(self) -> bool:
        """True in a kiosk whose operator has a PIN."""
        return self.context.kiosk and self.pin.is_set

    @property
    def hold(self) -> float:
        """Seconds for which a button is held for what cannot be undone."""
        return HOLD_WITHOUT_PIN if self.context.kiosk and not self.pin.is_set else HOLD

    @property
    def in_session(self) -> bool:
        """True while an operator is at work."""
        return self._who is not None

    def role_of(self, device: Device) -> Role:
        if device.kind == "phone":
            return Role.VISITOR
        if not self.context.kiosk:
            return Role.OWNER
        return Role.OPERATOR if self._who == _person(device) or not self.pin.is_set else Role.VISITOR

    def may(self, device: Device, right: Right) -> bool:
        return self.role_of(device) >= LOWEST[right]

    def begin(self, device: Device) -> None:
        """The PIN was entered on a device."""
        self._who, self._left = _person(device), SESSION

    def end(self) -> None:
        """The operator leaves."""
        self._who = None

    @property
    def left_open(self) -> bool:
        """True if nobody uses the screen that needs a right: everybody may leave it."""
        return self._who is None and self._unused >= BREAK

    def used(self, device: Device) -> None:
        """A press on a screen that needs a right: the session of this device goes on."""
        self._unused = 0.0
        if self._who == _person(device):
            self._left = SESSION

    def update(self, seconds: float, scenes: Sequence[Scene]) -> None:
        """Advance by `seconds`."""
        self._unused = self._unused + seconds if right_of(scenes) is not Right.PLAY else 0.0
        if self._who is None:
            return
        self._left = min(self._left, SESSION if right_of(scenes) is not Right.PLAY else BREAK) - seconds
        if self._left <= 0.0 or not self.context.controls.connected(self._who):
            self.end()


def _person(device: Device) -> Device:
    """Keyboard and mouse are in the same hands."""
    return Device("keys") if device.kind in ("keys", "mouse") else device


class Access:
    """Filters the input events of a page. `devices`: the device of each seat, called for every event."""

    def __init__(self, context: Context, devices: Callable[[], Devices]) -> None:
        self.controls, self.devices = context.controls, devices
        self.escape = HoldTimers(context.controls, ESCAPE_SECONDS)

    @property
    def seated(self) -> list[Device]:
        """The seated devices that are plugged in."""
        return [device for device in self.devices() if device and self.controls.connected(device)]

    @property
    def acting(self) -> Collection[Device]:
        """The devices that may act now; empty: all."""
        return self.seated

    def admit(self, event: InputEvent) -> InputEvent | None:
        """The event, attributed to the acting device, or None if it does not count."""
        acting = self.acting
        if not acting or event.device.kind == "mouse" or event.button in ALWAYS or event.device in acting:
            return event
        for cluster in event.among:
            if cluster in acting:
                return replace(event, device=cluster)
        if event.button is Button.BRAIN and event.device.kind == "keys":
            return event
        if event.button is Button.BACK and event.device.kind == "keys":
            self.escape.begin(event)
        return None

    def update(self, seconds: float) -> InputEvent | None:
        """Advance the timers; returns the operator's BACK when Escape has been held long enough."""
        events = self.escape.update(seconds)
        return events[0] if events else None

    @property
    def hint_device(self) -> Device:
        """The device whose buttons the hints show: the one used last, if it may act."""
        last = self.controls.last
        buttons = [device for device in self.acting if device.kind != "mouse"]
        return buttons[0] if buttons and last not in buttons else last


class PauseAccess(Access):
    """A pause belongs to its owner for a while, as long as the device is plugged in."""

    def __init__(self, context: Context, devices: Callable[[], Devices], owner: Device) -> None:
        super().__init__(context, devices)
        self.owner, self.seconds_left = owner, OWNER_SECONDS

    @property
    def acting(self) -> Collection[Device]:
        seated = self.seated
        if self.owned:
            return [self.owner]
        return [self.owner, *seated] if seated and self.controls.connected(self.owner) else seated

    @property
    def owned(self) -> bool:
        """True while only the owner may act."""
        return self.seconds_left > 0.0 and self.controls.connected(self.owner)

    def update(self, seconds: float) -> InputEvent | None:
        """Advance the timers; an operator holding Escape becomes the owner."""
        self.seconds_left -= seconds
        events = super().update(seconds)
        if events:
            self.owner, self.seconds_left = events.device, OWNER_SECONDS
        return events
