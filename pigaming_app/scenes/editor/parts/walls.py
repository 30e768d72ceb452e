"""Walls: dragged at their ends, in any direction, of any thickness; they take bullets, or all of them."""

from collections.abc import Mapping, Sequence
from math import atan2, cos, hypot, pi, sin
from typing import ClassVar

from pigaming_app.games.drawing.values import Part
from pigaming_app.scenes.editor.model.shapes import Dial, Outline, Paper, Shape, Tool, Tools, apart, inside, whole
from pigaming_app.scenes.editor.model.symmetry import Image
from pigaming_app.scenes.editor.parts.starts import Start
from pigaming_app.scenes.editor.parts.things import DrawnThing
from pigaming_app.scenes.views.sprites.wall import SOLID, draw_wall
from pigaming_app.scenes.views.things.styles import NEON
from pigaming_app.sim.arena import BUILT, HEALTH
from pigaming_app.ui.draw import Point

THICK, THICKNESSES = 30, (20, 30, 40, 60, 80, 120)  # px
LENGTH, ROCK = 200, 90  # px: of a wall made by a tap; thickness of a rock
SHORT = 20.0  # px: less of a drag is a tap
TURN = pi / 12  # rad, of a press
ROUNDED = 4  # corners of each end of an outline


class DrawnWall(Shape):
    """A wall from `from` to `to`. `healthy`: bullets can break it."""

    fixed = False
    has_ends = True

    def __init__(self, healthy: bool = True) -> None:
        self.healthy = healthy

    def grips(self, part: Part) -> tuple[Point, ...]:
        return part.point("from"), part.point("to")

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        (ax, ay), (bx, by) = self.grips(part)
        angle, half = atan2(by - ay, bx - ax), _thick(part) / 2
        turns = [(i / ROUNDED - 0.5) * pi for i in range(ROUNDED + 1)]
        ends = [(bx, by, angle + turn) for turn in turns] + [(ax, ay, angle + pi + turn) for turn in turns]
        return ([(x + half * cos(a), y + half * sin(a)) for x, y, a in ends],)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        (ax, ay), (bx, by) = self.grips(part)
        thick = _thick(part)
        health = self.health(part)
        ink = paper.turned((ax + bx) / 2, (ay + by) / 2, atan2(by - ay, bx - ax))
        draw_wall(ink, hypot(bx - ax, by - ay) + thick - 4, thick - 4, health, int(ax * 7 + ay * 13 + bx), abs(health))

    def reach(self, part: Part) -> Sequence[Point]:
        return self.grips(part)

    def moved(self, part: Part, dx: float, dy: float) -> Part:
        dx, dy = inside(self.reach(part), dx, dy)
        (ax, ay), (bx, by) = self.grips(part)
        return part.changed("from", whole(ax + dx, ay + dy)).changed("to", whole(bx + dx, by + dy))

    def pulled(self, part: Part, grip: int, x: float, y: float) -> Part:
        return part.changed(("from", "to")[grip], whole(x, y))

    def image(self, part: Part, image: Image) -> Part:
        a, b = (whole(*image.point(*grip)) for grip in self.grips(part))
        return part.changed("from", a).changed("to", b)

    def same(self, part: Part, other: Part) -> bool:
        """Walls have no direction."""
        a, b = self.grips(part)
        return part == other or part.changed("from", whole(*b)).changed("to", whole(*a)) == other

    def dials(self, part: Part) -> Sequence[Dial]:
        dials = [Dial("turn", self.turned), Dial("thick", _thicker, lambda part: str(round(_thick(part))))]
        return [*dials, Dial("health", _weaker, lambda part: str(self.health(part)))] if self.healthy else dials

    def health(self, part: Part) -> int:
        """Bullets it takes; SOLID: any number."""
        if not self.healthy or part.get("solid", False) is True:
            return SOLID
        return int(part.number("health", HEALTH, 1, HEALTH))

    def turned(self, part: Part) -> Part:
        """Turned clockwise about its middle, as far as the arena allows."""
        (ax, ay), (bx, by) = self.grips(part)
        x, y, half = (ax + bx) / 2, (ay + by) / 2, apart((ax, ay), (bx, by)) / 2
        angle = round(atan2(by - ay, bx - ax) / TURN + 1) * TURN
        dx, dy = half * cos(angle), half * sin(angle)
        return part.changed("from", whole(x - dx, y - dy)).changed("to", whole(x + dx, y + dy))


def wall(a: Point, b: Point) -> Part:
    """A wall from a to b; across, if that is a tap."""
    if apart(a, b) < SHORT:
        a, b = (a[0] - LENGTH / 2, a[1]), (a[0] + LENGTH / 2, a[1])
    return Part.of("wall", from_=whole(*a), to=whole(*b), thick=THICK)


def solid_wall(a: Point, b: Point) -> Part:
    """The same of a game without bullets."""
    return wall(a, b).changed("solid", True)


def rock(a: Point, b: Point) -> Part:
    """A solid block, as long as it is drawn."""
    end = b if apart(a, b) >= SHORT else (a[0] + 10.0 if a[0] < 1500.0 else a[0] - 10.0, a[1])
    return Part.of("wall", from_=whole(*a), to=whole(*end), thick=ROCK, solid=True)


WALL = Tool("wall", "wall", wall, BUILT, tap=False)
ROCK_TOOL = Tool("rock", "wall", rock, BUILT)
SOLID_WALL = Tool("wall", "wall", solid_wall, BUILT, tap=False)


def _thicker(part: Part) -> Part:
    return part.stepped("thick", THICKNESSES, THICK)


def _thick(part: Part) -> float:
    return part.number("thick", THICK, 10, 200)


def _weaker(part: Part) -> Part:
    """One bullet less; after one, solid; after that, whole again."""
    if part.get("solid", False) is True:
        return part.changed("solid", None).changed("health", HEALTH)
    health = int(part.number("health", HEALTH, 1, HEALTH))
    return part.changed("health", health - 1) if health > 1 else part.changed("health", None).changed("solid", True)


class WalledTools(Tools):
    """The editor of a game with walls that nothing breaks and a start for each seat.

    A game gives its name and an arena to begin with, as `template` or as `empty`, and adds kinds of parts to `shapes`
    and tools to `palette`.
    """

    shapes: ClassVar[Mapping[str, Shape]] = {
        "thing": DrawnThing(NEON),
        "wall": DrawnWall(healthy=False),
        "start": Start(),
    }
    palette: Sequence[Tool] = (SOLID_WALL, ROCK_TOOL)
