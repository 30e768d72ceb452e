"""Everything people hold in their hands, as presses (for menus) and as drives (for robots).

A pad, each of the four key clusters and the mouse are devices; two pads of one make are two devices.
"""

from collections.abc import Callable, Iterable, Iterator

import pygame

from pigaming_app.ui.input import gamepads as pads
from pigaming_app.ui.input import keyboard
from pigaming_app.ui.input.edges import TapQueue
from pigaming_app.ui.input.events import Button, Device, InputEvent, StickState
from pigaming_app.ui.input.filters import DIRECTIONS, AutoRepeat, ButtonChange

_MOUSE = Device("mouse")
_NOBODYS = (Button.FOUND, Button.LOST, Button.BRAIN, Button.STOP)  # say nothing about what somebody plays with
_TURBOS = (
    None,
    Button.BACK,
    Button.LEAVE_SEAT,
)  # pad B is turbo and leads back; the turbo key of a cluster leaves a seat
_MAPPED = (pygame.CONTROLLERBUTTONDOWN, pygame.CONTROLLERBUTTONUP, pygame.CONTROLLERAXISMOTION)
_PLAIN = (pygame.JOYBUTTONDOWN, pygame.JOYBUTTONUP, pygame.JOYAXISMOTION, pygame.JOYHATMOTION)


