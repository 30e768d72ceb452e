"""Input devices as button events (for menus) and stick states (for robots).

Devices are gamepads, phones, the four key clusters and the mouse; two pads of the same model are two devices.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping

import pygame

from pigaming_app.ui.input import gamepads as pads
from pigaming_app.ui.input import keyboard
from pigaming_app.ui.input import phone_pads as phones
from pigaming_app.ui.input.edges import TapQueue
from pigaming_app.ui.input.events import Button, Device, InputEvent, StickState
from pigaming_app.ui.input.filters import DIRECTIONS, AutoRepeat, ButtonChange
from pigaming_app.ui.input.remap import Tables

_MOUSE = Device("mouse")
_NOT_PERSONAL = (Button.FOUND, Button.LOST, Button.BRAIN, Button.STOP)  # do not change `last`
_TURBOS = (None, Button.BACK, Button.LEAVE_SEAT)  # pad B is turbo and BACK; the turbo key of a cluster is LEAVE_SEAT
_MAPPED = (pygame.CONTROLLERBUTTONDOWN, pygame.CONTROLLERBUTTONUP, pygame.CONTROLLERAXISMOTION)
_PLAIN = (pygame.JOYBUTTONDOWN, pygame.JOYBUTTONUP, pygame.JOYAXISMOTION, pygame.JOYHATMOTION)


class Controls:
    """All input devices. `last`: the most recently used pad, phone or key cluster, whose labels the hints show.

    `to_canvas` maps window coordinates to canvas coordinates.
    """

    def __init__(self, to_canvas: Callable[[tuple[float, float]], tuple[float, float]] = lambda mouse: mouse) -> None:
        self._to_canvas = to_canvas
        self._pads = pads.Pads()
        self._keyboard = keyboard.Keyboard()
        self.phones = phones.Phones()
        self._repeat = AutoRepeat()
        self._taps = TapQueue()
        self._down: dict[tuple[Device, Button], frozenset[str]] = {}
        self._listener: Callable[[Device, int], None] | None = None
        self.typist: Callable[[str], None] | None = None  # gets typed letters, and backspaces, instead of the scenes
        self.last = self._default()

    def presses(self, events: Iterable[pygame.Event]) -> list[InputEvent]:
        """The button events of this frame, in order. Call it once per frame with all pygame events."""
        pressed = [press for event in events if not self._consumed(event) for press in self._translate(event)]
        pressed += self._phone_presses()
        for press in pressed:
            if press.device != _MOUSE and press.button not in _NOT_PERSONAL:
                self.last = press.device
        return pressed

    def remap(self, changed: Mapping[str, Mapping[str, int]]) -> None:
        """Change keys and buttons, see remap.py. Invalid changes are left out."""
        self._keyboard.remap(changed)
        self._pads.remap(changed)
        self._down.clear()

    def tables(self) -> Tables:
        """The key or button of each function, by key cluster and by kind of pad."""
        return {**self._keyboard.tables, **self._pads.tables}

    def listen(self, listener: Callable[[Device, int], None] | None) -> None:
        """Pass the next key or button that goes down to `listener` instead: a device and a scancode or number."""
        self._listener = listener

    def _consumed(self, event: pygame.Event) -> bool:
        """True for an event that went to the typist or the listener instead."""
        return self._typed(event) or self._listened(event)

    def _typed(self, event: pygame.Event) -> bool:
        """Hand a letter or a backspace of the keyboard to the typist; true if so."""
        if self.typist is None or event.type != pygame.KEYDOWN:
            return False
        letter = "\b" if event.key == pygame.K_BACKSPACE else event.dict.get("unicode", "")
        if letter != "\b" and not (letter and letter.isprintable()):
            return False
        self.typist(letter)
        return True

    def _listened(self, event: pygame.Event) -> bool:
        """True if a listener got the event."""
        listener, device = self._listener, None
        if listener and event.type == pygame.KEYDOWN:
            device, code = Device("keys"), event.scancode
        elif listener and event.type in (pygame.CONTROLLERBUTTONDOWN, pygame.JOYBUTTONDOWN):
            pad = self._pads.plugged.get(event.instance_id)
            if pad is not None and isinstance(pad, pads.MappedPad) == (event.type == pygame.CONTROLLERBUTTONDOWN):
                device, code = Device("pad", event.instance_id), event.button
        if listener is None or device is None:
            return False
        self._listener = None
        listener(device, code)
        return True

    def repeats(self, seconds: float) -> list[InputEvent]:
        """Auto-repeat events of held directions, after `seconds` more of real time."""
        return list(self._repeat.repeats(seconds))

    def drive(self, device: Device) -> StickState:
        """The current state of a device, neutral if it is unplugged. Call it once per tick.

        Taps of fire and turbo since the last call are queued, one per tick, however short they were.
        """
        if device.kind == "keys":
            state = self._keyboard.drive(device.number)
        elif device.kind == "pad" and device.number in self._pads.plugged:
            pad = self._pads.plugged[device.number]
            if not pad.attached():
                return StickState()
            state = pad.drive()
        elif device.kind == "phone" and device.number in self.phones.plugged:
            state = self.phones.drive(device.number)
        else:
            return StickState()
        fire = self._taps.read(device, Button.FIRE, state.fire)
        turbo = self._taps.read(device, None, state.turbo)
        return StickState(state.linear, state.angular, fire, turbo)

    def forget_taps(self) -> None:
        """Discard queued taps: they were meant for a page or for a paused match."""
        self._taps.clear()

    def holds(self, device: Device, button: Button) -> bool:
        """True if the button is down on this device; for the mouse, its left button."""
        if device.kind == "mouse":
            return bool(self._down.get((device, Button.CLICK)))
        if device.kind == "keys" and button in keyboard.SHARED:
            return any(self._down.get((cluster, button)) for cluster in self._keyboard.latest)
        return bool(self._down.get((device, button)))

    def touched(self, device: Device) -> bool:
        """True if any button, key or direction of a device is down."""
        return any(parts and owner == device for (owner, _), parts in self._down.items())

    def rumble(self, device: Device, strong: float, weak: float, seconds: float) -> None:
        """Rumble a pad or phone with its strong and weak motor, each in [0, 1]. Devices without motors do nothing."""
        if device.kind == "pad" and device.number in self._pads.plugged:
            self._pads.plugged[device.number].rumble(strong, weak, round(1000 * seconds))
        elif device.kind == "phone":
            self.phones.rumble(device.number, strong, weak, seconds)

    def stop_rumble(self) -> None:
        """Stop the rumbling of all pads and phones."""
        for pad in self._pads.plugged.values():
            pad.stop_rumble()
        self.phones.stop_rumble()

    def connected(self, device: Device) -> bool:
        if device.kind == "phone":
            return device.number in self.phones.plugged
        return device.kind != "pad" or device.number in self._pads.plugged

    def driver(self, device: Device) -> Device:
        """The device; in place of a mouse, or of a pad or phone that is gone, the one used last."""
        return device if device.kind != "mouse" and self.connected(device) else self.last

    def pads(self) -> list[Device]:
        """The connected pads, oldest first."""
        return [Device("pad", number) for number in sorted(self._pads.plugged)]

    def handhelds(self) -> list[Device]:
        """The connected pads, then the connected phones, each oldest first."""
        return [*self.pads(), *(Device("phone", number) for number in sorted(self.phones.plugged))]

    def players(self) -> list[Device]:
        """Every device that can drive a robot: connected pads and phones, and the key clusters."""
        return [*self.handhelds(), *(Device("keys", number) for number in range(len(keyboard.CLUSTERS)))]

    def offered(self) -> list[Device]:
        """The same without a keypad of which no key was ever pressed: laptops have none."""
        return [device for device in self.players() if self.has_keypad or self.name(device) != "Keypad"]

    @property
    def has_keypad(self) -> bool:
        """True if a key of the keypad was pressed, now or in an earlier start."""
        return self._keyboard.has_keypad

    @has_keypad.setter
    def has_keypad(self, known: bool) -> None:
        self._keyboard.has_keypad = known

    def owner(self, device: Device | None) -> str:
        """The name that the owner of a device has given it; empty: none. Only phones have one."""
        return self.phones.names.get(device.number, "") if device and device.kind == "phone" else ""

    def sign(self, device: Device) -> str:
        """The icon of a device."""
        return "keypad" if self.name(device) == "Keypad" else device.kind

    def name(self, device: Device) -> str:
        """The type of a device: Xbox, PlayStation, Nintendo, Joystick, Phone, Keyboard, Keypad or Mouse."""
        if device.kind == "keys" and self._keyboard.clusters[device.number].on_keypad:
            return "Keypad"
        if device.kind == "pad":
            pad = self._pads.plugged.get(device.number)
            return pad.kind if pad else "Joystick"
        return {"keys": "Keyboard", "phone": "Phone"}.get(device.kind, "Mouse")

    def moves(self, device: Device) -> str:
        """The four steering keys of a cluster; empty for other devices."""
        return self._keyboard.clusters[device.number].moves if device.kind == "keys" else ""

    def label(self, device: Device | None, button: Button) -> str:
        """The label printed on a button (None: of the device used last); empty if the device lacks it."""
        device = device or self.last
        if device.kind == "keys":
            return self._keyboard.label(device.number, button)
        if device.kind == "phone":
            return phones.LABELS.get(button, "")
        return self._pads.label(self.name(device), button) if device.kind == "pad" else ""

    def _translate(self, event: pygame.Event) -> Iterator[InputEvent]:
        if event.type in (pygame.KEYDOWN, pygame.KEYUP):
            for device, change in self._keyboard.changes(event):
                yield from self._press(device, change)
        elif event.type in _MAPPED or event.type in _PLAIN:
            yield from self._translate_pad(event)
        elif event.type == pygame.JOYDEVICEADDED:
            yield from (InputEvent(Button.FOUND, Device("pad", number)) for number in self._pads.scan())
        elif event.type == pygame.JOYDEVICEREMOVED:
            if self._pads.forget(event.instance_id):
                yield self._lost(Device("pad", event.instance_id))
        elif event.type == pygame.WINDOWFOCUSLOST:
            self._release_keys()
        elif event.type == pygame.KEYMAPCHANGED:
            self._keyboard.new_layout()
        elif event.type == pygame.MOUSEMOTION:
            yield InputEvent(Button.POINT, _MOUSE, at=self._to_canvas(event.pos))
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT:
            self._track(_MOUSE, ButtonChange(Button.CLICK, True))
            yield InputEvent(Button.CLICK, _MOUSE, at=self._to_canvas(event.pos))
        elif event.type == pygame.MOUSEBUTTONUP and event.button == pygame.BUTTON_LEFT:
            self._track(_MOUSE, ButtonChange(Button.CLICK, False))

    def _translate_pad(self, event: pygame.Event) -> Iterator[InputEvent]:
        """SDL reports a mapped pad both as a controller and as a joystick: use the former only."""
        pad = self._pads.plugged.get(event.instance_id)
        if pad is not None and isinstance(pad, pads.MappedPad) == (event.type in _MAPPED):
            for change in pad.changes(event):
                yield from self._press(Device("pad", event.instance_id), change)

    def _phone_presses(self) -> Iterator[InputEvent]:
        for number, change in self.phones.changes():
            device = Device("phone", number)
            if change is Button.LOST:
                yield self._lost(device)
            elif isinstance(change, ButtonChange):
                yield from self._press(device, change)
            else:
                yield InputEvent(Button.FOUND, device)

    def _press(self, device: Device, change: ButtonChange) -> Iterator[InputEvent]:
        self._track(device, change)
        button = change.button
        if button in DIRECTIONS:
            if self._repeat.take(device, change):
                yield InputEvent(button, device)
        elif change.down and button:
            shared = device.kind == "keys" and button in keyboard.SHARED
            yield InputEvent(button, device, among=self._keyboard.latest if shared else ())

    def _track(self, device: Device, change: ButtonChange) -> None:
        """Update the set of pressed parts, and queue the tap for the next tick."""
        before = parts = self._down.get((device, change.button), frozenset()) if change.button else frozenset()
        if change.button:
            parts = before | {change.part} if change.down else before - {change.part}
            self._down[device, change.button] = parts
        if change.button is Button.FIRE and bool(before) != bool(parts):
            self._taps.note(device, Button.FIRE, change.down)
        elif change.down and change.button in _TURBOS and not (device.kind == "keys" and change.button is Button.BACK):
            self._taps.note(device, None, True)  # turbo has a duration only: queue presses, not releases

    def _lost(self, device: Device) -> InputEvent:
        self._repeat.drop(device)
        self._taps.clear(device=device)
        self._down = {key: parts for key, parts in self._down.items() if key[0] != device}
        if self.last == device:
            self.last = self._default()
        return InputEvent(Button.LOST, device)

    def _default(self) -> Device:
        """The device whose labels are shown before the first input."""
        return self.players()[0]

    def _release_keys(self) -> None:
        self._keyboard.release()
        self._taps.clear("keys")
        self._down = {key: parts for key, parts in self._down.items() if key[0].has_stick}
        for number in range(len(keyboard.CLUSTERS)):
            self._repeat.drop(Device("keys", number))
