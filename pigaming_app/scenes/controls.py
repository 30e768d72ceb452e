"""Everything people hold in their hands, as presses (for menus) and as drives (for robots).

A pad, each of the four key clusters and the mouse are devices; two pads of one make are two devices.
"""

import time
from collections.abc import Callable, Iterable, Iterator
from math import inf

import pygame

from pigaming_app.scenes import keyboard, pads
from pigaming_app.scenes.held import DIRECTIONS, Change, Held
from pigaming_app.scenes.press import Act, Device, Drive, Press

_MOUSE = Device("mouse")
_NOBODYS = (Act.FOUND, Act.LOST, Act.BRAIN, Act.STOP)  # say nothing about what somebody plays with
_TAP_SECONDS = 0.1  # a fire button that went down and up between two ticks still fires within this time
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
        self._held = Held()
        self._taps: dict[Device, float] = {}
        self.last = self.pads()[0] if self.pads() else Device("keys", 0)

    def presses(self, events: Iterable[pygame.Event]) -> list[Press]:
        """What was pressed, in order. Call it once a frame with every event, also while nobody listens."""
        made = [press for event in events for press in self._heard(event)]
        for press in made:
            if press.device != _MOUSE and press.act not in _NOBODYS:
                self.last = press.device
        return made

    def repeats(self, seconds: float) -> list[Press]:
        """The directions that are still held and press again, after `seconds` more of real time."""
        return list(self._held.repeats(seconds))

    def drive(self, device: Device) -> Drive:
        """How a device is held now; a device that is not there drives nowhere. Call it once in a tick."""
        tapped = time.monotonic() - self._taps.pop(device, -inf) < _TAP_SECONDS
        if device.kind == "keys":
            held = self._keyboard.drive(device.number)
        elif device.kind == "pad" and device.number in self._pads.plugged:
            held = self._pads.plugged[device.number].drive()
        else:
            return Drive()
        return Drive(held.linear, held.angular, True, held.turbo) if tapped else held

    def connected(self, device: Device) -> bool:
        """Whether a device is there."""
        return device.kind != "pad" or device.number in self._pads.plugged

    def pads(self) -> list[Device]:
        """The pads that are there, in the order in which they came."""
        return [Device("pad", number) for number in sorted(self._pads.plugged)]

    def name(self, device: Device) -> str:
        """What people call a device: Xbox, PlayStation, Nintendo, Joystick, Keyboard or Mouse."""
        if device.kind == "pad":
            pad = self._pads.plugged.get(device.number)
            return pad.kind if pad else "Joystick"
        return "Keyboard" if device.kind == "keys" else "Mouse"

    def moves(self, device: Device) -> str:
        """Which part of a device steers: the four keys of a cluster; empty for a pad or mouse."""
        return keyboard.CLUSTERS[device.number].moves if device.kind == "keys" else ""

    def label(self, device: Device | None, act: Act) -> str:
        """What is printed on the button that means `act` (None: of the device used last); empty if there is none."""
        device = device or self.last
        if device.kind == "keys":
            return keyboard.label(device.number, act)
        return pads.label(self.name(device), act) if device.kind == "pad" else ""

    def _heard(self, event: pygame.Event) -> Iterator[Press]:
        if event.type in (pygame.KEYDOWN, pygame.KEYUP):
            for device, change in self._keyboard.changes(event):
                yield from self._changed(device, change)
        elif event.type in _MAPPED or event.type in _PLAIN:
            yield from self._heard_pad(event)
        elif event.type == pygame.JOYDEVICEADDED:
            yield from (Press(Act.FOUND, Device("pad", number)) for number in self._pads.look())
        elif event.type == pygame.JOYDEVICEREMOVED:
            if self._pads.forget(event.instance_id):
                self._held.drop(Device("pad", event.instance_id))
                self._taps.pop(Device("pad", event.instance_id), None)
                yield Press(Act.LOST, Device("pad", event.instance_id))
        elif event.type == pygame.WINDOWFOCUSLOST:
            self._release_keys()
        elif event.type == pygame.MOUSEMOTION:
            yield Press(Act.POINT, _MOUSE, at=self._at(event.pos))
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT:
            yield Press(Act.CLICK, _MOUSE, at=self._at(event.pos))

    def _heard_pad(self, event: pygame.Event) -> Iterator[Press]:
        """SDL tells of a mapped pad twice, as a controller and as a joystick: only the first counts."""
        pad = self._pads.plugged.get(event.instance_id)
        if pad is not None and isinstance(pad, pads.MappedPad) == (event.type in _MAPPED):
            for change in pad.changes(event):
                yield from self._changed(Device("pad", event.instance_id), change)

    def _changed(self, device: Device, change: Change) -> Iterator[Press]:
        if change.act in DIRECTIONS:
            if self._held.take(device, change):
                yield Press(change.act, device)
        elif change.down:
            if change.act is Act.FIRE:
                self._taps[device] = time.monotonic()
            yield Press(change.act, device)

    def _release_keys(self) -> None:
        self._keyboard.release()
        self._taps.clear()
        for number in range(len(keyboard.CLUSTERS)):
            self._held.drop(Device("keys", number))
