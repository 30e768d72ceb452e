"""The board: the drawing at nine tenths of its size, with a picture of each part, drawn once and kept."""

import math
from collections.abc import Collection, Sequence
from contextlib import suppress

import pygame

from pigaming_app.games.drawing.values import Drawing, Part
from pigaming_app.scenes.editor.model.shapes import Item, Paper, Shape, Tools
from pigaming_app.scenes.editor.model.symmetry import Symmetry
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import BLACK, FOCUS, ICE, THIN, WALL, GlowCanvas, Point, cut_box, dim
from pigaming_app.ui.draw.frame_budget import Steps, Unfinished, budget, clock, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.sprites import Sprite, trim
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import blit_sprite

SCALE = 0.9
BOARD = pygame.Rect(384, 118, round(SCALE * WIDTH), round(SCALE * HEIGHT))
OUTLINE = cut_box(BOARD.x, BOARD.y, BOARD.w, BOARD.h, 28)
EDGE = 60  # px around the outlines of a part, for what else belongs to it
GRIP = 13  # px, half the size of a grip
RENDER = 0.006  # s of a frame for the ground
CROSS = 26  # px, of the pointer


def on_canvas(x: float, y: float) -> Point:
    """A point of the arena on the canvas, px."""
    return BOARD.x + SCALE * x, BOARD.y + SCALE * y


def clear(screen: pygame.Surface) -> None:
    """Black out the board and draw its dots and frame."""
    pygame.draw.polygon(screen, BLACK, OUTLINE)
    frame().draw(screen)


class Ground:
    """What lies below the parts: quick lines while it changes, its lit picture as soon as that is rendered."""

    def __init__(self, tools: Tools) -> None:
        self.tools = tools
        self._lit: tuple[Drawing, LitImage] | None = None

    def work(self, drawing: Drawing) -> None:
        """Render the picture, a few ms."""
        needed = self.tools.ground_of(drawing)
        if needed and (self._lit is None or self._lit[0] != needed):
            with suppress(Unfinished), budget.until(clock() + RENDER):
                self._lit = needed, ground(self.tools, needed)

    def draw(self, screen: pygame.Surface, drawing: Drawing, share: float) -> None:
        """Draw it; `share` (0..1): the first part of it."""
        needed = self.tools.ground_of(drawing)
        if needed is None:
            return
        screen.set_clip(BOARD)
        if share >= 1.0 and self._lit and self._lit[0] == needed:
            self._lit[1].draw(screen)
        else:
            self.tools.sketch_ground(screen, drawing, BOARD.topleft, SCALE, share)
        screen.set_clip(None)


@cached
@resumable
def ground(tools: Tools, drawing: Drawing) -> Steps[LitImage]:
    """The picture of the ground, as light."""
    ink = GlowCanvas(BOARD.w, BOARD.h)
    yield from tools.draw_ground(Paper(ink, 0.0, 0.0, SCALE), drawing)
    yield
    image = yield from ink.lit_steps(0.75)
    return LitImage(image, BOARD.topleft)


def draw_parts(
    screen: pygame.Surface, tools: Tools, drawing: Drawing, hidden: Collection[Item], share: float = 1.0
) -> None:
    """Draw the parts of the arena, but not those `hidden`; `share` (0..1): the first ones only."""
    items = tools.items(drawing)
    screen.set_clip(BOARD.inflate(24, 24))
    for item in items[: math.ceil(share * len(items))]:
        if item not in hidden:
            part = tools.part(drawing, item)
            blit_sprite(screen, sprite(tools.shapes[item.kind], part, item.k), *on_canvas(*_corner(tools, part, item)))
    screen.set_clip(None)


def draw_axes(screen: pygame.Surface, symmetry: Symmetry) -> None:
    """Draw the axes of a symmetry, or the middle of half a turn."""
    axes(symmetry).draw(screen)


