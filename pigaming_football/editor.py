"""The editor of pitches: walls, bumpers, cut corners, goals, starts, and the points at which the ball is dropped."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import dist
from typing import ClassVar

import pygame

from pigaming_app.api.arenas import Drawing, Part
from pigaming_app.api.editor import Paper, Pen, Shape, Tool, WalledTools
from pigaming_app.api.look import STYLE, regular_polygon
from pigaming_app.api.rules import HEIGHT, WIDTH, Arena

from .pitch import BALL, FEWEST, NARROWEST, WIDEST
from .screens.sprites import CIRCLE, draw_goal, draw_lines
from .state import LEFT, MAX_DROPS, MIDDLE, RIGHT
from .surprise import STARTS

Point = tuple[float, float]
WALL, ROCK = WalledTools.palette
WIDTHS = (130, 180, 220, 260, 320, 400)  # px, of goals
USUAL = 180.0
BUMPER = 64  # px across
CUT, CUTS = 130.0, (60.0, 440.0)  # px that a tap cuts off a corner along either side, and least and most
NET = 0.6  # size of a goal's picture, which lies on the pitch here
DEEP = 40.0  # px of it
TAP = 20.0  # px: less of a drag is a tap
BEFORE = 60.0  # px from a goal's line to the end of a route
DROPS = (
    (800, 450), (400, 450), (1200, 450), (800, 170), (800, 730), (400, 200), (1200, 200), (400, 700), (1200, 700),
)  # fmt: skip
EMPTY = Drawing(
    (
        Part.of("goal", several=False, width=180),
        *(Part.of("start", at=(x, y), heading=heading) for x, y, heading in STARTS),
        *(Part.of("drop", at=at) for at in DROPS),
    )
)


class Goal(Shape):
    """Both goals, which are equally wide: dragged at a post. They stay in the middle."""

    has_ends = True
    sizes = "width", WIDTHS, USUAL

    def grips(self, part: Part) -> tuple[Point, ...]:
        half = _width(part) / 2
        return tuple((x, MIDDLE + side) for x in (0.0, WIDTH) for side in (-half, half))

    def outlines(self, part: Part, k: int) -> Sequence[Sequence[Point]]:
        top, bottom = MIDDLE - _width(part) / 2, MIDDLE + _width(part) / 2
        ends = ((0.0, DEEP), (WIDTH, WIDTH - DEEP))
        return [[(x, top), (inside, top), (inside, bottom), (x, bottom)] for x, inside in ends]

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        for side, x in ((LEFT, 0.0), (RIGHT, WIDTH)):
            draw_goal(paper.flat(), side, x, MIDDLE, _width(part) / 2, NET, inside=True)

    def pulled(self, part: Part, grip: int, x: float, y: float) -> Part:
        return part.changed("width", round(min(max(2 * abs(y - MIDDLE), NARROWEST), WIDEST)))


class Drop(Shape):
    """A point at which the ball is dropped; the first is the middle."""

    fixed, is_handle = False, True
    first, least, radius = 1, FEWEST, BALL

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        x, y = part.point("at")
        circle = regular_polygon(20, BALL, 0.0, x, y)
        paper.flat().dashes(circle, STYLE.mist, STYLE.thin, 9, 8).disc(x, y, 5, STYLE.mist)


def _bumper(pen: Pen) -> None:
    pen.ring(0.85)
    pen.ring(0.5)
    pen.dot(0, 0, 0.22)


def _cut(pen: Pen) -> None:
    pen.line((-0.9, 0.9), (-0.9, -0.9), (0.9, -0.9))
    pen.line((-0.9, 0.45), (0.45, -0.9))


def _drop(pen: Pen) -> None:
    pen.dot(0, 0.3, 0.3)
    pen.line((0, -1.0), (0, -0.3))
    pen.line((-0.3, -0.6), (0, -0.3), (0.3, -0.6))
    pen.line((-0.8, 0.85), (0.8, 0.85))


class FootballTools(WalledTools):
    """The editor of Robot Football."""

    game = "football"
    shapes: ClassVar[Mapping[str, Shape]] = {
        "thing": WalledTools.shapes["thing"], "goal": Goal(), "drop": Drop(), **WalledTools.shapes
    }  # fmt: skip
    palette = (
        WALL,
        Tool("football_bumper", "wall", lambda a, b: ROCK.part(a, b).changed("thick", BUMPER)),
        Tool("football_corner", "wall", lambda a, b: _corner(a, b)),
        Tool("football_drop", "drop", lambda a, b: Part.of("drop", at=b), MAX_DROPS),
    )
    empty = EMPTY
    pictures: ClassVar[Mapping[str, Callable[[Pen], None]]] = {
        "football_bumper": _bumper,
        "football_corner": _cut,
        "football_drop": _drop,
    }

    def draw_ground(self, paper: Paper, drawing: Drawing) -> Iterator[None]:
        """The lines of the pitch."""
        yield
        half = next((_width(goal) for goal in drawing.of("goal")), USUAL) / 2
        draw_lines(paper.flat(), 0.0, 0.0, WIDTH, HEIGHT, half)

    def ground_of(self, drawing: Drawing) -> Drawing:
        return Drawing(drawing.of("goal"))

    def sketch_ground(self, screen: pygame.Surface, drawing: Drawing, at: Point, scale: float, share: float) -> None:
        x, y = at[0] + scale * WIDTH / 2, at[1] + scale * MIDDLE
        pygame.draw.line(screen, STYLE.steel, (x, at[1]), (x, at[1] + share * scale * HEIGHT), STYLE.hair)
        pygame.draw.circle(screen, STYLE.steel, (x, y), share * scale * CIRCLE, STYLE.hair)

    def ways(self, arena: Arena) -> list[tuple[Point, Point]]:
        """From each start to the middle, and on to both goals."""
        middle = WIDTH / 2, MIDDLE
        ends = [((start.x, start.y), middle) for start in arena.starts]
        return [*ends, *((middle, (x, MIDDLE)) for x in (BEFORE, WIDTH - BEFORE))]


def _width(part: Part) -> float:
    """The width of a goal, px."""
    return part.number("width", USUAL, NARROWEST, WIDEST)


def _corner(a: Point, b: Point) -> Part:
    """A wall across the corner that is nearest to a, below b."""
    x, y = (0.0 if a[0] < WIDTH / 2 else WIDTH), (0.0 if a[1] < HEIGHT / 2 else HEIGHT)
    cut = CUT if dist(a, b) < TAP else min(max(abs(b[0] - x) + abs(b[1] - y), CUTS[0]), CUTS[1])
    return Part.of("wall", from_=(x, abs(y - cut)), to=(abs(x - cut), y), thick=30, solid=True)


TOOLS = FootballTools()
