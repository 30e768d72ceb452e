"""The opaque ground of a match: what never changes, and over it what the HUD says, baked into one surface.

Panels are drawn again only where and when they change; a steady frame is one blit.
"""

from collections.abc import Sequence

import pygame

from pigaming_app.scenes.ink import ADD

LEFT, TOP = 160, 140  # where the arena lies on the canvas
HUD_HEIGHT = 136
Bit = tuple[pygame.Surface, tuple[int, int], tuple[int, int, int, int] | None]


class Ground:
    """The ground of one match. `bare`: the whole canvas without what changes."""

    def __init__(self, bare: pygame.Surface) -> None:
        self.bare = bare
        self.surface = bare.copy()

    def bake(self, box: pygame.Rect, bits: Sequence[Bit]) -> None:
        """Replace what a box of the HUD says by these pieces of light: image, corner, part of it or None."""
        self.surface.set_clip(box)
        self.surface.blit(self.bare, box, box)
        for image, at, area in bits:
            self.surface.blit(image, at, area, special_flags=ADD)
        self.surface.set_clip(None)
