"""PNG encoding."""

from io import BytesIO

import pygame


def png_of(surface: pygame.Surface) -> bytes:
    """A surface encoded as a PNG file."""
    packed = BytesIO()
    pygame.image.save(surface, packed, "picture.png")
    return packed.getvalue()
