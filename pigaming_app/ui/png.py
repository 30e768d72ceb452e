"""PNG encoding."""

from io import BytesIO

import pygame


def png_of(surface: pygame.Surface) -> bytes:
    """A surface encoded as a PNG file."""
    packed = BytesIO()
    pygame.image.save(surface, packed, "picture.png")
    return packed.getvalue()


def png_of_rgb(size: tuple[int, int], rgb: bytes) -> bytes:
    """A picture of `size` px, 3 bytes a pixel, row by row, encoded as a PNG file."""
    return png_of(pygame.image.frombytes(rgb, size, "RGB"))
