"""What a scene hears: abstract presses, each from a device, never a key or a button number."""

from dataclasses import dataclass
from enum import Enum, auto


class Button(Enum):
    """What a press means. In every menu FIRE accepts; START accepts too, and begins at once where that makes sense."""

    UP = auto()
    DOWN = auto()
    LEFT = auto()
    RIGHT = auto()
    FIRE = auto()  # pad A; the fire key of a keyboard cluster
    BACK = auto()  # pad B; Escape, Backspace
    LEAVE_SEAT = auto()  # the turbo key of a keyboard cluster: gives a seat up in the lobby, means nothing elsewhere
    X = auto()  # pad X; X
    Y = auto()  # pad Y; Tab
    START = auto()  # pad Start; Enter; P pauses a match as Start does
    BRAIN = auto()  # F4: show what the AIs of a match think, one after the other
    STOP = auto()  # F1; both upper shoulder buttons of a pad: all real robots stand at once
    POINT = auto()  # the mouse moved; `at` says where
    CLICK = auto()  # the left button went down; `at` says where
    FOUND = auto()  # a device was plugged in
    LOST = auto()  # a device was pulled out


@dataclass(frozen=True)
class Device:
    """A pad (number: SDL's instance id), one of four keyboard clusters (0..3), or the mouse."""

    kind: str  # "pad", "keys", "mouse"
    number: int = 0


@dataclass(frozen=True)
class InputEvent:
    """One press. `repeat`: a direction held down, repeated. `at`: canvas position, 1920 x 1080, of the mouse.

    `among`: of a key that all clusters of the keyboard share (Enter, Escape …), the clusters, the last used first.
    """

    button: Button
    device: Device
    repeat: bool = False
    at: tuple[float, float] | None = None
    among: tuple[Device, ...] = ()


@dataclass(frozen=True)
class StickState:
    """How a device is held right now: stick in [-1, 1] (ahead and clockwise positive) and two buttons."""

    linear: float = 0.0
    angular: float = 0.0
    fire: bool = False
    turbo: bool = False
