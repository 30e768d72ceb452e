"""Corner markers in the side margins, by which a moved camera or projector is detected.

Shown whenever robots are driven by a camera; the robot session compares them with the calibration.
"""

import pygame

from pigaming_app.hardware.calibration.drift import corner_markers
from pigaming_app.ui.draw.pixels import grey_surface
from pigaming_app.ui.draw.surface_cache import cached


def draw_corners(screen: pygame.Surface) -> None:
    screen.blits(tiles())


@cached
def tiles() -> list[tuple[pygame.Surface, tuple[int, int]]]:
    """The corner markers with a light border, and their positions."""
    return [(grey_surface(picture), (left, top)) for left, top, picture in corner_markers()]
