"""Starts: one for each seat, dragged and turned, or pointed to where the robot shall look."""

from collections.abc import Sequence
from math import atan2, cos, degrees, radians, sin

from pigaming_app.games.drawing.values import Part
from pigaming_app.scenes.editor.model.shapes import Dial, Outline, Paper, Shape
from pigaming_app.scenes.editor.model.symmetry import Image
from pigaming_app.scenes.views.sprites.robot import robot
from pigaming_app.sim.world import RADIUS
from pigaming_app.ui.draw import PLAYERS, Point, regular_polygon

NOSE = 90.0  # px from a robot to the grip by which it is turned
STEP = 15  # degrees


def starts_of(*poses: tuple[int, int, int]) -> tuple[Part, ...]:
    """A start for each (x, y, heading), px and degrees."""
    return tuple(Part.of("start", at=(x, y), heading=heading) for x, y, heading in poses)


class Start(Shape):
    """The start of a seat."""

    radius = RADIUS

    def grips(self, part: Part) -> tuple[Point, ...]:
        x, y = part.point("at")
        a = radians(part.number("heading", 0.0))
        return (x, y), (x + NOSE * cos(a), y + NOSE * sin(a))

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        (x, y), (nose_x, nose_y) = self.grips(part)
        a = radians(part.number("heading", 0.0))
        tip = [(nose_x - 22 * cos(a + turn), nose_y - 22 * sin(a + turn)) for turn in (0.6, 0.0, -0.6)]
        return regular_polygon(32, RADIUS, 0, x, y), [tip[0], (nose_x, nose_y), tip[2]]

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        (x, y), _ = self.grips(part)
        robot(paper.ink, k % len(PLAYERS), *paper.at(x, y), radians(part.number("heading", 0.0)), paper.scale)

    def pulled(self, part: Part, grip: int, x: float, y: float) -> Part:
        ax, ay = part.point("at")
        if not grip:
            return self.moved(part, x - ax, y - ay)
        angle = degrees(atan2(y - ay, x - ax)) if (x, y) != (ax, ay) else 0.0
        return part.changed("heading", STEP * round(angle / STEP) % 360)

    def image(self, part: Part, image: Image) -> Part:
        heading = image.heading(part.number("heading", 0.0))
        return super().image(part, image).changed("heading", round(heading) % 360)

    def dials(self, part: Part) -> Sequence[Dial]:
        return (Dial("turn", _turned),)


def _turned(part: Part) -> Part:
    return part.changed("heading", round(part.number("heading", 0.0) / STEP + 1) * STEP % 360)
