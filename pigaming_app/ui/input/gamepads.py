"""Gamepads, hot-pluggable: mapped ones via SDL's game-controller database, others as plain joysticks.

A pad is identified by SDL's instance id, which is not reused while the arcade runs; an unplugged pad is dropped at once
and never read again.
"""

from collections.abc import Iterator, Mapping
from typing import Protocol

import pygame
from pygame._sdl2 import controller

from pigaming_app.ui.input.events import Button, StickState
from pigaming_app.ui.input.filters import ButtonChange, StickDirection, Trigger, apply_dead_zone
from pigaming_app.ui.input.remap import Codes, merged

_AXIS_MAX = 32767.0  # SDL's largest axis value
FUNCTIONS = {"fire": Button.FIRE, "turbo": Button.BACK, "x": Button.X, "y": Button.Y, "start": Button.START}
_XBOX = {
    "fire": pygame.CONTROLLER_BUTTON_A,
    "turbo": pygame.CONTROLLER_BUTTON_B,
    "x": pygame.CONTROLLER_BUTTON_X,
    "y": pygame.CONTROLLER_BUTTON_Y,
    "start": pygame.CONTROLLER_BUTTON_START,
}
DEFAULTS = {
    **dict.fromkeys(("Xbox", "PlayStation", "Nintendo"), _XBOX),
    "Joystick": {"fire": 0, "turbo": 1, "x": 2, "y": 3},
}  # buttons by kind and function; START of a plain joystick depends on how many it has
_FURTHER = {
    pygame.CONTROLLER_BUTTON_BACK: "SELECT",
    pygame.CONTROLLER_BUTTON_LEFTSTICK: "L3",
    pygame.CONTROLLER_BUTTON_RIGHTSTICK: "R3",
}  # further buttons of a mapped pad that can have a function
_CROSS = {
    pygame.CONTROLLER_BUTTON_DPAD_UP: Button.UP,
    pygame.CONTROLLER_BUTTON_DPAD_DOWN: Button.DOWN,
    pygame.CONTROLLER_BUTTON_DPAD_LEFT: Button.LEFT,
    pygame.CONTROLLER_BUTTON_DPAD_RIGHT: Button.RIGHT,
}
_STICK = (pygame.CONTROLLER_AXIS_LEFTX, pygame.CONTROLLER_AXIS_LEFTY)
_SHOULDERS = (pygame.CONTROLLER_BUTTON_LEFTSHOULDER, pygame.CONTROLLER_BUTTON_RIGHTSHOULDER)
_PLAIN_SHOULDERS = (4, 5)
_DIRECTIONS = {Button.UP: "↑", Button.DOWN: "↓", Button.LEFT: "←", Button.RIGHT: "→"}
_SHARED = {Button.LEAVE_SEAT: Button.BACK, Button.BRAIN: Button.Y}  # shared buttons; BRAIN only in a pause
_LABELS = {
    "Xbox": {Button.FIRE: "A", Button.BACK: "B", Button.X: "X", Button.Y: "Y", Button.START: "START"},
    "PlayStation": {
        Button.FIRE: "Cross",
        Button.BACK: "Circle",
        Button.X: "Square",
        Button.Y: "Triangle",
        Button.START: "OPTIONS",
    },
    "Nintendo": {Button.FIRE: "A", Button.BACK: "B", Button.X: "X", Button.Y: "Y", Button.START: "+"},
    "Joystick": {Button.FIRE: "1", Button.BACK: "2", Button.X: "3", Button.Y: "4", Button.START: "START"},
}
_MAKERS = {
    "PlayStation": ("playstation", "dualshock", "dualsense", "sony", "ps3", "ps4", "ps5"),
    "Nintendo": ("nintendo", "switch", "joy-con", "pro controller"),
}


class Pad(Protocol):
    """A connected pad. `kind` is one of Xbox, PlayStation, Nintendo and Joystick."""

    kind: str
    codes: Codes  # the button of each of FUNCTIONS

    def changes(self, event: pygame.Event) -> Iterator[ButtonChange]:
        """Button changes in an event of this pad."""

    def drive(self) -> StickState:
        """The current state."""

    def attached(self) -> bool:
        """False if the system reports it unplugged."""

    def rumble(self, strong: float, weak: float, milliseconds: int) -> None:
        """Rumble, if the pad has motors, with strengths in [0, 1]."""

    def stop_rumble(self) -> None:
        """Stop rumbling."""


