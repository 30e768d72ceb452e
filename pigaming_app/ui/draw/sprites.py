"""How a sprite is made: painted once at twice its size, turned to every heading, trimmed to what is lit, and kept.

A kept sprite is a few microseconds in a frame, a missing one about a millisecond. Everything that can be asked for is
finite, so what is kept is bounded.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import pygame

from pigaming_app.ui.draw import MULT, GlowCanvas
from pigaming_app.ui.draw.surface_cache import cached

HEADINGS = 96  # of what is turned finely: 3.75 degrees each, two pixels at a barrel's end


class Sprite(NamedTuple):
    """A picture, and where its corner lies from the place it belongs to, px."""

    image: pygame.Surface
    dx: int
    dy: int


Batch = list[tuple[pygame.Surface, tuple[int, int]]]


def put(batch: Batch, sprite: Sprite, x: float, y: float) -> None:
    """Add a sprite at (x, y) of the canvas to a batch for `fblits`."""
    batch.append((sprite.image, (int(x + sprite.dx + 0.5), int(y + sprite.dy + 0.5))))


def step(angle: float, steps: int) -> int:
    """The nearest of `steps` headings to an angle, rad."""
    return round(angle / math.tau * steps) % steps


def master(half: int, arm: float = 0.0) -> GlowCanvas:
    """A sheet for a sprite that will be turned: twice its size, `half` px to each side of a point `arm` px ahead."""
    return GlowCanvas(4 * half, 4 * half, 2).to(2 * (half - arm), 2 * half, 0, 2)


def turned(image: pygame.Surface, turn: int, steps: int, arm: float = 0.0, zoom: float = 0.5) -> Sprite:
    """A master, turned by `turn` of `steps` parts of a circle round the point that it belongs to."""
    angle = turn * math.tau / steps
    out = pygame.transform.rotozoom(image, -math.degrees(angle), zoom)
    return trim(out, out.get_width() / 2 - arm * math.cos(angle), out.get_height() / 2 - arm * math.sin(angle))


def trim(image: pygame.Surface, x: float, y: float) -> Sprite:
    """Cut a picture to what is lit or hides; (x, y) is the place in it that it belongs to."""
    lit = pygame.mask.from_threshold(image, (0, 0, 0), (3, 3, 3, 255))
    lit.invert()
    if image.get_flags() & pygame.SRCALPHA:
        lit.draw(pygame.mask.from_surface(image, 8), (0, 0))
    rects = lit.get_bounding_rects()
    box = rects[0].unionall(rects[1:]) if rects else pygame.Rect(0, 0, 1, 1)
    return Sprite(image.subsurface(box).copy(), round(box.x - x), round(box.y - y))


def faded(sprite: Sprite, share: float) -> Sprite:
    """A sprite at `share` of its light, 0..1; what it hides fades too."""
    image, part = sprite.image.copy(), round(255 * share)
    flags = pygame.BLEND_RGBA_MULT if image.get_flags() & pygame.SRCALPHA else MULT
    image.fill((part, part, part, part), special_flags=flags)
    return Sprite(image, sprite.dx, sprite.dy)


Paint = Callable[..., pygame.Surface]


@cached
def painted(paint: Paint, args: tuple[object, ...]) -> pygame.Surface:
    """The master that `paint(*args)` makes; kept while it is being turned."""
    return paint(*args)
