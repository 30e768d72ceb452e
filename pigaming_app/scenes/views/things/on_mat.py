"""Real things on the mat, in the look of each game.

A thing that is a wall stands under the projector: it is black up to its margin, so that no light falls on it, and the
light around it shows where the game's wall ends. Flat things are drawn as the game's mud or paint. Sprites are built
within a budget per frame; until then a thing is black, or keeps its light of a moment ago.
"""

import math
from collections.abc import Iterator, Sequence
from functools import lru_cache, partial
from typing import NamedTuple

import pygame

from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.things.outlines import grown
from pigaming_app.scenes.views.things.styles import ThingStyle
from pigaming_app.sim.things.spec import ThingSpec, Use
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import BLACK, GlowCanvas, Point
from pigaming_app.ui.draw.frame_budget import Job, Steps, Unfinished, budget, clock, resumable
from pigaming_app.ui.draw.sprites import Batch, Sprite, put, trim
from pigaming_app.ui.draw.surface_cache import cached

TURNS = 360  # headings of a sprite
REACH = 48  # px of light beyond an outline, besides its margin
RIM = 8  # px of light beyond the margin of a wall that covers the ground
BUILD = 0.001  # s a frame for building sprites
GLOW = 0.9
Shape = tuple[Point, ...]  # corners, whole px from their mean, with the longest side along x


class Placed(NamedTuple):
    """A thing on the canvas: where its sprite is anchored, which one it is, and the area that stays dark."""

    x: float
    y: float
    use: Use
    shape: Shape
    turn: int
    margin: int
    dark: Shape  # canvas px; empty for flat things
    bed: Shape  # canvas px, the area from which its light replaces the ground


class ThingsOnMat:
    """The things of one match."""

    def __init__(self, style: ThingStyle, things: Sequence[ThingSpec] = ()) -> None:
        self.style = style
        self.placed: list[Placed] = []
        self.sprites: list[tuple[Shape, Sprite] | None] = []  # the latest of each thing
        self.begun: tuple[int, tuple[Use, Shape, int, int]] | None = None  # thing and sprite that is being built
        self.next = 0  # thing whose sprite is looked up first
        self.show(things)

    def show(self, things: Sequence[ThingSpec]) -> None:
        """Replace all things. Takes microseconds a thing; sprites follow in `lights`."""
        self.placed = [place(thing) for thing in things]
        self.sprites = (self.sprites + [None] * len(self.placed))[: len(self.placed)]

    def jobs(self) -> Iterator[Job]:
        """Prewarm jobs for the sprites."""
        return (partial(halo, self.style, *thing[2:6]) for thing in self.placed)

    def lights(self, batch: Batch) -> None:
        """Append the light around and on all things to a batch of light on the ground."""
        self._build()
        for thing, sprite in zip(self.placed, self.sprites, strict=True):
            if sprite and sprite[0] == thing.shape:
                put(batch, sprite[1], thing.x, thing.y)

    def _build(self) -> None:
        """Look up the sprites, in turn, and build missing ones while there is time.

        One that was begun is finished first, so that even a thing that keeps turning gets its light.
        """
        todo = [(i, thing[2:6]) for i, thing in enumerate(self.placed)]
        todo = [*([self.begun] if self.begun else []), *todo[self.next :], *todo[: self.next]]
        self.begun = None
        with budget.until(clock() + BUILD):
            for i, sprite in todo:
                try:
                    light = halo(self.style, *sprite)
                except Unfinished:
                    self.begun, self.next = (i, sprite), i
                    break
                if i < len(self.sprites):
                    self.sprites[i] = sprite[1], light

    def clear(self, screen: pygame.Surface) -> None:
        """Black out the ground below all things and the light on their edges, within the arena."""
        _black_out(screen, [thing.bed for thing in self.placed])

    def cover(self, screen: pygame.Surface) -> None:
        """Black out all things that light must not fall on, within the arena."""
        _black_out(screen, [thing.dark for thing in self.placed if thing.dark])


def _black_out(screen: pygame.Surface, areas: Sequence[Shape]) -> None:
    before = screen.get_clip()
    screen.set_clip(before.clip(pygame.Rect(LEFT, TOP, int(WIDTH), int(HEIGHT))))
    for area in areas:
        pygame.draw.polygon(screen, BLACK, area)
    screen.set_clip(before)


@lru_cache(maxsize=64)
def place(thing: ThingSpec) -> Placed:
    """A thing's place on the canvas and its sprite's shape and heading."""
    x, y = thing.middle
    corners = [(cx - x, cy - y) for cx, cy in thing.outline]
    sides = zip(corners, (*corners[1:], corners[0]), strict=True)
    (ax, ay), (bx, by) = max(sides, key=lambda side: math.dist(*side))
    angle = math.atan2(by - ay, bx - ax)
    c, s = math.cos(angle), math.sin(angle)
    shape = tuple((float(round(c * px + s * py)), float(round(c * py - s * px))) for px, py in corners)
    turn = round(angle / math.tau * TURNS) % TURNS
    on_canvas = [(LEFT + px, TOP + py) for px, py in thing.outline]
    if thing.use is not Use.WALL:
        return Placed(LEFT + x, TOP + y, thing.use, shape, turn, 0, (), tuple(on_canvas))
    margin = math.ceil(thing.margin)
    dark, bed = tuple(grown(on_canvas, margin)), tuple(grown(on_canvas, margin + RIM))
    return Placed(LEFT + x, TOP + y, thing.use, shape, turn, margin, dark, bed)


@cached
@resumable
def halo(style: ThingStyle, use: Use, shape: Shape, turn: int, margin: int) -> Steps[Sprite]:
    """The light of a thing, as light to add, at heading `turn` of TURNS."""
    angle = turn * math.tau / TURNS
    c, s = math.cos(angle), math.sin(angle)
    turned = [(c * x - s * y, s * x + c * y) for x, y in shape]
    w = math.ceil(max(abs(x) for x, _ in turned)) + REACH + margin
    h = math.ceil(max(abs(y) for _, y in turned)) + REACH + margin
    ink = GlowCanvas(2 * w, 2 * h).set_transform(w, h)
    draw(ink, style, use, turned, margin)
    yield
    image = yield from ink.lit_steps(GLOW)
    return trim(image, w, h)


def draw(ink: GlowCanvas, style: ThingStyle, use: Use, corners: Sequence[Point], margin: float) -> None:
    """Draw one thing in the style of a game, with a black body if it is a wall."""
    if use is Use.WALL:
        style.wall(ink, corners, margin)
        ink.fill(grown(corners, margin), BLACK)
    elif use is Use.MUD:
        style.mud(ink, corners)
    else:
        style.line(ink, corners)


def draw_all(ink: GlowCanvas, style: ThingStyle, things: Sequence[ThingSpec]) -> None:
    """Draw all things, arena px: flat ones first."""
    for thing in sorted(things, key=lambda thing: thing.use is Use.WALL):
        draw(ink, style, thing.use, thing.outline, thing.margin)


def black_out(ink: GlowCanvas, things: Sequence[ThingSpec]) -> None:
    """Remove all that was drawn on a canvas, arena px, where there are things."""
    for thing in things:
        ink.fill(thing.outline, BLACK)
