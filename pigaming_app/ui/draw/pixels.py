"""Conversion between surfaces and NumPy arrays for OpenCV. Imports numpy: import it late."""

import numpy as np
import pygame
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]


def pixels_of(surface: pygame.Surface) -> Pixels:
    """A writable view of a 32-bit surface, (height, width, 4), BGRA. The surface is locked while the view is in use."""
    (w, h), pitch = surface.get_size(), surface.get_pitch()
    rows = np.frombuffer(surface.get_buffer(), np.uint8).reshape(h, pitch)  # type: ignore[call-overload]
    return np.asarray(rows[:, : 4 * w].reshape(h, w, 4))


def grey_surface(image: Pixels) -> pygame.Surface:
    """A grey image, (height, width), as a surface."""
    h, w = image.shape
    return pygame.image.frombytes(np.repeat(np.ascontiguousarray(image), 3).tobytes(), (w, h), "RGB")
