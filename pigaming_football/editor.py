"""The editor of pitches: walls, bumpers, cut corners, goals, starts, and the points at which the ball is dropped."""

from collections.abc import Callable, Mapping, Sequence
from typing import ClassVar

import pygame

from pigaming_app.api.arenas import Drawing, Part
from pigaming_app.api.editor import (
    SHORT,
    SOLID_WALL,
    Dial,
    Image,
    Item,
    Outline,
    Paper,
    Routes,
    Shape,
    Start,
    Thing,
    Tool,
    Tools,
    Wall,
    apart,
    following,
    legs,
    rock,
    square,
    starts_of,
    whole,
)
from pigaming_app.api.look import HAIR, MIST, NEON, STEEL, THIN, Pen, Point, Steps, regular_polygon
from pigaming_app.api.rules import HEIGHT, WIDTH, Arena

from .pitch import BALL, FEWEST, NARROWEST, WIDEST
from .screens.sprites import CIRCLE, draw_goal, draw_lines
from .state import LEFT, MAX_DROPS, MIDDLE, RIGHT

WIDTHS = (130, 180, 220, 260, 320, 400)  # px, of goals
USUAL = 180.0
BUMPER = 64  # px across
CUT, CUTS = 130.0, (60.0, 440.0)  # px that a tap cuts off a corner along either side, and least and most
NET = 0.6  # size of a goal's picture, which lies on the pitch here
DEEP = 40.0  # px of it
BEFORE = 60.0  # px from a goal's line to the end of a route
DROPS = (
    (800, 450), (400, 450), (1200, 450), (800, 170), (800, 730), (400, 200), (1200, 200), (400, 700), (1200, 700),
)  # fmt: skip
EMPTY = Drawing(
    (
        Part.of("goal", several=False, width=180),
        *starts_of((300, 290, 0), (1300, 610, 180), (300, 610, 0), (1300, 290, 180)),
        *(Part.of("drop", at=at) for at in DROPS),
    )
)


class Goal(Shape):
    """One of both goals, which are equally wide: dragged at a post."""

    has_ends = True

    def grips(self, part: Part) -> tuple[Point, ...]:
        half = _width(part) / 2
        return (_line(part), MIDDLE - half), (_line(part), MIDDLE + half)

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        (x, top), (_, bottom) = self.grips(part)
        inside = x + (DEEP if x < WIDTH / 2 else -DEEP)
        return ([(x, top), (inside, top), (inside, bottom), (x, bottom)],)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        side = LEFT if _line(part) < WIDTH / 2 else RIGHT
        draw_goal(paper.flat(), side, _line(part), MIDDLE, _width(part) / 2, NET, inside=True)

    def reach(self, part: Part) -> Sequence[Point]:
        return self.grips(part)

    def moved(self, part: Part, dx: float, dy: float) -> Part:
        """Goals stay in the middle."""
        return part

    def pulled(self, part: Part, grip: int, x: float, y: float) -> Part:
        return part.changed("width", round(min(max(2 * abs(y - MIDDLE), NARROWEST), WIDEST)))

    def image(self, part: Part, image: Image) -> Part:
        return part.changed("line", WIDTH - _line(part)) if image.across else part

    def dials(self, part: Part) -> Sequence[Dial]:
        return (Dial("size", lambda part: part.changed("width", following(WIDTHS, _width(part)))),)


class Drop(Shape):
    """A point at which the ball is dropped."""

    fixed = False
    is_handle = True

    def reach(self, part: Part) -> Sequence[Point]:
        return square(*part.point("at"), BALL)

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        return (regular_polygon(20, BALL, 0.0, *part.point("at")),)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        x, y = part.point("at")
        paper.flat().dashes(regular_polygon(20, BALL, 0.0, x, y), MIST, THIN, 9, 8).disc(x, y, 5, MIST)


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


