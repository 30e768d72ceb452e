"""Synthetic calibrations."""

from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.calibration.lens import Lens


def nominal(camera: tuple[int, int] = (1920, 1080), width_mm: float = 2112.0, height: float = 2500.0) -> GroundPlane:
    """A camera above the centre, without distortion, with the whole 1920 x 1080 canvas in view."""
    scale = 1920.0 / camera[0]
    plane = (scale, 0.0, -160.0, 0.0, scale, -140.0, 0.0, 0.0, 1.0)
    return GroundPlane("", Lens(camera), plane, width_mm, (800.0, 400.0), height)
