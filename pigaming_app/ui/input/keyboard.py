"""One keyboard as four devices: clusters of keys by their place (scancode), so that every layout plays alike.

Enter, Escape and the like are shared by all clusters; they count as pressed by the one that was used last, and where
only seated devices act, by the seated one that was used last.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import pygame

from pigaming_app.ui.input.events import Act, Device, Drive
from pigaming_app.ui.input.filters import Change


@dataclass(frozen=True)
class Cluster:
    """The scancodes of one cluster, and what is printed on its keys."""

    up: tuple[int, ...]
    left: tuple[int, ...]
    down: tuple[int, ...]
    right: tuple[int, ...]
    fire: tuple[int, ...]
    turbo: tuple[int, ...]
    moves: str
    printed: dict[Act, str]


def _printed(up: str, left: str, down: str, right: str, fire: str, turbo: str) -> dict[Act, str]:
    acts = (Act.UP, Act.LEFT, Act.DOWN, Act.RIGHT, Act.FIRE, Act.LEAVE)
    return dict(zip(acts, (up, left, down, right, fire, turbo), strict=True))


CLUSTERS = (
    Cluster(
        (pygame.KSCAN_W,),
        (pygame.KSCAN_A,),
        (pygame.KSCAN_S,),
        (pygame.KSCAN_D,),
        (pygame.KSCAN_SPACE,),
        (pygame.KSCAN_LSHIFT,),
        "WASD",
        _printed("W", "A", "S", "D", "SPACE", "SHIFT"),
    ),
    Cluster(
        (pygame.KSCAN_UP,),
        (pygame.KSCAN_LEFT,),
        (pygame.KSCAN_DOWN,),
        (pygame.KSCAN_RIGHT,),
        (pygame.KSCAN_RCTRL, pygame.KSCAN_SLASH),  # many a laptop has no right Ctrl
        (pygame.KSCAN_RSHIFT,),
        "← ↑ ↓ →",
        _printed("↑", "←", "↓", "→", "R CTRL", "R SHIFT"),
    ),
    Cluster(
        (pygame.KSCAN_I,),
        (pygame.KSCAN_J,),
        (pygame.KSCAN_K,),
        (pygame.KSCAN_L,),
        (pygame.KSCAN_U,),
        (pygame.KSCAN_O,),
        "IJKL",
        _printed("I", "J", "K", "L", "U", "O"),
    ),
    Cluster(
        (pygame.KSCAN_KP8,),
        (pygame.KSCAN_KP4,),
        (pygame.KSCAN_KP5, pygame.KSCAN_KP2),
        (pygame.KSCAN_KP6,),
        (pygame.KSCAN_KP0, pygame.KSCAN_KP_ENTER),
        (pygame.KSCAN_KP_PLUS,),
        "8456",
        _printed("8", "4", "5", "6", "0", "+"),
    ),
)

_SHARED = {
    pygame.KSCAN_RETURN: Act.START,
    pygame.KSCAN_P: Act.START,
    pygame.KSCAN_ESCAPE: Act.BACK,
    pygame.KSCAN_BACKSPACE: Act.BACK,
    pygame.KSCAN_TAB: Act.ALT,
    pygame.KSCAN_X: Act.EXTRA,
    pygame.KSCAN_F4: Act.BRAIN,
    pygame.KSCAN_F1: Act.STOP,
}
SHARED = frozenset(_SHARED.values())
_SHARED_PRINTED = {Act.START: "ENTER", Act.BACK: "ESC", Act.ALT: "TAB", Act.EXTRA: "X", Act.BRAIN: "F4", Act.STOP: "F1"}
_SYSTEM = pygame.KMOD_LALT | pygame.KMOD_GUI  # held with another key, these speak to the window manager


def _own_keys() -> dict[int, tuple[Device, Act]]:
    keys = {}
    for number, cluster in enumerate(CLUSTERS):
        parts = (
            (cluster.up, Act.UP),
            (cluster.left, Act.LEFT),
            (cluster.down, Act.DOWN),
            (cluster.right, Act.RIGHT),
            (cluster.fire, Act.FIRE),
            (cluster.turbo, Act.LEAVE),
        )
        keys.update({code: (Device("keys", number), act) for codes, act in parts for code in codes})
    return keys


_OWN = _own_keys()


class Keyboard:
    """Which keys are down, as the events told."""

    def __init__(self) -> None:
        self._down: set[int] = set()
        self.latest = tuple(Device("keys", number) for number in range(len(CLUSTERS)))  # the last used first

    def changes(self, event: pygame.Event) -> Iterator[tuple[Device, Change]]:
        """What a KEYDOWN or KEYUP event means, and for which cluster."""
        code = event.scancode
        down = event.type == pygame.KEYDOWN
        if down == (code in self._down) or (down and event.mod & _SYSTEM):
            return
        (self._down.add if down else self._down.discard)(code)
        if code in _OWN:
            device, act = _OWN[code]
            if down:
                self.latest = (device, *(other for other in self.latest if other != device))
            yield device, Change(act, down, str(code))
        elif code in _SHARED:
            yield self.latest[0], Change(_SHARED[code], down, str(code))

    def release(self) -> None:
        """Let go of every key: the window lost the focus, and nobody will say when they come up."""
        self._down.clear()

    def drive(self, number: int) -> Drive:
        """How a cluster is held now."""
        cluster, down = CLUSTERS[number], self._down
        return Drive(
            float(any(key in down for key in cluster.up) - any(key in down for key in cluster.down)),
            float(any(key in down for key in cluster.right) - any(key in down for key in cluster.left)),
            any(key in down for key in cluster.fire),
            any(key in down for key in cluster.turbo),
        )


def label(number: int, act: Act) -> str:
    """What is printed on the key of a cluster that means `act`; empty if no key does."""
    return CLUSTERS[number].printed.get(act) or _SHARED_PRINTED.get(act, "")
