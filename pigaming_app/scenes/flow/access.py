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

While nobody is seated, every device counts. The operator always counts: the mouse acts on the element under it, F1
stops robots, F4 shows AI thoughts, and Escape held for a second acts even if the keyboard is free: it pauses a match,
takes over a pause, and leaves any other screen.
"""

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace

from pigaming_app.scenes.flow.context import Context
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.input.hold import HoldTimers

OWNER_SECONDS = 20.0  # seconds for which a pause belongs to its owner
ESCAPE_SECONDS = 1.0  # seconds for which an operator holds Escape
TAKE_SECONDS = 0.6  # seconds for which FIRE is held to take an AI's seat
ALWAYS = (Button.FOUND, Button.LOST, Button.STOP, Button.POINT, Button.CLICK)  # accepted from any device

Devices = Sequence[Device | None]


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
