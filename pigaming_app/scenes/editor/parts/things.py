"""Things of an arena: mud, a round patch that slows robots down; others can be moved and deleted."""

from collections.abc import Sequence
from math import cos, hypot, sin, tau

from pigaming_app.games.drawing.values import Part, point
from pigaming_app.scenes.editor.model.shapes import Dial, Outline, Paper, Shape, Tool, apart, following, inside
from pigaming_app.scenes.editor.model.symmetry import Image
from pigaming_app.scenes.views.things.on_mat import draw
from pigaming_app.scenes.views.things.styles import ThingStyle
from pigaming_app.sim.things.spec import MAX_MARGIN, Use
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import Point

RADII, RADIUS = (50, 75, 100, 150), 75  # px
CORNERS = 20  # of a patch; round ones need a single capsule each
MOST = 6  # in an arena


class DrawnThing(Shape):
    """A thing, in the style of a game."""

    fixed = False

    def __init__(self, style: ThingStyle) -> None:
        self.style = style

    def grips(self, part: Part) -> tuple[Point, ...]:
        x, y, radius = _round(part)
        return (x, y), (x + radius, y)

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        return (_corners(part),)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        use = next((use for use in Use if use == part.get("use")), Use.MUD)
        draw(paper.flat(), self.style, use, _corners(part), part.number("margin", 0.0, 0.0, MAX_MARGIN))

    def reach(self, part: Part) -> Sequence[Point]:
        return self.grips(part)[:1]

    def moved(self, part: Part, dx: float, dy: float) -> Part:
        dx, dy = (round(by) for by in inside(self.reach(part), dx, dy))
        return part.changed("outline", tuple((px + dx, py + dy) for px, py in _corners(part)))

    def pulled(self, part: Part, grip: int, x: float, y: float) -> Part:
        ax, ay, _ = _round(part)
        return _sized(part, hypot(x - ax, y - ay)) if grip else self.moved(part, x - ax, y - ay)

    def image(self, part: Part, image: Image) -> Part:
        """Reflected corners run the other way round."""
        corners = [image.point(*corner) for corner in _corners(part)]
        if image.across != image.down:
            corners = [corners[0], *reversed(corners[1:])]
        return part.changed("outline", tuple(corners))

    def same(self, part: Part, other: Part) -> bool:
        a, b = sorted(_corners(part)), sorted(_corners(other))
        return len(a) == len(b) and all(apart(p, q) < 2.0 for p, q in zip(a, b, strict=True))

    def dials(self, part: Part) -> Sequence[Dial]:
        return (Dial("size", lambda part: _sized(part, following(RADII, _round(part)[2]))),)


def patch(a: Point, b: Point) -> Part:
    """A patch round a, up to b."""
    far = apart(a, b)
    return Part.of("thing", use="mud", outline=_outline(*a, min(far, RADII[-1]) if far > RADII[0] else RADIUS))


MUD = Tool("mud", "thing", patch, MOST)


def _corners(part: Part) -> list[Point]:
    found = part.get("outline")
    corners = [corner for value in found if (corner := point(value))] if isinstance(found, tuple) else []
    return corners if len(corners) > 2 else list(_outline(WIDTH / 2, HEIGHT / 2, RADII[0]))


def _round(part: Part) -> tuple[float, float, float]:
    """Middle and half the width, px."""
    corners = _corners(part)
    xs, ys = [x for x, _ in corners], [y for _, y in corners]
    return (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2, (max(xs) - min(xs)) / 2


def _sized(part: Part, radius: float) -> Part:
    x, y, _ = _round(part)
    return part.changed("outline", _outline(x, y, min(max(radius, RADII[0]), RADII[-1])))


def _outline(x: float, y: float, radius: float) -> tuple[Point, ...]:
    turns = [tau * k / CORNERS for k in range(CORNERS)]
    return tuple((round(x + radius * cos(a), 1), round(y + radius * sin(a), 1)) for a in turns)
