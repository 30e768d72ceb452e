"""A pen for line icons: strokes on a 2 x 2 square, placed on a canvas."""

from collections.abc import Callable
from functools import partial
from operator import methodcaller

from pigaming_app.ui.draw.glow import GlowCanvas
from pigaming_app.ui.draw.theme import Color, Point, Points


class Pen:
    """Draws on the square from (-1, -1) to (1, 1), placed on a canvas."""

    def __init__(self, ink: GlowCanvas, x: float, y: float, r: float, color: Color, w: float) -> None:
        self.ink, self.x, self.y, self.r, self.color, self.w = ink, x, y, r, color, w

    def at(self, points: Points) -> list[Point]:
        """Points of the square in canvas px."""
        return [(self.x + a * self.r, self.y + b * self.r) for a, b in points]

    def line(self, *points: Point, closed: bool = False) -> None:
        self.ink.line(self.at(points), self.color, self.w, closed)

    def fill(self, *points: Point) -> None:
        self.ink.fill(self.at(points), self.color)

    def dot(self, x: float, y: float, r: float) -> None:
        self.ink.disc(self.x + x * self.r, self.y + y * self.r, r * self.r, self.color)

    def ring(self, r: float) -> None:
        """A circle round the middle of the square."""
        self.ink.ring(self.x, self.y, r * self.r, self.color, self.w)


Icon = Callable[[Pen], None]
line, fill, dot, ring = (
    partial(methodcaller, shape) for shape in ("line", "fill", "dot", "ring")
)  # icons of one shape


def together(*shapes: Icon) -> Icon:
    """The icon of several shapes."""

    def draw(pen: Pen) -> None:
        for shape in shapes:
            shape(pen)

    return draw
