"""Layers: parts of a page, rendered once and then blitted additively every frame.

A whole page takes 250 ms to render, so an animated scene is composed of cached layers.
"""

from dataclasses import dataclass

import pygame

from pigaming_app.ui.draw import GlowCanvas, LayeredCanvas
from pigaming_app.ui.draw.frame_budget import Steps, run_to_end
from pigaming_app.ui.draw.surface_cache import cached

ADD = pygame.BLEND_RGB_ADD
MARGIN = 48  # px of glow round a layer
LEFT, RIGHT, TOP, BOTTOM = 96, 1824, 54, 1026  # the safe area


@dataclass(frozen=True)
class LitImage:
    """A rendered layer and the canvas position of its upper left corner."""

    image: pygame.Surface
    at: tuple[int, int]

    def draw(
        self, screen: pygame.Surface, dx: float = 0.0, dy: float = 0.0, share: float = 1.0, begin: float = 0.0
    ) -> None:
        """Add it to the screen, moved by (dx, dy) px; `begin` and `share` (0..1 of its width) clip it."""
        w, h = self.image.get_size()
        left, right = round(w * max(0.0, begin)), round(w * min(1.0, share))
        if right > left:
            place = self.at[0] + dx + left, self.at[1] + dy
            screen.blit(self.image, place, (left, 0, right - left, h), special_flags=ADD)


class Layer:
    """A canvas for the area x, y, w, h (px), drawn on in screen coordinates."""

    def __init__(self, x: float, y: float, w: float, h: float) -> None:
        self.at = round(x) - MARGIN, round(y) - MARGIN
        self.canvas = LayeredCanvas(round(w) + 2 * MARGIN, round(h) + 2 * MARGIN)
        for canvas in (self.canvas.glow, self.canvas.soft, self.canvas.crisp):
            canvas.set_transform(-self.at[0], -self.at[1])

    @property
    def glow(self) -> GlowCanvas:
        """The glowing sub-canvas."""
        return self.canvas.glow

    def render_steps(self) -> Steps[LitImage]:
        """Render the layer: about 0.1 µs per pixel, too slow for a steady frame."""
        image = yield from self.canvas.render_steps()
        return LitImage(image, self.at)

    def render(self) -> LitImage:
        """Like `render_steps`, uninterrupted."""
        return run_to_end(self.render_steps())


def span(first: int, columns: int) -> tuple[int, int]:
    """x and width, px, of `columns` of the twelve page columns, starting at column `first` (0..11)."""
    return LEFT + first * 146, columns * 146 - 24


@cached
def backdrop() -> pygame.Surface:
    """The dotted arena floor, full screen."""
    tile = GlowCanvas(48, 48).disc(24, 12, 1.5, (22, 31, 46)).plain()
    out = pygame.Surface((1920, 1080))
    out.fblits([(tile, (x, y)) for x in range(0, 1920, 48) for y in range(0, 1080, 48)])
    return out
