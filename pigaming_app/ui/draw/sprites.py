"""Sprites: painted once at double size, rotated to each heading, trimmed to their lit pixels, cached.

Blitting a cached sprite takes a few microseconds, building a missing one about a millisecond. The set of possible
arguments is finite, so the cache is bounded.
"""

import math
from collections.abc import Callable
from functools import wraps
from typing import Concatenate, NamedTuple, ParamSpec

import pygame

from pigaming_app.ui.draw import MULT, GlowCanvas
from pigaming_app.ui.draw.surface_cache import cached

Args = ParamSpec("Args")
HEADINGS = 96  # fine rotation steps: 3.75 degrees each, two pixels at the end of a barrel


class Sprite(NamedTuple):
    """An image and the offset of its upper left corner from its anchor, px."""

    image: pygame.Surface
    dx: int
    dy: int


Batch = list[tuple[pygame.Surface, tuple[int, int]]]  # what is drawn in one go, from the bottom up; see `put`


def put(batch: Batch, sprite: Sprite, x: float, y: float) -> None:
    """Append a sprite at (x, y) on the canvas to a batch for `fblits`."""
    batch.append((sprite.image, (int(x + sprite.dx + 0.5), int(y + sprite.dy + 0.5))))


def step(angle: float, steps: int) -> int:
    """Quantise an angle, rad, to one of `steps` headings."""
    return round(angle / math.tau * steps) % steps


def master(half: int, arm: float = 0.0) -> GlowCanvas:
    """A double-size canvas for a rotating sprite: `half` px to each side of a point `arm` px ahead of the anchor."""
    return GlowCanvas(4 * half, 4 * half, 2).set_transform(2 * (half - arm), 2 * half, 0, 2)


def turned(image: pygame.Surface, turn: int, steps: int, arm: float = 0.0, zoom: float = 0.5) -> Sprite:
    """Rotate a master by `turn` of `steps` parts of a circle about its anchor."""
    angle = turn * math.tau / steps
    out = pygame.transform.rotozoom(image, -math.degrees(angle), zoom)
    return trim(out, out.get_width() / 2 - arm * math.cos(angle), out.get_height() / 2 - arm * math.sin(angle))


def trim(image: pygame.Surface, x: float, y: float) -> Sprite:
    """Crop an image to its lit or opaque pixels; (x, y) is its anchor."""
    lit = pygame.mask.from_threshold(image, (0, 0, 0), (3, 3, 3, 255))
    lit.invert()
    if image.get_flags() & pygame.SRCALPHA:
        lit.draw(pygame.mask.from_surface(image, 8), (0, 0))
    rects = lit.get_bounding_rects()
    box = rects[0].unionall(rects[1:]) if rects else pygame.Rect(0, 0, 1, 1)
    return Sprite(image.subsurface(box).copy(), round(box.x - x), round(box.y - y))


def faded(sprite: Sprite, share: float) -> Sprite:
    """A sprite at `share` (0..1) of its brightness and opacity."""
    image, part = sprite.image.copy(), round(255 * share)
    flags = pygame.BLEND_RGBA_MULT if image.get_flags() & pygame.SRCALPHA else MULT
    image.fill((part, part, part, part), special_flags=flags)
    return Sprite(image, sprite.dx, sprite.dy)


def light_sprite(
    half: int, glow: float = 0.8
) -> Callable[[Callable[Concatenate[GlowCanvas, Args], object]], Callable[Args, Sprite]]:
    """Decorate a function that draws a sprite of light about (0, 0), up to `half` px to each side; `glow`: its halo.

    The result takes the other arguments, which must be hashable, and is cached.
    """

    def decorated(draw: Callable[Concatenate[GlowCanvas, Args], object]) -> Callable[Args, Sprite]:
        @cached
        @wraps(draw)
        def sprite(*args: Args.args, **named: Args.kwargs) -> Sprite:
            ink = GlowCanvas(2 * half, 2 * half).set_transform(half, half)
            draw(ink, *args, **named)
            return trim(ink.lit(glow), half, half)

        return sprite

    return decorated


def turning_sprite(
    half: int, steps: int, glow: float = 0.8
) -> Callable[[Callable[Concatenate[GlowCanvas, Args], object]], Callable[Concatenate[float, Args], Sprite]]:
    """Decorate a function that draws an opaque sprite heading right about (0, 0), up to `half` px to each side.

    The result takes its heading in rad, rounded to one of `steps`, before the other arguments, and is cached.
    """

    def decorated(draw: Callable[Concatenate[GlowCanvas, Args], object]) -> Callable[Concatenate[float, Args], Sprite]:
        @cached
        def upright(*args: Args.args, **named: Args.kwargs) -> pygame.Surface:
            ink = master(half)
            draw(ink, *args, **named)
            return ink.sprite(glow)

        @cached
        def at(turn: int, /, *args: Args.args, **named: Args.kwargs) -> Sprite:
            return turned(upright(*args, **named), turn, steps)

        @wraps(draw)
        def sprite(heading: float, /, *args: Args.args, **named: Args.kwargs) -> Sprite:
            return at(step(heading, steps), *args, **named)

        return sprite

    return decorated


Paint = Callable[..., pygame.Surface]


@cached
def painted(paint: Paint, args: tuple[object, ...]) -> pygame.Surface:
    """The master image that `paint(*args)` returns, cached while it is being rotated."""
    return paint(*args)
