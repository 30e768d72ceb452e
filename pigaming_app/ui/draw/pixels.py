"""Conversion between surfaces and NumPy arrays for OpenCV. Imports numpy: import it late."""

import numpy as np
import pygame
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]


def pixels_of(surface: pygame.Surface) -> Pixels:
    """A copy of a 32-bit surface's pixels, (height, width, 4), BGRA.

    No view: whoever keeps one, be it a thread that holds the frame of a running call, keeps the surface locked.
    """
    (w, h), pitch = surface.get_size(), surface.get_pitch()
    rows = np.frombuffer(surface.get_buffer().raw, np.uint8).reshape(h, pitch)
    return rows[:, : 4 * w].reshape(h, w, 4)


def bgra_surface(image: Pixels) -> pygame.Surface:
    """An opaque surface of an image, (height, width, 4), BGRA, whose memory it shares."""
    h, w = image.shape[:2]
    surface = pygame.image.frombuffer(np.ascontiguousarray(image).data, (w, h), "BGRA")
    surface.set_alpha(None)
    return surface


def grey_surface(image: Pixels) -> pygame.Surface:
    """A grey image, (height, width), as a surface."""
    h, w = image.shape
    return pygame.image.frombytes(np.repeat(np.ascontiguousarray(image), 3).tobytes(), (w, h), "RGB")
