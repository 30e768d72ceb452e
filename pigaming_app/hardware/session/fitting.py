"""A camera whose pictures must be as large as those it was calibrated with: others would put every robot elsewhere."""

from pigaming_app.hardware.calibration.ground_plane import Ground, misfit
from pigaming_app.hardware.calibration.site import Sees
from pigaming_app.hardware.messages import Said
from pigaming_app.hardware.signals import Frame


class Fitting:
    """An Eye that shows the pictures of another one, if they fit the ground; `trouble` says what is wrong."""

    def __init__(self, eye: Sees, ground: Ground) -> None:
        self.eye, self.ground = eye, ground
        self._misfit: Said | None = None

    @property
    def trouble(self) -> str | None:
        """What is wrong with the camera or its pictures."""
        return self.eye.trouble or self._misfit

    def newest(self) -> Frame | None:
        """The newest frame that was not given out before, or None."""
        frame = self.eye.newest()
        if frame is None:
            return None
        size = (frame.image.shape[1], frame.image.shape[0])
        self._misfit = None if size == self.ground.lens.size else misfit(self.ground, size)
        return frame if self._misfit is None else None

    def close(self) -> None:
        """Let go of the camera."""
        self.eye.close()
