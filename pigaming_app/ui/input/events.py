"""Input events: abstract buttons of a device, independent of key and button numbers."""

from dataclasses import dataclass
from enum import Enum, auto


class Button(Enum):
    """Meaning of an input. In menus FIRE and START accept; START also begins at once where possible."""

    UP = auto()
    DOWN = auto()
    LEFT = auto()
    RIGHT = auto()
    FIRE = auto()  # pad A; the fire key of a keyboard cluster
    BACK = auto()  # pad B; Escape, Backspace
    LEAVE_SEAT = auto()  # the turbo key of a keyboard cluster: leaves the seat in the lobby, no effect elsewhere
    X = auto()  # pad X; X
    Y = auto()  # pad Y; Tab
    START = auto()  # pad Start; Enter; P pauses a match as Start does
    BRAIN = auto()  # F4: cycle through the brain overlays of a match
    STOP = auto()  # F1; both upper shoulder buttons of a pad: stop all real robots at once
    POINT = auto()  # the mouse moved; position in `at`
    CLICK = auto()  # the left mouse button went down; position in `at`
    FOUND = auto()  # a device was plugged in
    LOST = auto()  # a device was unplugged


@dataclass(frozen=True)
class Device:
    """A pad (number: SDL's instance id), a phone, one of four keyboard clusters (0..3), or the mouse."""

    kind: str  # "pad", "phone", "keys", "mouse"
    number: int = 0

    @property
    def has_stick(self) -> bool:
        """True for a pad or a phone: a stick, buttons A, B, X, Y and START, and B is both turbo and BACK."""
        return self.kind in ("pad", "phone")


@dataclass(frozen=True)
class InputEvent:
    """One press. `repeat`: from auto-repeat. `at`: mouse position on the 1920 x 1080 canvas.

    `among`: for keys shared by all keyboard clusters (Enter, Escape …), the clusters, most recently used first.
    """

    button: Button
    device: Device
    repeat: bool = False
    at: tuple[float, float] | None = None
    among: tuple[Device, ...] = ()


@dataclass(frozen=True)
class StickState:
    """Current state of a device: stick axes in [-1, 1] (ahead and clockwise positive) and two buttons."""

    linear: float = 0.0
    angular: float = 0.0
    fire: bool = False
    turbo: bool = False
