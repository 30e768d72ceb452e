"""One keyboard as four devices: clusters of keys by scancode, so that every layout works. Their keys can be changed.

Enter, Escape and similar keys are shared: they count as pressed by the most recently used cluster or, where only seated
devices act, by the most recently used seated one.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import pygame

from pigaming_app.ui.input.events import Button, Device, StickState
from pigaming_app.ui.input.filters import ButtonChange
from pigaming_app.ui.input.remap import Tables, merged


@dataclass(frozen=True)
class Cluster:
    """The scancodes of one cluster and the labels of its keys."""

    up: tuple[int, ...]
    left: tuple[int, ...]
    down: tuple[int, ...]
    right: tuple[int, ...]
    fire: tuple[int, ...]
    turbo: tuple[int, ...]
    moves: str
    key_name: dict[Button, str]


def _labels(up: str, left: str, down: str, right: str, fire: str, turbo: str) -> dict[Button, str]:
    buttons = (Button.UP, Button.LEFT, Button.DOWN, Button.RIGHT, Button.FIRE, Button.LEAVE_SEAT)
    return dict(zip(buttons, (up, left, down, right, fire, turbo), strict=True))


CLUSTERS = (
    Cluster(
        (pygame.KSCAN_W,),
        (pygame.KSCAN_A,),
        (pygame.KSCAN_S,),
        (pygame.KSCAN_D,),
        (pygame.KSCAN_SPACE,),
        (pygame.KSCAN_LSHIFT,),
        "WASD",
        _labels("W", "A", "S", "D", "SPACE", "SHIFT"),
    ),
    Cluster(
        (pygame.KSCAN_UP,),
        (pygame.KSCAN_LEFT,),
        (pygame.KSCAN_DOWN,),
        (pygame.KSCAN_RIGHT,),
        (pygame.KSCAN_RCTRL, pygame.KSCAN_SLASH),  # many laptops have no right Ctrl
        (pygame.KSCAN_RSHIFT,),
        "← ↑ ↓ →",
        _labels("↑", "←", "↓", "→", "R CTRL", "R SHIFT"),
    ),
    Cluster(
        (pygame.KSCAN_I,),
        (pygame.KSCAN_J,),
        (pygame.KSCAN_K,),
        (pygame.KSCAN_L,),
        (pygame.KSCAN_U,),
        (pygame.KSCAN_O,),
        "IJKL",
        _labels("I", "J", "K", "L", "U", "O"),
    ),
    Cluster(
        (pygame.KSCAN_KP8,),
        (pygame.KSCAN_KP4,),
        (pygame.KSCAN_KP5, pygame.KSCAN_KP2),
        (pygame.KSCAN_KP6,),
        (pygame.KSCAN_KP0, pygame.KSCAN_KP_ENTER),
        (pygame.KSCAN_KP_PLUS,),
        "8456",
        _labels("8", "4", "5", "6", "0", "+"),
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
_SHARED_LABELS = {
    Button.START: "ENTER",
    Button.BACK: "ESC",
    Button.Y: "TAB",
    Button.X: "X",
    Button.BRAIN: "F4",
    Button.STOP: "F1",
}
_SYSTEM_MODIFIERS = pygame.KMOD_LALT | pygame.KMOD_GUI  # modifiers of window-manager shortcuts


FUNCTIONS = {
    "up": Button.UP,
    "left": Button.LEFT,
    "down": Button.DOWN,
    "right": Button.RIGHT,
    "fire": Button.FIRE,
    "turbo": Button.LEAVE_SEAT,
}  # of each cluster, by the names of its fields
DEFAULTS = {
    f"keys{number}": {name: getattr(cluster, name)[0] for name in FUNCTIONS}
    for number, cluster in enumerate(CLUSTERS, start=1)
}  # the first key of each function
_PRINTED = {
    code: cluster.key_name[button]
    for cluster in CLUSTERS
    for name, button in FUNCTIONS.items()
    for code in getattr(cluster, name)[:1]
}  # on the keys of the clusters
_SCANCODE = 1 << 30  # marks a keycode that is a scancode, see SDL_Keycode


def key_label(code: int) -> str:
    """What is printed on a key, on an English keyboard."""
    name = pygame.key.name(code | _SCANCODE, use_compat=False).upper()
    return _PRINTED.get(code) or name.replace("LEFT ", "L ").replace("RIGHT ", "R ").replace("KEYPAD ", "")


def usable(function: str, code: int) -> bool:
    """True if a key can have a function: menus do not need it; one that steers has one character."""
    label = key_label(code)
    shared = code in _SHARED or pygame.KSCAN_F1 <= code <= pygame.KSCAN_F12
    return not shared and 0 < len(label) <= (1 if function in ("up", "left", "down", "right") else 9)


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
        keys = {name: keys.get(name, (code,)) for name, code in codes.items()}
        labels = {button: key_label(codes[name]) for name, button in FUNCTIONS.items()}
        steered = [labels[button] for button in (Button.UP, Button.LEFT, Button.DOWN, Button.RIGHT)]
        same = all(codes[name] == DEFAULTS[device][name] for name in ("up", "left", "down", "right"))
        clusters.append(Cluster(**keys, moves=cluster.moves if same else "".join(steered), key_name=labels))
    return tuple(clusters)


class Keyboard:
    """Key states, tracked from events."""

    def __init__(self) -> None:
        self._down: set[int] = set()
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
        return self.clusters[number].key_name.get(button) or _SHARED_LABELS.get(button, "")