class MappedPad:
    """A pad with an SDL mapping; all such pads have the button layout of an Xbox pad.

    Changes come from events alone: in a long frame a button or stick may be back before it could be polled.
    """

    def __init__(self, index: int) -> None:
        self._pad = controller.Controller(index)
        self._stick = StickDirection()
        self._at = {axis: self._axis(axis) for axis in _STICK}
        self._triggers = {
            pygame.CONTROLLER_AXIS_TRIGGERRIGHT: Trigger(),
            pygame.CONTROLLER_AXIS_TRIGGERLEFT: Trigger(None),
        }
        self._shoulders: set[int] = set()
        self.kind = _kind(self._pad.name)
        self.codes = dict(DEFAULTS[self.kind])

    def changes(self, event: pygame.Event) -> Iterator[ButtonChange]:
        if event.type in (pygame.CONTROLLERBUTTONDOWN, pygame.CONTROLLERBUTTONUP):
            down = event.type == pygame.CONTROLLERBUTTONDOWN
            if event.button in _CROSS:
                yield ButtonChange(_CROSS[event.button], down)
            elif button := _function(self.codes, event.button):
                yield ButtonChange(button, down)
            elif event.button in _SHOULDERS:
                yield from _chord(self._shoulders, event.button, down, _SHOULDERS)
                if event.button == pygame.CONTROLLER_BUTTON_RIGHTSHOULDER:
                    yield ButtonChange(None, down, "shoulder")
        elif event.type == pygame.CONTROLLERAXISMOTION:
            if event.axis in _STICK:
                self._at[event.axis] = max(-1.0, event.value / _AXIS_MAX)
                yield from self._stick.moved(*(self._at[axis] for axis in _STICK))
            elif event.axis in self._triggers:
                yield from self._triggers[event.axis].moved(event.value / _AXIS_MAX)

    def attached(self) -> bool:
        return bool(self._pad.attached())

    def drive(self) -> StickState:
        if not self.attached():
            return StickState()
        pressed = self._pad.get_button
        x, y = apply_dead_zone(self._axis(pygame.CONTROLLER_AXIS_LEFTX), self._axis(pygame.CONTROLLER_AXIS_LEFTY))
        return StickState(
            float(pressed(pygame.CONTROLLER_BUTTON_DPAD_UP) - pressed(pygame.CONTROLLER_BUTTON_DPAD_DOWN)) or -y,
            float(pressed(pygame.CONTROLLER_BUTTON_DPAD_RIGHT) - pressed(pygame.CONTROLLER_BUTTON_DPAD_LEFT)) or x,
            pressed(self.codes["fire"]) or self._axis(pygame.CONTROLLER_AXIS_TRIGGERRIGHT) > 0.5,
            pressed(self.codes["turbo"])
            or pressed(pygame.CONTROLLER_BUTTON_RIGHTSHOULDER)
            or self._axis(pygame.CONTROLLER_AXIS_TRIGGERLEFT) > 0.5,
        )

    def rumble(self, strong: float, weak: float, milliseconds: int) -> None:
        if self.attached():
            self._pad.rumble(strong, weak, milliseconds)

    def stop_rumble(self) -> None:
        if self.attached():
            self._pad.stop_rumble()

    def _axis(self, axis: int) -> float:
        return max(-1.0, self._pad.get_axis(axis) / _AXIS_MAX)


class PlainPad:
    """A pad without a mapping: axes 0 and 1, hat 0 and the buttons in the most common order."""

    kind = "Joystick"

    def __init__(self, joystick: "pygame.joystick.JoystickType") -> None:
        self._pad = joystick
        self.codes = dict(DEFAULTS[self.kind])
        self._stick = StickDirection()
        self._hat: dict[Button, bool] = {}
        self._shoulders: set[int] = set()
        self._axes = joystick.get_numaxes() >= 2
        self._at = [joystick.get_axis(0), joystick.get_axis(1)] if self._axes else [0.0, 0.0]
        count = joystick.get_numbuttons()
        self._shoulders_too = count >= 12  # then 6 and 7 are the lower shoulder buttons, and start has a higher number
        start = 9 if self._shoulders_too else min(7, count - 1)
        self._start = start if start >= len(self.codes) else None

    def changes(self, event: pygame.Event) -> Iterator[ButtonChange]:
        if event.type in (pygame.JOYBUTTONDOWN, pygame.JOYBUTTONUP):
            yield from self._button(event.button, event.type == pygame.JOYBUTTONDOWN)
        elif event.type == pygame.JOYAXISMOTION:
            if event.axis < 2 and self._axes:
                self._at[event.axis] = event.value
                yield from self._stick.moved(*self._at)
        elif event.type == pygame.JOYHATMOTION and event.hat == 0:
            yield from self._hat_moved(*event.value)

    def drive(self) -> StickState:
        pad = self._pad
        x, y = apply_dead_zone(pad.get_axis(0), pad.get_axis(1)) if self._axes else (0.0, 0.0)
        right, up = pad.get_hat(0) if pad.get_numhats() else (0, 0)
        return StickState(
            float(up) or -y,
            float(right) or x,
            self._held(self.codes["fire"]) or (self._shoulders_too and self._held(7)),
            self._held(self.codes["turbo"]) or self._held(5) or (self._shoulders_too and self._held(6)),
        )

    def attached(self) -> bool:
        return True  # an unplugged plain joystick reads as neutral

    def rumble(self, strong: float, weak: float, milliseconds: int) -> None:
        self._pad.rumble(strong, weak, milliseconds)

    def stop_rumble(self) -> None:
        self._pad.stop_rumble()

    def _button(self, button: int, down: bool) -> Iterator[ButtonChange]:
        if function := _function(self.codes, button):
            yield ButtonChange(function, down)
        elif button == self._start:
            yield ButtonChange(Button.START, down)
        elif button in _PLAIN_SHOULDERS:
            yield from _chord(self._shoulders, button, down, _PLAIN_SHOULDERS)
        if button == _PLAIN_SHOULDERS[1] or (self._shoulders_too and button == 6):
            yield ButtonChange(None, down, str(button))
        elif self._shoulders_too and button == 7:
            yield ButtonChange(Button.FIRE, down, str(button))

    def _held(self, button: int) -> bool:
        return button < self._pad.get_numbuttons() and bool(self._pad.get_button(button))

    def _hat_moved(self, right: int, up: int) -> Iterator[ButtonChange]:
        now = {Button.UP: up > 0, Button.DOWN: up < 0, Button.LEFT: right < 0, Button.RIGHT: right > 0}
        for button, down in now.items():
            if down != self._hat.get(button, False):
                yield ButtonChange(button, down, "hat")
        self._hat = now


