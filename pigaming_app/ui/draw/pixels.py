"""Between surfaces and arrays, for what OpenCV draws or sees. It needs numpy: import it late."""

import numpy as np
import pygame
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]


def pixels_of(surface: pygame.Surface) -> Pixels:
    """The pixels of a 32-bit surface, (height, width, 4), blue first, not a copy. Locks it while they are used."""
    (w, h), pitch = surface.get_size(), surface.get_pitch()
    rows = np.frombuffer(surface.get_buffer(), np.uint8).reshape(h, pitch)  # type: ignore[call-overload]
    return np.asarray(rows[:, : 4 * w].reshape(h, w, 4))


def grey_surface(image: Pixels) -> pygame.Surface:
    """A grey picture, (height, width), as a surface."""
    h, w = image.shape
    return pygame.image.frombytes(np.repeat(np.ascontiguousarray(image), 3).tobytes(), (w, h), "RGB")
