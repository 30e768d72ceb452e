"""What is there to calibrate: which cameras, which clock, and what has been measured with a ruler."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Protocol

from pigaming_app.hardware.calibration.ground_plane import LID
from pigaming_app.hardware.signals import CameraSource, Clock
from pigaming_app.hardware.vision.camera import SETTLE, Camera
from pigaming_app.hardware.vision.discovery import CameraInfo, cameras

SETTLED = 2.6  # s after which a real camera has locked its exposure


@dataclass(frozen=True)
class Measurements:
    """What the operator measures, all in mm: the arena's width on the mat, the camera's and the lids' height above it.

    Without a camera's height (0), a robot that stands on outlines tells it.
    """

    width: float = 2112.0
    height: float = 2500.0
    lid: float = LID


class CalibrationSite(Protocol):
    """A mat with a projector and cameras. `stepped`: its time is made up, and passes only in `advance`."""

    name: str
    stepped: bool
    clock: Clock
    settle: float  # s until an opened camera's pictures can be used

    @property
    def measures(self) -> Measurements:
        """Something to begin with."""

    def cameras(self) -> list[CameraInfo]: ...

    def open(self, number: int, locks: bool = True, fresh: bool = False) -> CameraSource:
        """Use a camera that locks its exposure once it has settled; `fresh`: found anew. Raises OpenCVMissing."""

    def advance(self, seconds: float) -> None: ...

    def clear(self, off: bool) -> None:
        """A person is asked to take everything off the mat, or may put it back."""

    def stand(self, x: float, y: float) -> None:
        """A person is asked to put a robot there, arena px."""


class RealCalibrationSite:
    """The world. `open_capture` makes a `cv2.VideoCapture`."""

    name = "real"
    stepped = False
    settle = SETTLED
    measures = Measurements()

    def __init__(self, open_capture: Callable[[int], object] | None = None) -> None:
        self.clock: Clock = time.monotonic
        self._open_capture = open_capture

    def cameras(self) -> list[CameraInfo]:
        """The cameras that are plugged in."""
        return cameras()

    def open(self, number: int, locks: bool = True, fresh: bool = False) -> CameraSource:
        """Use a camera. Raises OpenCVMissing."""
        return Camera(number, None, self.clock, self._open_capture, SETTLE if locks else inf, fresh)

    def advance(self, seconds: float) -> None:
        """Time passes by itself."""

    def clear(self, off: bool) -> None:
        """Somebody has read that on the first page."""

    def stand(self, x: float, y: float) -> None:
        """Somebody sees the outline and does it."""
