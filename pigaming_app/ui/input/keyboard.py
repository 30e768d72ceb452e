"""One keyboard as four devices: clusters of keys by scancode, so that every layout works. Their keys can be changed.

Enter, Escape and similar keys are shared: they count as pressed by the most recently used cluster or, where only seated
devices act, by the most recently used seated one.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, cast

import pygame

from pigaming_app.ui.input.events import Button, Device, StickState
from pigaming_app.ui.input.filters import ButtonChange
from pigaming_app.ui.input.remap import Tables, merged

KEYPAD = frozenset(range(pygame.KSCAN_KP_DIVIDE, pygame.KSCAN_KP_PERIOD + 1))  # the keys that most laptops lack
NUM = "NUM "  # before the label of a key on the keypad
FUNCTIONS = {
    "up": Button.UP,
    "left": Button.LEFT,
    "down": Button.DOWN,
    "right": Button.RIGHT,
    "fire": Button.FIRE,
    "turbo": Button.LEAVE_SEAT,
}  # of each cluster, by the names of its fields
STEERING = ("up", "left", "down", "right")


@dataclass(frozen=True)
class Cluster:
    """The scancodes of one cluster, those that are shown first."""

    up: tuple[int, ...]
    left: tuple[int, ...]
    down: tuple[int, ...]
    right: tuple[int, ...]
    fire: tuple[int, ...]
    turbo: tuple[int, ...]

    def label(self, button: Button) -> str:
        """What is printed on the key for a button; empty if there is none."""
        return next((key_label(getattr(self, name)[0]) for name, other in FUNCTIONS.items() if other is button), "")

    @property
    def moves(self) -> str:
        """The signs on the four steering keys."""
        up, left, down, right = (self.label(FUNCTIONS[name]).removeprefix(NUM) for name in STEERING)
        return f"{left} {up} {down} {right}" if up == "↑" else up + left + down + right

    @property
    def on_keypad(self) -> bool:
        """True if it steers with keys of the keypad."""
        return all(getattr(self, name)[0] in KEYPAD for name in STEERING)


CLUSTERS = (
    Cluster(
        (pygame.KSCAN_W,),
        (pygame.KSCAN_A,),
        (pygame.KSCAN_S,),
        (pygame.KSCAN_D,),
        (pygame.KSCAN_SPACE,),
        (pygame.KSCAN_LSHIFT,),
    ),
    Cluster(
        (pygame.KSCAN_UP,),
        (pygame.KSCAN_LEFT,),
        (pygame.KSCAN_DOWN,),
        (pygame.KSCAN_RIGHT,),
        (pygame.KSCAN_RCTRL, pygame.KSCAN_SLASH),  # many laptops have no right Ctrl
        (pygame.KSCAN_RSHIFT,),
    ),
    Cluster(
        (pygame.KSCAN_I,), (pygame.KSCAN_J,), (pygame.KSCAN_K,), (pygame.KSCAN_L,), (pygame.KSCAN_U,), (pygame.KSCAN_O,)
    ),
    Cluster(
        (pygame.KSCAN_KP8,),
        (pygame.KSCAN_KP4,),
        (pygame.KSCAN_KP5, pygame.KSCAN_KP2),
        (pygame.KSCAN_KP6,),
        (pygame.KSCAN_KP0, pygame.KSCAN_KP_ENTER),
        (pygame.KSCAN_KP_PLUS,),
    ),
)

_SHARED = {
    pygame.KSCAN_RETURN: Button.START,
    pygame.KSCAN_P: Button.START,
    pygame.KSCAN_ESCAPE: Button.BACK,
    pygame.KSCAN_BACKSPACE: Button.BACK,
    pygame.KSCAN_TAB: Button.Y,
    pygame.KSCAN_X: Button.X,
    pygame.KSCAN_F4: Button.BRAIN,
    pygame.KSCAN_F1: Button.STOP,
}
SHARED = frozenset(_SHARED.values())
_SHOWN = {button: code for code, button in reversed(_SHARED.items())}  # the key of each that is shown
_SYSTEM_MODIFIERS = pygame.KMOD_LALT | pygame.KMOD_GUI  # modifiers of window-manager shortcuts
_UNUSABLE = {*_SHARED, *range(pygame.KSCAN_F1, pygame.KSCAN_F12 + 1)}
_UNUSABLE |= {pygame.KSCAN_LALT, pygame.KSCAN_LGUI, pygame.KSCAN_RGUI}

DEFAULTS = {
    f"keys{number}": {name: getattr(cluster, name)[0] for name in FUNCTIONS}
    for number, cluster in enumerate(CLUSTERS, start=1)
}  # the first key of each function
_NAMED = {
    pygame.KSCAN_UP: "↑",
    pygame.KSCAN_LEFT: "←",
    pygame.KSCAN_DOWN: "↓",
    pygame.KSCAN_RIGHT: "→",
    pygame.KSCAN_LSHIFT: "SHIFT",
    pygame.KSCAN_RETURN: "ENTER",
    pygame.KSCAN_ESCAPE: "ESC",
}
_SCANCODE = 1 << 30  # marks a keycode that is a scancode, see SDL_Keycode


def key_label(code: int) -> str:
    """What is printed on a key: on one with a sign that of the present layout, on others their English name."""
    if sign := _signs(pygame.display.get_init()).get(code):
        return sign
    name = pygame.key.name(code | _SCANCODE, use_compat=False).upper()
    return _NAMED.get(code) or name.replace("LEFT ", "L ").replace("RIGHT ", "R ").replace("KEYPAD ", NUM)


@cache
def _signs(known: bool) -> Mapping[int, str]:
    """The sign on each key of the present layout, by scancode, of those that our fonts have. `known`: SDL knows it."""
    scancodes = pygame.key.ScancodeWrapper(cast(Any, range(512)))  # a keycode as an index yields its key's scancode
    signs = {scancodes[code]: chr(code) for code in (*range(161, 256), *range(126, 32, -1))}
    return {code: sign.upper() if len(sign.upper()) == 1 else sign for code, sign in signs.items() if code}


def usable(function: str, code: int) -> bool:
    """True if a key can have a function: menus do not need it; one that steers has one character."""
    label, steers = key_label(code), function in STEERING
    return code not in _UNUSABLE and 0 < len(label.removeprefix(NUM) if steers else label) <= (1 if steers else 9)


def _changed(tables: Tables) -> tuple[Cluster, ...]:
    """The clusters with these codes. Second keys of a function stay if nothing else uses them."""
    used = {code for codes in tables.values() for code in codes.values()}
    clusters = []
    for cluster, (device, codes) in zip(CLUSTERS, tables.items(), strict=True):
        keys = {
            name: (code, *(other for other in getattr(cluster, name)[1:] if other not in used))
            for name, code in codes.items()
            if code == DEFAULTS[device][name]
        }
        clusters.append(Cluster(**{name: keys.get(name, (code,)) for name, code in codes.items()}))
    return tuple(clusters)


class Keyboard:
    """Key states, tracked from events."""

    def __init__(self) -> None:
        self._down: set[int] = set()
        self.has_keypad = False  # a key of it was pressed, now or in an earlier start
        self.remap({})
        self.latest = tuple(Device("keys", number) for number in range(len(CLUSTERS)))  # most recently used first

    def remap(self, changed: Mapping[str, Mapping[str, int]]) -> None:
        """Change the keys of the clusters, see remap.py; keys that cannot have a function are left out."""
        fitting = {
            device: {name: code for name, code in codes.items() if usable(name, code)}
            for device, codes in changed.items()
        }
        self.tables = merged(DEFAULTS, fitting)
        self.clusters = _changed(self.tables)
        self._own = {
            code: (Device("keys", number), button)
            for number, cluster in enumerate(self.clusters)
            for name, button in FUNCTIONS.items()
            for code in getattr(cluster, name)
        }
        self._down.clear()

    def changes(self, event: pygame.Event) -> Iterator[tuple[Device, ButtonChange]]:
        """The change caused by a KEYDOWN or KEYUP event, and its cluster."""
        code = event.scancode
        down = event.type == pygame.KEYDOWN
        if down == (code in self._down) or (down and event.mod & _SYSTEM_MODIFIERS):
            return
        (self._down.add if down else self._down.discard)(code)
        self.has_keypad = self.has_keypad or code in KEYPAD
        if code in self._own:
            device, button = self._own[code]
            if down:
                self.latest = (device, *(other for other in self.latest if other != device))
            yield device, ButtonChange(button, down, str(code))
        elif code in _SHARED:
            yield self.latest[0], ButtonChange(_SHARED[code], down, str(code))

    def release(self) -> None:
        """Release all keys: the window lost the focus, so their KEYUP events will not arrive."""
        self._down.clear()

    def new_layout(self) -> None:
        """Read the signs on the keys again: the user has changed the layout."""
        _signs.cache_clear()

    def drive(self, number: int) -> StickState:
        """The current state of a cluster."""
        cluster, down = self.clusters[number], self._down
        return StickState(
            float(any(key in down for key in cluster.up) - any(key in down for key in cluster.down)),
            float(any(key in down for key in cluster.right) - any(key in down for key in cluster.left)),
            any(key in down for key in cluster.fire),
            any(key in down for key in cluster.turbo),
        )

    def label(self, number: int, button: Button) -> str:
        """The label of a cluster's key for a button; empty if there is none."""
        if button in SHARED:
            return key_label(_SHOWN[button])
        return self.clusters[number].label(button)