def draw_outline(screen: pygame.Surface, tools: Tools, drawing: Drawing, item: Item) -> None:
    """Draw the outline of a part that is in hand or selected."""
    for outline in tools.shapes[item.kind].outlines(tools.part(drawing, item), item.k):
        pygame.draw.lines(screen, FOCUS, True, [on_canvas(*point) for point in outline], 4)


def draw_grips(screen: pygame.Surface, tools: Tools, drawing: Drawing, item: Item) -> None:
    """Draw the points of a part that can be dragged."""
    shape = tools.shapes[item.kind]
    for point in shape.grips(tools.part(drawing, item))[0 if shape.has_ends else 1 :]:
        grip().draw(screen, *on_canvas(*point))


def draw_pointer(screen: pygame.Surface, at: Point) -> None:
    cross().draw(screen, *on_canvas(*at))


def _corner(tools: Tools, part: Part, item: Item) -> Point:
    """Upper left corner of the outlines of a part, px."""
    return _bounds(tools.shapes[item.kind].outlines(part, item.k))[:2]


def _bounds(outlines: Sequence[Sequence[Point]]) -> tuple[float, float, float, float]:
    xs, ys = [x for outline in outlines for x, _ in outline], [y for outline in outlines for _, y in outline]
    return math.floor(min(xs)), math.floor(min(ys)), max(xs), max(ys)


@cached
def sprite(shape: Shape, part: Part, k: int) -> Sprite:
    """The picture of a part; its anchor is the upper left corner of its outlines."""
    left, top, right, bottom = _bounds(shape.outlines(part, k))
    w, h = round(SCALE * (right - left)) + 2 * EDGE, round(SCALE * (bottom - top)) + 2 * EDGE
    ink = GlowCanvas(w, h)
    shape.draw(Paper(ink, EDGE - SCALE * left, EDGE - SCALE * top, SCALE), part, k)
    return trim(ink.sprite(0.8), EDGE, EDGE)


@cached
@resumable
def frame() -> Steps[LitImage]:
    """Dots and the frame of the arena."""
    layer = Layer(*BOARD)
    crisp = layer.canvas.crisp
    for x in range(50, int(WIDTH), 50):
        for y in range(50, int(HEIGHT), 50):
            crisp.disc(*on_canvas(x, y), 1.6, (36, 51, 74))
    yield
    layer.glow.line(OUTLINE, dim(WALL, 0.7), THIN, True)
    return (yield from layer.render_steps())


@cached
@resumable
def axes(symmetry: Symmetry) -> Steps[LitImage]:
    """The axes of a symmetry."""
    layer, (x, y), color = Layer(BOARD.x, BOARD.y, BOARD.w, BOARD.h), BOARD.center, dim(FOCUS, 0.4)
    for image in symmetry.images:
        if image.across and image.down:
            layer.canvas.crisp.ring(x, y, 18, color, 3)
        elif image.across:
            layer.canvas.crisp.dashes([(x, BOARD.top + 8), (x, BOARD.bottom - 8)], color, 3, 14, 14, False)
        else:
            layer.canvas.crisp.dashes([(BOARD.left + 8, y), (BOARD.right - 8, y)], color, 3, 14, 14, False)
    return (yield from layer.render_steps())


@cached
def grip() -> LitImage:
    """A point that can be dragged."""
    ink = GlowCanvas(4 * GRIP, 4 * GRIP).set_transform(2 * GRIP, 2 * GRIP)
    ink.disc(0, 0, GRIP, FOCUS).disc(0, 0, GRIP - 4, BLACK)
    return LitImage(ink.lit(0.6), (-2 * GRIP, -2 * GRIP))


@cached
def cross() -> LitImage:
    """The pointer."""
    size = CROSS + 24
    ink = GlowCanvas(2 * size, 2 * size).set_transform(size, size)
    for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        ink.neon([(8 * x, 8 * y), (CROSS * x, CROSS * y)], ICE, THIN)
    return LitImage(ink.disc(0, 0, 2, ICE).lit(0.8), (-size, -size))
