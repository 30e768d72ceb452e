"""Opaque background of a match: the static picture and the HUD, baked into one surface.

HUD panels are redrawn only where and when they change; an unchanged frame is one blit.
"""

from collections.abc import Callable, Sequence
from functools import cached_property

import pygame

from pigaming_app.ui.draw import ADD

LEFT, TOP = 160, 140  # px, top left of the arena on the canvas
HUD_HEIGHT = 136
Bit = tuple[pygame.Surface, tuple[int, int], tuple[int, int, int, int] | None]


class Background:
    """Background of one match. `paint` renders the static canvas on first use."""

    def __init__(self, paint: Callable[[], pygame.Surface]) -> None:
        self._paint = paint

    @cached_property
    def bare(self) -> pygame.Surface:
        """The static canvas."""
        return self._paint()

    @cached_property
    def surface(self) -> pygame.Surface:
        """The canvas with everything baked in."""
        return self.bare.copy()

    def bake(self, box: pygame.Rect, bits: Sequence[Bit]) -> None:
        """Replace the contents of a HUD box by additive pieces: image, position, source rectangle or None."""
        self.surface.set_clip(box)
        self.surface.blit(self.bare, box, box)
        for image, at, area in bits:
            self.surface.blit(image, at, area, special_flags=ADD)
        self.surface.set_clip(None)