class Controls:
    """All devices. `last`: the pad or key cluster that pressed last, whose labels the hints show.

    `at` turns a position in the window into one on the canvas.
    """

    def __init__(self, at: Callable[[tuple[float, float]], tuple[float, float]] = lambda mouse: mouse) -> None:
        self._at = at
        self._pads = pads.Pads()
        self._keyboard = keyboard.Keyboard()
        self._held = AutoRepeat()
        self._edges = TapQueue()
        self._down: dict[tuple[Device, Button], frozenset[str]] = {}
        self.last = self._any()

    def presses(self, events: Iterable[pygame.Event]) -> list[InputEvent]:
        """What was pressed, in order. Call it once a frame with every event, also while nobody listens."""
        made = [press for event in events for press in self._heard(event)]
        for press in made:
            if press.device != _MOUSE and press.button not in _NOBODYS:
                self.last = press.device
        return made

    def repeats(self, seconds: float) -> list[InputEvent]:
        """The directions that are still held and press again, after `seconds` more of real time."""
        return list(self._held.repeats(seconds))

    def drive(self, device: Device) -> StickState:
        """How a device is held now; a device that is not there drives nowhere. Call it once in a tick.

        Taps of fire and turbo since the last call act one after the other, a tick each, however short they were.
        """
        if device.kind == "keys":
            held = self._keyboard.drive(device.number)
        elif device.kind == "pad" and device.number in self._pads.plugged:
            pad = self._pads.plugged[device.number]
            if not pad.attached():
                return StickState()
            held = pad.drive()
        else:
            return StickState()
        fire = self._edges.read(device, Button.FIRE, held.fire)
        turbo = self._edges.read(device, None, held.turbo)
        return StickState(held.linear, held.angular, fire, turbo)

    def forget_taps(self) -> None:
        """What was tapped up to now shall not drive a robot: it was meant for a page, or for a match that stood."""
        self._edges.clear()

    def holds(self, device: Device, button: Button) -> bool:
        """Whether the button of a device that means `act` is down; of the mouse, its left button."""
        if device.kind == "mouse":
            return bool(self._down.get((device, Button.CLICK)))
        if device.kind == "keys" and button in keyboard.SHARED:
            return any(self._down.get((cluster, button)) for cluster in self._keyboard.latest)
        return bool(self._down.get((device, button)))

    def touched(self, device: Device) -> bool:
        """Whether any button, key or direction of a device is down."""
        return any(parts and held == device for (held, _), parts in self._down.items())

    def connected(self, device: Device) -> bool:
        """Whether a device is there."""
        return device.kind != "pad" or device.number in self._pads.plugged

    def pads(self) -> list[Device]:
        """The pads that are there, in the order in which they came."""
        return [Device("pad", number) for number in sorted(self._pads.plugged)]

    def players(self) -> list[Device]:
        """Every device that can drive a robot: the pads that are there, and the clusters of the keyboard."""
        return [*self.pads(), *(Device("keys", number) for number in range(len(keyboard.CLUSTERS)))]

    def name(self, device: Device) -> str:
        """What people call a device: Xbox, PlayStation, Nintendo, Joystick, Keyboard or Mouse."""
        if device.kind == "pad":
            pad = self._pads.plugged.get(device.number)
            return pad.kind if pad else "Joystick"
        return "Keyboard" if device.kind == "keys" else "Mouse"

    def moves(self, device: Device) -> str:
        """Which part of a device steers: the four keys of a cluster; empty for a pad or mouse."""
        return keyboard.CLUSTERS[device.number].moves if device.kind == "keys" else ""

    def label(self, device: Device | None, button: Button) -> str:
        """What is printed on the button that means `act` (None: of the device used last); empty if there is none."""
        device = device or self.last
        if device.kind == "keys":
            return keyboard.label(device.number, button)
        return pads.label(self.name(device), button) if device.kind == "pad" else ""

    def _heard(self, event: pygame.Event) -> Iterator[InputEvent]:
        if event.type in (pygame.KEYDOWN, pygame.KEYUP):
            for device, change in self._keyboard.changes(event):
                yield from self._changed(device, change)
        elif event.type in _MAPPED or event.type in _PLAIN:
            yield from self._heard_pad(event)
        elif event.type == pygame.JOYDEVICEADDED:
            yield from (InputEvent(Button.FOUND, Device("pad", number)) for number in self._pads.look())
        elif event.type == pygame.JOYDEVICEREMOVED:
            if self._pads.forget(event.instance_id):
                yield self._lost(Device("pad", event.instance_id))
        elif event.type == pygame.WINDOWFOCUSLOST:
            self._release_keys()
        elif event.type == pygame.MOUSEMOTION:
            yield InputEvent(Button.POINT, _MOUSE, at=self._at(event.pos))
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT:
            self._note(_MOUSE, ButtonChange(Button.CLICK, True))
            yield InputEvent(Button.CLICK, _MOUSE, at=self._at(event.pos))
        elif event.type == pygame.MOUSEBUTTONUP and event.button == pygame.BUTTON_LEFT:
            self._note(_MOUSE, ButtonChange(Button.CLICK, False))

    def _heard_pad(self, event: pygame.Event) -> Iterator[InputEvent]:
        """SDL tells of a mapped pad twice, as a controller and as a joystick: only the first counts."""
        pad = self._pads.plugged.get(event.instance_id)
        if pad is not None and isinstance(pad, pads.MappedPad) == (event.type in _MAPPED):
            for change in pad.changes(event):
                yield from self._changed(Device("pad", event.instance_id), change)

    def _changed(self, device: Device, change: ButtonChange) -> Iterator[InputEvent]:
        self._note(device, change)
        button = change.button
        if button in DIRECTIONS:
            if self._held.take(device, change):
                yield InputEvent(button, device)
        elif change.down and button:
            shared = device.kind == "keys" and button in keyboard.SHARED
            yield InputEvent(button, device, among=self._keyboard.latest if shared else ())

    def _note(self, device: Device, change: ButtonChange) -> None:
        """Keep in mind what is down, and what the next tick of a match has to see."""
        before = parts = self._down.get((device, change.button), frozenset()) if change.button else frozenset()
        if change.button:
            parts = before | {change.part} if change.down else before - {change.part}
            self._down[device, change.button] = parts
        if change.button is Button.FIRE and bool(before) != bool(parts):
            self._edges.note(device, Button.FIRE, change.down)
        elif change.down and change.button in _TURBOS and not (device.kind == "keys" and change.button is Button.BACK):
            self._edges.note(device, None, True)  # a robot notices how long turbo lasts, not when it begins

    def _lost(self, device: Device) -> InputEvent:
        self._held.drop(device)
        self._edges.clear(device=device)
        self._down = {key: parts for key, parts in self._down.items() if key[0] != device}
        if self.last == device:
            self.last = self._any()
        return InputEvent(Button.LOST, device)

    def _any(self) -> Device:
        """The device whose labels are shown before anybody has pressed anything."""
        return self.players()[0]

    def _release_keys(self) -> None:
        self._keyboard.release()
        self._edges.clear("keys")
        self._down = {key: parts for key, parts in self._down.items() if key[0].kind == "pad"}
        for number in range(len(keyboard.CLUSTERS)):
            self._held.drop(Device("keys", number))
