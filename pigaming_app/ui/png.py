"""Pictures as PNG files."""

from io import BytesIO

import pygame


def png_of(surface: pygame.Surface) -> bytes:
    """The content of a PNG file with the pixels of a surface."""
    packed = BytesIO()
    pygame.image.save(surface, packed, "picture.png")
    return packed.getvalue()
