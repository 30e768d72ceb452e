"""One keyboard as four devices: clusters of keys by scancode, so that every layout works.

Enter, Escape and similar keys are shared: they count as pressed by the most recently used cluster or, where only seated
devices act, by the most recently used seated one.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import pygame

from pigaming_app.ui.input.events import Button, Device, StickState
from pigaming_app.ui.input.filters import ButtonChange


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


def _own_keys() -> dict[int, tuple[Device, Button]]:
    keys = {}
    for number, cluster in enumerate(CLUSTERS):
        parts = (
            (cluster.up, Button.UP),
            (cluster.left, Button.LEFT),
            (cluster.down, Button.DOWN),
            (cluster.right, Button.RIGHT),
            (cluster.fire, Button.FIRE),
            (cluster.turbo, Button.LEAVE_SEAT),
        )
        keys.update({code: (Device("keys", number), button) for codes, button in parts for code in codes})
    return keys


_OWN = _own_keys()


class Keyboard:
    """Key states, tracked from events."""

    def __init__(self) -> None:
        self._down: set[int] = set()
        self.latest = tuple(Device("keys", number) for number in range(len(CLUSTERS)))  # most recently used first

    def changes(self, event: pygame.Event) -> Iterator[tuple[Device, ButtonChange]]:
        """The change caused by a KEYDOWN or KEYUP event, and its cluster."""
        code = event.scancode
        down = event.type == pygame.KEYDOWN
        if down == (code in self._down) or (down and event.mod & _SYSTEM_MODIFIERS):
            return
        (self._down.add if down else self._down.discard)(code)
        if code in _OWN:
            device, button = _OWN[code]
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
        cluster, down = CLUSTERS[number], self._down
        return StickState(
            float(any(key in down for key in cluster.up) - any(key in down for key in cluster.down)),
            float(any(key in down for key in cluster.right) - any(key in down for key in cluster.left)),
            any(key in down for key in cluster.fire),
            any(key in down for key in cluster.turbo),
        )


def label(number: int, button: Button) -> str:
    """The label of a cluster's key for a button; empty if there is none."""
    return CLUSTERS[number].key_name.get(button) or _SHARED_LABELS.get(button, "")
