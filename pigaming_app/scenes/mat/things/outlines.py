"""Outlines of things on the mat: light around a thing, none on a tall one."""

from collections.abc import Iterable

import numpy as np
import pygame

from pigaming_app.hardware.scan.things import moved_outwards
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.sim.things.convex import Outline
from pigaming_app.sim.things.spec import ThingSpec, Use
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import LINE, STEEL, THIN, WALL, Color, GlowCanvas, cut_box, dim
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.sprites import Sprite, trim
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import blit_sprite

HALO = 8.0  # px from a thing to its line of light
MUD = (150, 104, 52)
EDGE = 24  # px around an outline, for its glow
COLORS: dict[Use, Color] = {Use.WALL: WALL, Use.MUD: MUD, Use.LINE: STEEL}


def draw_things(screen: pygame.Surface, things: Iterable[ThingSpec]) -> None:
    """Draw things on the canvas, each in the colour of its use."""
    for thing in things:
        draw_thing(screen, thing, COLORS[thing.use])


def draw_thing(screen: pygame.Surface, thing: ThingSpec, color: Color, bold: bool = False) -> None:
    """Draw one thing on the canvas."""
    left, top = (min(corner[i] for corner in thing.outline) for i in (0, 1))
    outline = tuple((round(x - left, 1), round(y - top, 1)) for x, y in thing.outline)
    blit_sprite(screen, _sprite(outline, thing.use, round(thing.margin), color, bold), LEFT + left, TOP + top)


def boxes(ink: GlowCanvas, x: float, y: float, color: Color) -> None:
    """Icon of things: a box, a cup and a strip of tape, about (x, y)."""
    ink.line([(x - 84, y - 50), (x - 8, y - 66), (x + 4, y + 4), (x - 72, y + 20)], color, LINE, True)
    ink.ring(x + 52, y - 14, 30, color, LINE)
    ink.line([(x - 58, y + 52), (x + 66, y + 44), (x + 67, y + 60), (x - 57, y + 68)], color, 0.6 * LINE, True)


@cached
def _sprite(outline: Outline, use: Use, margin: int, color: Color, bold: bool) -> Sprite:
    """A thing whose bounding box begins at (0, 0): walls have a solid line, mud a second one, lines are dashed."""
    wide, high = (max(corner[i] for corner in outline) for i in (0, 1))
    edge = EDGE + margin + round(HALO)
    ink = GlowCanvas(round(wide) + 2 * edge, round(high) + 2 * edge).set_transform(edge, edge)
    halo, width = _around(outline, HALO + margin), 1.5 * LINE if bold else LINE
    if use is Use.WALL:
        ink.solid(halo)
    if use is Use.LINE:
        ink.dashes(halo, color, width, 18, 12)
    else:
        ink.line(halo, color, width, True)
    if use is Use.MUD:
        ink.dashes(_around(outline, HALO + margin + 10.0), color, 0.6 * LINE, 10, 10)
    return trim(ink.sprite(0.8), edge, edge)


def _around(outline: Outline, px: float) -> list[tuple[float, float]]:
    return [(x, y) for x, y in moved_outwards(np.array(outline), px).tolist()]


@cached
@resumable
def frame() -> Steps[LitImage]:
    """Outline of the arena, dim."""
    layer = Layer(LEFT, TOP, WIDTH, HEIGHT)
    layer.canvas.crisp.line(cut_box(LEFT, TOP, WIDTH, HEIGHT, 28), dim(STEEL, 0.8), THIN, True)
    return (yield from layer.render_steps())
