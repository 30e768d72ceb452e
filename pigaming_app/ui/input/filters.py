"""Input filters: stick to direction, dead zone, hysteresis, and auto-repeat of held directions."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot

from pigaming_app.ui.input.events import Button, Device, InputEvent

DIRECTIONS = (Button.UP, Button.DOWN, Button.LEFT, Button.RIGHT)
FIRST_REPEAT = 0.4  # seconds until a held direction repeats
NEXT_REPEAT = 0.12  # seconds between later repeats
DEAD_ZONE = 0.25  # share of a stick's travel; thumbs do not rest more exactly than that
FULL = 0.95  # share of the travel that counts as full deflection: worn sticks reach no further
ON, OFF = 0.6, 0.4  # hysteresis: a stick or trigger is pressed above ON, released below OFF


@dataclass(frozen=True)
class ButtonChange:
    """A button, key or stick direction went down or up. `part` distinguishes inputs with the same meaning.

    `button`: None for a turbo button without a meaning in menus.
    """

    button: Button | None
    down: bool
    part: str = "button"


class AutoRepeat:
    """Auto-repeat of held directions, per device."""

    def __init__(self) -> None:
        self._due: dict[tuple[Device, Button, str], float] = {}

    def take(self, device: Device, change: ButtonChange) -> bool:
        """Record a change of a direction; true if it counts as a press."""
        assert change.button is not None
        key = (device, change.button, change.part)
        if not change.down:
            self._due.pop(key, None)
            return False
        fresh = key not in self._due
        self._due.setdefault(key, FIRST_REPEAT)
        return fresh

    def drop(self, device: Device) -> None:
        """Release everything held on a device."""
        self._due = {key: due for key, due in self._due.items() if key[0] != device}

    def repeats(self, seconds: float) -> Iterator[InputEvent]:
        """Repeats due after `seconds` more: at most one per held direction."""
        for key, due in list(self._due.items()):
            left = due - seconds
            self._due[key] = left if left > 0.0 else NEXT_REPEAT
            if left <= 0.0:
                yield InputEvent(key[1], key[0], repeat=True)


class StickDirection:
    """A stick as one of four directions, with hysteresis against a trembling thumb."""

    def __init__(self) -> None:
        self._button: Button | None = None

    def moved(self, x: float, y: float) -> Iterator[ButtonChange]:
        """The changes caused by moving the stick to (x, y), each in [-1, 1], y down."""
        reach = {Button.UP: -y, Button.DOWN: y, Button.LEFT: -x, Button.RIGHT: x}
        if self._button and reach[self._button] < OFF:
            yield ButtonChange(self._button, False, "stick")
            self._button = None
        furthest = max(reach, key=lambda button: reach[button])
        if self._button is None and reach[furthest] > ON:
            yield ButtonChange(furthest, True, "stick")
            self._button = furthest


class Trigger:
    """An analogue trigger as a button, with hysteresis."""

    def __init__(self, button: Button | None = Button.FIRE) -> None:
        self.button, self.down = button, False

    def moved(self, value: float) -> Iterator[ButtonChange]:
        """The changes caused by moving the trigger to `value` in [0, 1]."""
        down = value > (OFF if self.down else ON)
        if down != self.down:
            self.down = down
            yield ButtonChange(self.button, down, "trigger")


def apply_dead_zone(x: float, y: float) -> tuple[float, float]:
    """Remove the radial dead zone and rescale: 0 at its edge, (1, 1) in the corner.

    Corners are stretched because a stick moves in a circle: sticks then reach the same diagonal as keys.
    """
    reach = hypot(x, y)
    if reach <= DEAD_ZONE:
        return (0.0, 0.0)
    along = min(1.0, (reach - DEAD_ZONE) / (FULL - DEAD_ZONE)) / max(abs(x), abs(y))
    return (x * along, y * along)
