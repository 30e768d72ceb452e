"""The opaque ground of a match: what never changes, and over it what the HUD says, baked into one surface.

Panels are drawn again only where and when they change; a steady frame is one blit.
"""

from collections.abc import Callable, Sequence
from functools import cached_property

import pygame

from pigaming_app.ui.draw import ADD

LEFT, TOP = 160, 140  # where the arena lies on the canvas
HUD_HEIGHT = 136
Bit = tuple[pygame.Surface, tuple[int, int], tuple[int, int, int, int] | None]


class Background:
    """The ground of one match. `paint` makes the whole canvas without what changes, as soon as it is needed."""

    def __init__(self, paint: Callable[[], pygame.Surface]) -> None:
        self._paint = paint

    @cached_property
    def bare(self) -> pygame.Surface:
        """The canvas without what changes."""
        return self._paint()

    @cached_property
    def surface(self) -> pygame.Surface:
        """The canvas with all that was baked into it."""
        return self.bare.copy()

    def bake(self, box: pygame.Rect, bits: Sequence[Bit]) -> None:
        """Replace what a box of the HUD says by these pieces of light: image, corner, part of it or None."""
        self.surface.set_clip(box)
        self.surface.blit(self.bare, box, box)
        for image, at, area in bits:
            self.surface.blit(image, at, area, special_flags=ADD)
        self.surface.set_clip(None)
