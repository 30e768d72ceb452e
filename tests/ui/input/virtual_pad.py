"""Gamepads without hardware: SDL's virtual joysticks, attached to the SDL library loaded by pygame.

A virtual pad causes real events (added, axes, buttons, removed), also under the dummy video driver. A `plain` one has
no game-controller mapping.
"""

import ctypes
from functools import cache
from pathlib import Path
from types import TracebackType

import pygame

XBOX = (0x045E, 0x028E)
PLAYSTATION = (0x054C, 0x09CC)
NINTENDO = (0x057E, 0x2009)

_GAME_CONTROLLER, _ARCADE_STICK = 1, 3  # SDL_JoystickType; SDL creates a mapping only for the first
_FULL = 32767
_RUMBLE = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_uint16, ctypes.c_uint16)
_BUTTONS = (
    "a", "b", "x", "y", "back", "guide", "start", "leftstick", "rightstick",
    "leftshoulder", "rightshoulder", "up", "down", "left", "right",
)  # fmt: skip
_LEFT_TRIGGER, _RIGHT_TRIGGER = 4, 5  # axes


class VirtualPad:
    """A pad, connected on construction. Use it in a `with`, or call `unplug`."""

    def __init__(self, name: str = "Xbox 360 Controller", usb: tuple[int, int] = XBOX, plain: bool = False) -> None:
        self._sdl = sdl_library()
        kind = _ARCADE_STICK if plain else _GAME_CONTROLLER
        buttons, hats = (12, 1) if plain else (len(_BUTTONS), 0)
        self.rumbles: list[tuple[int, int]] = []  # strengths of both motors, 0 to 65535, at each change
        self._feel = _RUMBLE(self._rumbled)
        about = _About(1, kind, 6, buttons, hats, *((0, 0) if plain else usb), 0, 0, 0, name.encode())
        about.rumble = ctypes.cast(self._feel, ctypes.c_void_p)
        index = self._sdl.SDL_JoystickAttachVirtualEx(ctypes.byref(about))
        if index < 0:
            raise RuntimeError(f"SDL makes no virtual pad: {self._sdl.SDL_GetError().decode()}")
        self.number: int = self._sdl.SDL_JoystickGetDeviceInstanceID(index)
        self._pad = self._sdl.SDL_JoystickOpen(index)
        self.plugged = True

    def press(self, *buttons: str | int) -> None:
        """Hold buttons down: by name (a, b, x, y, start, up ...) or, on a plain pad, by number."""
        for button in buttons:
            self._set(button, 1)

    def release(self, *buttons: str | int) -> None:
        """Release buttons."""
        for button in buttons:
            self._set(button, 0)

    def tap(self, *buttons: str | int) -> None:
        """Press and release within one frame, with an SDL poll in between."""
        self.press(*buttons)
        self._sdl.SDL_JoystickUpdate()
        self.release(*buttons)
        self._sdl.SDL_JoystickUpdate()

    def stick(self, x: float, y: float) -> None:
        """Move the left stick, each axis in [-1, 1], y down."""
        self._sdl.SDL_JoystickSetVirtualAxis(self._pad, 0, round(x * _FULL))
        self._sdl.SDL_JoystickSetVirtualAxis(self._pad, 1, round(y * _FULL))

    def triggers(self, left: float, right: float) -> None:
        """Pull the triggers, each from 0 to 1."""
        for axis, value in ((_LEFT_TRIGGER, left), (_RIGHT_TRIGGER, right)):
            self._sdl.SDL_JoystickSetVirtualAxis(self._pad, axis, round((2.0 * value - 1.0) * _FULL))

    def hat(self, x: int, y: int) -> None:
        """Press the d-pad of a plain pad, each axis -1, 0 or 1, y up."""
        value = (1 if y > 0 else 4 if y < 0 else 0) | (2 if x > 0 else 8 if x < 0 else 0)
        self._sdl.SDL_JoystickSetVirtualHat(self._pad, 0, value)

    def unplug(self) -> None:
        if not self.plugged:
            return
        self.plugged = False
        numbers = [self._sdl.SDL_JoystickGetDeviceInstanceID(i) for i in range(self._sdl.SDL_NumJoysticks())]
        self._sdl.SDL_JoystickDetachVirtual(numbers.index(self.number))
        self._sdl.SDL_JoystickClose(self._pad)

    def __enter__(self) -> "VirtualPad":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.unplug()

    def _rumbled(self, _: int, strong: int, weak: int) -> int:
        self.rumbles.append((strong, weak))
        return 0

    def _set(self, button: str | int, value: int) -> None:
        number = _BUTTONS.index(button) if isinstance(button, str) else button
        self._sdl.SDL_JoystickSetVirtualButton(self._pad, number, value)


class _About(ctypes.Structure):
    """SDL_VirtualJoystickDesc, version 1."""

    _fields_ = (
        *((name, ctypes.c_uint16) for name in ("version", "type", "axes", "buttons", "hats", "vendor", "product", "_")),
        *((name, ctypes.c_uint32) for name in ("button_mask", "axis_mask")),
        ("name", ctypes.c_char_p),
        *((name, ctypes.c_void_p) for name in ("user", "update", "player", "rumble", "triggers", "led", "effect")),
    )


@cache
def sdl_library() -> ctypes.CDLL:
    home = Path(pygame.__file__).parent
    places = (home, home / ".dylibs", home.parent / "pygame_ce.libs")
    found = [path for place in places for name in ("libSDL2-2*", "SDL2.dll") for path in place.glob(name)]
    if not found:
        raise RuntimeError(f"no SDL library beside {home}")
    sdl = ctypes.CDLL(str(found[0]))
    pad, number = ctypes.c_void_p, ctypes.c_int
    sdl.SDL_JoystickOpen.restype = pad
    sdl.SDL_GetError.restype = ctypes.c_char_p
    sdl.SDL_JoystickClose.argtypes = (pad,)
    sdl.SDL_JoystickSetVirtualAxis.argtypes = (pad, number, ctypes.c_int16)
    sdl.SDL_JoystickSetVirtualButton.argtypes = (pad, number, ctypes.c_uint8)
    sdl.SDL_JoystickSetVirtualHat.argtypes = (pad, number, ctypes.c_uint8)
    return sdl
