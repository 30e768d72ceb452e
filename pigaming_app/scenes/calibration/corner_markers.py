"""The four corner markers in the side margins of the picture, by which a camera or projector that moved is noticed.

They are painted whenever robots are driven by a camera; the tracker compares where it sees them with the calibration.
"""

import pygame

from pigaming_app.hardware.calibration.drift import Drift, corner_markers
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.ui.draw.pixels import grey_surface
from pigaming_app.ui.draw.surface_cache import cached


class DriftWatch:
    """The watch of one rig: its `drift` counts from now on. What safety makes of it is said by the match."""

    def __init__(self, rig: Rig) -> None:
        tracker = rig.tracker
        if isinstance(tracker, Tracker):
            drift = tracker.drift = Drift(tracker.ground)
            rig.drift = lambda: drift.mm

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the markers, over everything else."""
        draw_corners(screen)


def draw_corners(screen: pygame.Surface) -> None:
    """Paint the corner markers."""
    screen.blits(tiles())


@cached
def tiles() -> list[tuple[pygame.Surface, tuple[int, int]]]:
    """The corner markers with their own light round them, and where each belongs."""
    return [(grey_surface(picture), (left, top)) for left, top, picture in corner_markers()]
