"""One pointer for all devices: the stick or the keys move it, in steps of the grid when tapped; the mouse places it."""

from math import hypot

from pigaming_app.scenes.editor.board import BOARD, SCALE
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import Point
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button

GRID, FINE = 25, 5  # px, of a tap with and without the grid
DELAY, RAMP = 0.22, 0.7  # s until a held direction glides, and until it is at full speed
SLOW, FAST = 260.0, 1100.0  # px/s
WAYS = {Button.LEFT: (-1, 0), Button.RIGHT: (1, 0), Button.UP: (0, -1), Button.DOWN: (0, 1)}


class Pointer:
    """Its place in the arena, px. `snap`: what it points at lies on the grid."""

    def __init__(self) -> None:
        self.x, self.y, self.snap = WIDTH / 2, HEIGHT / 2, True
        self.shown = True  # False while the mouse has its own
        self.held = 0.0  # s for which a direction has been held

    @property
    def at(self) -> Point:
        """The point that it points at."""
        return self.snapped(self.x, self.y) if self.shown else (self.x, self.y)

    def snapped(self, x: float, y: float) -> Point:
        """The point of the grid nearest to a point; without grid, the nearest px."""
        step = GRID if self.snap else 1
        return float(step * round(x / step)), float(step * round(y / step))

    def tap(self, button: Button) -> bool:
        """One step in a direction; false if that would leave the arena."""
        self.shown, step = True, GRID if self.snap else FINE
        x, y = self.at
        dx, dy = WAYS[button]
        return self._place(x + step * dx, y + step * dy)

    def place(self, at: Point) -> None:
        """Where the mouse is, px of the canvas."""
        self.shown = False
        self._place((at[0] - BOARD.x) / SCALE, (at[1] - BOARD.y) / SCALE)

    def glide(self, controls: Controls, seconds: float) -> bool:
        """Move by the device used last, after `seconds` more; true if it moved."""
        state = controls.drive(controls.last)
        reach = min(1.0, hypot(state.angular, state.linear))
        if reach == 0.0:
            self.held = 0.0
            return False
        self.held += seconds
        if self.held < DELAY:
            return False
        self.shown = True
        share = min(1.0, (self.held - DELAY) / RAMP)
        speed = (SLOW + (FAST - SLOW) * share * share) * seconds
        return self._place(self.x + speed * state.angular, self.y - speed * state.linear)

    def _place(self, x: float, y: float) -> bool:
        before = self.x, self.y
        self.x, self.y = min(max(x, 0.0), WIDTH), min(max(y, 0.0), HEIGHT)
        return (self.x, self.y) != before
