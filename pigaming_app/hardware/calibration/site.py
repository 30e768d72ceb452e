"""Calibration sites: cameras, clock and ruler measurements of a real or an emulated mat."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Protocol

from pigaming_app.hardware.calibration.ground_plane import LID
from pigaming_app.hardware.signals import CameraSource, Clock, ExposureKept
from pigaming_app.hardware.vision.camera import SETTLE, Camera
from pigaming_app.hardware.vision.discovery import CameraInfo, cameras

SETTLED = 2.6  # s after which a real camera has locked its exposure


@dataclass(frozen=True)
class Measurements:
    """Ruler measurements in mm: the arena's width on the mat, and the heights of camera and lids above it.

    A camera height of 0 means that it is to be measured by a robot on projected outlines.
    """

    width: float = 2112.0
    height: float = 2500.0
    lid: float = LID


class CalibrationSite(Protocol):
    """A mat with a projector and cameras. `stepped`: time is simulated and passes only in `advance`."""

    name: str
    stepped: bool
    clock: Clock
    settle: float  # s from opening a camera to its first usable picture

    @property
    def measures(self) -> Measurements:
        """Initial measurements."""

    def cameras(self) -> list[CameraInfo]: ...

    def open(
        self, number: int, locks: bool = True, fresh: bool = False, kept: ExposureKept | None = None
    ) -> CameraSource:
        """Open a camera. Raises OpenCVMissing.

        `locks`: lock the exposure once settled; `fresh`: choose it anew; `kept`: set that of a calibration.
        """

    def advance(self, seconds: float) -> None: ...

    def clear(self, off: bool) -> None:
        """Request an empty mat (`off`), or allow the robots back."""

    def stand(self, x: float, y: float) -> None:
        """Request a robot at this point, arena px."""


class RealCalibrationSite:
    """The physical mat. `open_capture` makes a `cv2.VideoCapture`."""

    name = "real"
    stepped = False
    settle = SETTLED
    measures = Measurements()

    def __init__(self, open_capture: Callable[[int], object] | None = None) -> None:
        self.clock: Clock = time.monotonic
        self._open_capture = open_capture

    def cameras(self) -> list[CameraInfo]:
        return cameras()

    def open(
        self, number: int, locks: bool = True, fresh: bool = False, kept: ExposureKept | None = None
    ) -> CameraSource:
        return Camera(number, None, self.clock, self._open_capture, SETTLE if locks else inf, fresh, kept)

    def advance(self, seconds: float) -> None:
        """No effect: real time passes by itself."""

    def clear(self, off: bool) -> None:
        """No effect: the first page of the wizard asks the operator."""

    def stand(self, x: float, y: float) -> None:
        """No effect: the operator follows the projected outline."""
