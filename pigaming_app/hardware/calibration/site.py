"""Calibration sites: cameras, clock and ruler measurements of a real or an emulated mat."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from math import inf

from pigaming_app.hardware.calibration.ground_plane import LID
from pigaming_app.hardware.signals import CameraSource, Clock, ExposureKept
from pigaming_app.hardware.vision.camera import SETTLE, Camera
from pigaming_app.hardware.vision.discovery import CameraId, CameraInfo, cameras

SETTLED = 2.6  # s after which a real camera has locked its exposure


@dataclass(frozen=True)
class Measurements:
    """Ruler measurements in mm: the arena's width on the mat, and the heights of camera and lids above it.

    A camera height of 0 means that it is to be measured by a robot on projected outlines.
    """

    width: float = 2112.0
    height: float = 2500.0
    lid: float = LID


class CalibrationSite:
    """A mat with a projector and cameras. `stepped`: time is simulated and passes only in `advance`."""

    name: str
    stepped = False
    clock: Clock = staticmethod(time.monotonic)
    settle: float  # s from opening a camera to its first usable picture
    measures = Measurements()  # initial ones

    def cameras(self) -> list[CameraInfo]:
        raise NotImplementedError

    def open(
        self, number: CameraId, locks: bool = True, fresh: bool = False, kept: ExposureKept | None = None
    ) -> CameraSource:
        """Open a camera. Raises OpenCVMissing.

        `locks`: lock the exposure once settled; `fresh`: choose it anew; `kept`: set that of a calibration.
        """
        raise NotImplementedError

    def advance(self, seconds: float) -> None:
        """Advance simulated time; real time passes by itself."""

    def clear(self, off: bool) -> None:
        """Request an empty mat (`off`), or allow the robots back; the wizard asks the operator of a real one."""

    def stand(self, x: float, y: float) -> None:
        """Request a robot at this point, arena px; the operator of a real mat follows the projected outline."""


class RealCalibrationSite(CalibrationSite):
    """The physical mat. `open_capture` makes a `cv2.VideoCapture`."""

    name = "real"
    settle = SETTLED

    def __init__(self, open_capture: Callable[[int], object] | None = None) -> None:
        self._open_capture = open_capture

    def cameras(self) -> list[CameraInfo]:
        return cameras()

    def open(
        self, number: CameraId, locks: bool = True, fresh: bool = False, kept: ExposureKept | None = None
    ) -> CameraSource:
        return Camera(number, self.clock, self._open_capture, SETTLE if locks else inf, fresh, kept)