class Pads:
    """The connected pads by instance id."""

    def __init__(self) -> None:
        self.plugged: dict[int, Pad] = {}
        self.tables = merged(DEFAULTS, {}, shared=False)
        try:
            controller.init()
            pygame.joystick.init()
        except pygame.error:
            return  # no joystick service: keys and mouse still work
        self.scan()

    def scan(self) -> list[int]:
        """Open all new pads; returns their instance ids."""
        opened = []
        for index in range(pygame.joystick.get_count()):
            try:
                joystick = pygame.joystick.Joystick(index)
                number = joystick.get_instance_id()
                if number not in self.plugged:
                    mapped = controller.is_controller(index)
                    self.plugged[number] = pad = MappedPad(index) if mapped else PlainPad(joystick)
                    pad.codes = dict(self.tables[pad.kind])
                    opened.append(number)
            except pygame.error:
                continue  # unplugged again since the event
        return opened

    def remap(self, changed: Mapping[str, Mapping[str, int]]) -> None:
        """Change the buttons of each kind of pad, see remap.py; buttons that cannot have a function are left out."""
        fitting = {
            kind: {name: code for name, code in codes.items() if usable(kind, code)} for kind, codes in changed.items()
        }
        self.tables = merged(DEFAULTS, fitting, shared=False)
        for pad in self.plugged.values():
            pad.codes = dict(self.tables[pad.kind])

    def label(self, kind: str, button: Button) -> str:
        """The label printed on a button of this kind of pad; empty if it has none."""
        function = next((name for name, one in FUNCTIONS.items() if one is _SHARED.get(button, button)), "")
        code = self.tables[kind].get(function)
        return _DIRECTIONS.get(button) or (_printed(kind, button) if code is None else button_label(kind, code))

    def forget(self, number: int) -> bool:
        """Drop an unplugged pad; true if it was open."""
        return self.plugged.pop(number, None) is not None


def button_label(kind: str, code: int) -> str:
    """What is printed on a button of this kind of pad."""
    function = next((name for name, default in DEFAULTS[kind].items() if default == code), "")
    return _printed(kind, FUNCTIONS[function]) if function else _FURTHER.get(code, str(code + 1))


def usable(kind: str, code: int) -> bool:
    """True if a button can have a function: shoulder buttons stop all robots, the cross steers."""
    if kind == "Joystick":
        return 0 <= code < 32 and code not in _PLAIN_SHOULDERS
    return code in DEFAULTS[kind].values() or code in _FURTHER if kind in DEFAULTS else False


def _printed(kind: str, button: Button) -> str:
    return _LABELS[kind].get(_SHARED.get(button, button), "")


def _function(codes: Codes, number: int) -> Button | None:
    return next((FUNCTIONS[name] for name, code in codes.items() if code == number), None)


def _chord(down_buttons: set[int], button: int, down: bool, pair: tuple[int, int]) -> Iterator[ButtonChange]:
    """STOP, down when both buttons of a pair are down, up when the first is released."""
    was_complete = down_buttons.issuperset(pair)
    (down_buttons.add if down else down_buttons.discard)(button)
    if was_complete or down_buttons.issuperset(pair):
        yield ButtonChange(Button.STOP, down, "shoulders")


def _kind(name: str) -> str:
    for kind, parts in _MAKERS.items():
        if any(part in name.lower() for part in parts):
            return kind
    return "Xbox"
