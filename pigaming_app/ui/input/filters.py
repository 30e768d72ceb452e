"""What is held down: sticks as directions, and directions that press again and again while they are held."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot

from pigaming_app.ui.input.events import Button, Device, InputEvent

DIRECTIONS = (Button.UP, Button.DOWN, Button.LEFT, Button.RIGHT)
FIRST_REPEAT = 0.4  # seconds until a held direction presses again
NEXT_REPEAT = 0.12  # seconds between the presses after that
DEAD_ZONE = 0.25  # of the way of a stick: no thumb rests more exactly than that
FULL = 0.95  # of the way, and more, is all the way: a worn stick reaches no further
ON, OFF = 0.6, 0.4  # a stick or trigger counts as pressed beyond ON until it falls below OFF


@dataclass(frozen=True)
class ButtonChange:
    """A button, key or stick of a device went down or up. `part` tells a stick from a d-pad with the same meaning.

    `act`: None for a button that is turbo and means nothing in a menu.
    """

    button: Button | None
    down: bool
    part: str = "button"


class AutoRepeat:
    """The directions held down on any device."""

    def __init__(self) -> None:
        self._due: dict[tuple[Device, Button, str], float] = {}

    def take(self, device: Device, change: ButtonChange) -> bool:
        """Note a direction that went down or up; true if that is a press."""
        assert change.button is not None
        key = (device, change.button, change.part)
        if not change.down:
            self._due.pop(key, None)
            return False
        fresh = key not in self._due
        self._due.setdefault(key, FIRST_REPEAT)
        return fresh

    def drop(self, device: Device) -> None:
        """Let go of everything on a device."""
        self._due = {key: due for key, due in self._due.items() if key[0] != device}

    def repeats(self, seconds: float) -> Iterator[InputEvent]:
        """The presses that became due in the `seconds` that have passed: at most one for each held direction."""
        for key, due in list(self._due.items()):
            left = due - seconds
            self._due[key] = left if left > 0.0 else NEXT_REPEAT
            if left <= 0.0:
                yield InputEvent(key[1], key[0], repeat=True)


class StickDirection:
    """A stick as one of four directions, with hysteresis so that a trembling thumb presses once."""

    def __init__(self) -> None:
        self._button: Button | None = None

    def moved(self, x: float, y: float) -> Iterator[ButtonChange]:
        """What changes when the stick goes to (x, y), each in [-1, 1], y down."""
        reach = {Button.UP: -y, Button.DOWN: y, Button.LEFT: -x, Button.RIGHT: x}
        if self._button and reach[self._button] < OFF:
            yield ButtonChange(self._button, False, "stick")
            self._button = None
        furthest = max(reach, key=lambda act: reach[act])
        if self._button is None and reach[furthest] > ON:
            yield ButtonChange(furthest, True, "stick")
            self._button = furthest


class Trigger:
    """An analogue trigger as a button that means `act`, with hysteresis."""

    def __init__(self, act: Button | None = Button.FIRE) -> None:
        self.button, self.down = act, False

    def moved(self, value: float) -> Iterator[ButtonChange]:
        """What changes when the trigger goes to `value` in [0, 1]."""
        down = value > (OFF if self.down else ON)
        if down != self.down:
            self.down = down
            yield ButtonChange(self.button, down, "trigger")


def outside_dead_zone(x: float, y: float) -> tuple[float, float]:
    """A stick position without its radial dead zone: 0 at the zone's edge, and (1, 1) in the corner.

    The corner is stretched because a stick moves in a circle but keys reach it: all drive equally fast.
    """
    reach = hypot(x, y)
    if reach <= DEAD_ZONE:
        return (0.0, 0.0)
    along = min(1.0, (reach - DEAD_ZONE) / (FULL - DEAD_ZONE)) / max(abs(x), abs(y))
    return (x * along, y * along)