class FootballTools(Tools):
    """The editor of Robot Football. Its goals are one entry of the file, shown on either side."""

    game = "football"
    shapes: ClassVar[Mapping[str, Shape]] = {
        "thing": Thing(NEON),
        "goal": Goal(),
        "drop": Drop(),
        "wall": Wall(healthy=False),
        "start": Start(),
    }
    palette = (
        SOLID_WALL,
        Tool("football_bumper", "wall", lambda a, b: rock(a, b).changed("thick", BUMPER)),
        Tool("football_corner", "wall", lambda a, b: _corner(a, b)),
        Tool("football_drop", "drop", lambda a, b: Part.of("drop", at=whole(*b)), MAX_DROPS),
    )
    empty = EMPTY
    pictures: ClassVar[Mapping[str, Callable[[Pen], None]]] = {
        "football_bumper": _bumper,
        "football_corner": _cut,
        "football_drop": _drop,
    }

    def items(self, drawing: Drawing) -> list[Item]:
        """Both goals, and all drop points but the middle."""
        others = [item for item in super().items(drawing) if item.kind != "goal" and item != Item("drop", 0)]
        goals = [Item("goal", side) for side in (LEFT, RIGHT) if drawing.of("goal")]
        things = sum(item.kind == "thing" for item in others)
        return [*others[:things], *goals, *others[things:]]

    def part(self, drawing: Drawing, item: Item) -> Part:
        if item.kind != "goal":
            return super().part(drawing, item)
        return Part.of("goal", width=_width(drawing.of("goal")[0]), line=0.0 if item.k == LEFT else WIDTH)

    def with_part(self, drawing: Drawing, item: Item, part: Part) -> Drawing:
        if item.kind != "goal":
            return super().with_part(drawing, item, part)
        return drawing.changed("goal", 0, drawing.of("goal")[0].changed("width", part.get("width")))

    def removable(self, drawing: Drawing, item: Item) -> bool:
        return super().removable(drawing, item) and (item.kind != "drop" or len(drawing.of("drop")) > FEWEST)

    def draw_ground(self, paper: Paper, drawing: Drawing) -> Steps[None]:
        """The lines of the pitch."""
        yield
        half = next((_width(goal) for goal in drawing.of("goal")), USUAL) / 2
        draw_lines(paper.flat(), 0.0, 0.0, WIDTH, HEIGHT, half)

    def ground_of(self, drawing: Drawing) -> Drawing:
        return Drawing(drawing.of("goal"))

    def sketch_ground(self, screen: pygame.Surface, drawing: Drawing, at: Point, scale: float, share: float) -> None:
        x, y = at[0] + scale * WIDTH / 2, at[1] + scale * MIDDLE
        pygame.draw.line(screen, STEEL, (x, at[1]), (x, at[1] + share * scale * HEIGHT), HAIR)
        pygame.draw.circle(screen, STEEL, (x, y), share * scale * CIRCLE, HAIR)

    def routes(self, arena: Arena) -> Routes:
        """From each start to the middle, and on to both goals."""
        middle = WIDTH / 2, MIDDLE
        ends = [((start.x, start.y), middle) for start in arena.starts]
        return legs(arena, [*ends, *((middle, (x, MIDDLE)) for x in (BEFORE, WIDTH - BEFORE))])


def _width(part: Part) -> float:
    """The width of a goal, px."""
    return part.number("width", USUAL, NARROWEST, WIDEST)


def _line(part: Part) -> float:
    """x of a goal's line."""
    return part.number("line", 0.0)


def _corner(a: Point, b: Point) -> Part:
    """A wall across the corner that is nearest to a, below b."""
    x, y = (0.0 if a[0] < WIDTH / 2 else WIDTH), (0.0 if a[1] < HEIGHT / 2 else HEIGHT)
    cut = CUT if apart(a, b) < SHORT else min(max(abs(b[0] - x) + abs(b[1] - y), CUTS[0]), CUTS[1])
    return Part.of("wall", from_=whole(x, abs(y - cut)), to=whole(abs(x - cut), y), thick=30, solid=True)


TOOLS = FootballTools()
