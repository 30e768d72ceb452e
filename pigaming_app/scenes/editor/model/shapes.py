"""The contract of an editor of a game: kinds of parts, how they are drawn, dragged and changed, and the tools.

Coordinates are px of the arena. Parts are tables of its file; a game may show further ones that are entries of a table,
such as the lines of a track.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import hypot
from typing import ClassVar, NamedTuple

import pygame

from pigaming_app.games.drawing.values import Drawing, Part
from pigaming_app.scenes.editor.model.symmetry import Image
from pigaming_app.sim.arena import BUILT, Arena, build
from pigaming_app.sim.flow_field import Route, descend, expand, free_node
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import CELL, COLUMNS, HEIGHT, NODES, WIDTH, World
from pigaming_app.ui.draw import GlowCanvas, Point, regular_polygon
from pigaming_app.ui.draw.pen import Pen

MOST = 60  # parts of a kind that are shown; no arena that can be played has more
Outline = Sequence[Point]
Routes = Sequence[Sequence[Point]]


@dataclass(frozen=True)
class Paper:
    """A canvas that shows a part of the arena: (left, top) px is its corner (0, 0), `scale` px a px."""

    ink: GlowCanvas
    left: float
    top: float
    scale: float

    def flat(self) -> GlowCanvas:
        """The canvas, to be drawn on in px of the arena."""
        return self.ink.set_transform(self.left, self.top, 0.0, self.scale)

    def turned(self, x: float, y: float, angle: float) -> GlowCanvas:
        """The canvas, to be drawn on about (x, y), turned by `angle` rad."""
        return self.ink.set_transform(*self.at(x, y), angle, self.scale)

    def at(self, x: float, y: float) -> Point:
        """A point of the arena on the canvas, px."""
        return self.left + self.scale * x, self.top + self.scale * y


class Item(NamedTuple):
    """A part of a drawing: the k-th of its kind, from 0."""

    kind: str
    k: int


@dataclass(frozen=True)
class Dial:
    """A property that a press changes to its next value. `read`: the value that its picture shows, if it shows one."""

    icon: str
    turned: Callable[[Part], Part]
    read: Callable[[Part], str] = lambda part: ""


class Shape:
    """A kind of part, at the point `at` unless `grips` differs. A part without one stays where it is.

    `fixed`: all arenas have the same number of it; `first`: the first of them that can be pointed at; `least`: an arena
    needs so many; `radius`: px round its point; `sizes`: a key, its values that a press steps through, its default.
    """

    fixed = True
    first = least = 0
    radius = 0.0
    sizes: ClassVar[tuple[str, Sequence[float], float] | None] = None
    has_ends = False  # its first grip is an end, not its middle
    is_handle = False  # it is not in pictures of the arena
    hollow = False  # it is pointed at by its outline only

    def grips(self, part: Part) -> tuple[Point, ...]:
        """Points that can be dragged; the first is that by which the part is moved."""
        return (part.point("at"),)

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        """Closed outlines, for pointing at it and while it is dragged; by default a circle."""
        return (regular_polygon(20, self.radius, 0.0, *part.point("at")),)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        """Draw the k-th of its kind."""
        raise NotImplementedError

    def reach(self, part: Part) -> Sequence[Point]:
        """Points that stay within the arena wherever the part is moved."""
        return square(*part.point("at"), self.radius)

    def moved(self, part: Part, dx: float, dy: float) -> Part:
        """The part elsewhere, but within the arena."""
        if not part.get("at"):
            return part
        x, y = part.point("at")
        dx, dy = inside(self.reach(part), dx, dy)
        return part.changed("at", whole(x + dx, y + dy))

    def pulled(self, part: Part, grip: int, x: float, y: float) -> Part:
        """The part with one of its grips at (x, y)."""
        ax, ay = self.grips(part)[grip]
        return self.moved(part, x - ax, y - ay)

    def image(self, part: Part, image: Image) -> Part:
        """The reflected part."""
        return part if not part.get("at") else part.changed("at", whole(*image.point(*part.point("at"))))

    def same(self, part: Part, other: Part) -> bool:
        """True if both are the same to look at, so that one can be the image of the other."""
        return part == other

    def kept(self, part: Part, other: Part) -> Part:
        """`part` with what belongs to the place of `other` in the file, such as its team."""
        return part

    def dials(self, part: Part) -> Sequence[Dial]:
        """Its properties, at most four."""
        return (Dial("size", partial(_stepped, self.sizes)),) if self.sizes else ()


@dataclass(frozen=True)
class Tool:
    """A kind of part to add. `part(a, b)`: drawn from a to b; `most`: in an arena; `tap`: a tap is enough."""

    name: str
    kind: str
    part: Callable[[Point, Point], Part]
    most: int = BUILT
    tap: bool = True


class Tools:
    """The editor of one game."""

    game = ""
    shapes: ClassVar[Mapping[str, Shape]] = {}  # by kind, those below others first
    palette: Sequence[Tool] = ()
    empty: Drawing | None = None  # to begin with; None: that of `template`
    template = ""  # the name of an arena that comes with the game
    pictures: ClassVar[Mapping[str, Callable[[Pen], None]]] = {}  # of tools and dials, by name, where they have none

    def items(self, drawing: Drawing) -> list[Item]:
        """All parts that can be pointed at, those below others first."""
        return [
            Item(kind, k)
            for kind, shape in self.shapes.items()
            for k in range(shape.first, min(MOST, len(drawing.of(kind))))
        ]

    def part(self, drawing: Drawing, item: Item) -> Part:
        return drawing.of(item.kind)[item.k]

    def with_part(self, drawing: Drawing, item: Item, part: Part) -> Drawing:
        """The drawing with another part in place of one."""
        return drawing.changed(item.kind, item.k, part)

    def added(self, drawing: Drawing, part: Part) -> tuple[Drawing, Item]:
        """With another part, and which one that is."""
        return drawing.added(part), Item(part.kind, len(drawing.of(part.kind)))

    def without(self, drawing: Drawing, item: Item) -> Drawing:
        """Without a part."""
        return drawing.changed(item.kind, item.k, None)

    def removable(self, drawing: Drawing, item: Item) -> bool:
        """True if an arena can do without this part."""
        shape = self.shapes[item.kind]
        return not shape.fixed and len(drawing.of(item.kind)) > shape.least

    def draw_ground(self, paper: Paper, drawing: Drawing) -> Iterator[None]:
        """Draw what lies below all parts."""
        yield from ()

    def ground_of(self, drawing: Drawing) -> Drawing | None:
        """What the ground depends on; None if there is none."""
        return None

    def sketch_ground(self, screen: pygame.Surface, drawing: Drawing, at: Point, scale: float, share: float) -> None:
        """Draw the ground quickly, at a place of the canvas; `share` (0..1): the first part of it."""

    def settled(self, before: Drawing, after: Drawing) -> Drawing:
        """The drawing after a change, with what follows from it."""
        return after

    def routes(self, arena: Arena) -> Routes:
        """How AIs will drive, as lines. It may take a second and runs in a thread. Raises FieldError."""
        return legs(arena, self.ways(arena))

    def ways(self, arena: Arena) -> Sequence[tuple[Point, Point]]:
        """The ends of the ways that AIs will drive; by default from each start to the next one."""
        spots = [(start.x, start.y) for start in arena.starts]
        return list(zip(spots, (*spots[1:], spots[0]), strict=True))


def _stepped(sizes: tuple[str, Sequence[float], float], part: Part) -> Part:
    return part.stepped(*sizes)


def whole(x: float, y: float) -> tuple[int, int]:
    """A point in whole px within the arena."""
    return round(min(max(x, 0.0), WIDTH)), round(min(max(y, 0.0), HEIGHT))


def inside(points: Sequence[Point], dx: float, dy: float) -> Point:
    """The displacement nearest to (dx, dy) that leaves all points within the arena."""
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return min(max(dx, -min(xs)), WIDTH - max(xs)), min(max(dy, -min(ys)), HEIGHT - max(ys))


def square(x: float, y: float, half: float) -> tuple[Point, Point]:
    """Two opposite corners of a square about (x, y)."""
    return (x - half, y - half), (x + half, y + half)


def following(values: Sequence[float], value: float) -> float:
    """The next larger of some values, after the largest the smallest."""
    return next((other for other in values if other > value + 1e-6), values[0])


def apart(a: Point, b: Point) -> float:
    return hypot(a[0] - b[0], a[1] - b[1])


def legs(arena: Arena, ends: Sequence[tuple[Point, Point]]) -> list[list[Point]]:
    """The way from the first to the second of each pair of points, px. Raises FieldError as `build`."""
    world = World()
    build(world, arena)
    return [way for a, b in ends if (way := list(_way(world, a, b)))]


def _way(world: World, a: Point, b: Point) -> Iterator[Point]:
    """Corners of the way; none if there is no way."""
    field, root, node = Route(), free_node(world, *b), free_node(world, *a)
    if not root or not node:
        return
    expand(world, field, root, node)
    if not field.reach[node]:
        return
    here = a
    yield here
    for _ in range(NODES):
        if is_clear(world, *here, *b, world.radius):
            break
        ahead = node
        while ahead != root:
            after = descend(field, ahead)
            x, y = after % COLUMNS * CELL, after // COLUMNS * CELL
            if ahead != node and not is_clear(world, *here, x, y, world.radius):
                break
            ahead = after
        if ahead == node:
            break
        node, here = ahead, (float(ahead % COLUMNS * CELL), float(ahead // COLUMNS * CELL))
        yield here
    yield b
