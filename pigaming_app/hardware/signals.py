"""Data types of the robot loop: frames, fixes, wheel commands, telemetry. No dependency on cv2 or pyserial.

CameraFrame -> DetectedMarker -> GroundPlane -> Fix -> Tracker -> Sighting -> match -> twist -> Safety -> WheelCommand.
All times are s of one injected clock: `time.monotonic` in the arena, simulated time in the tests.
"""

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from pigaming_app.storage.messages import OperatorMessage

try:
    from termios import error as termios_error
except ImportError:  # Windows
    SERIAL_FAILURES: tuple[type[Exception], ...] = (OSError,)
else:
    SERIAL_FAILURES = (OSError, termios_error)  # pyserial's SerialException is an OSError; termios.error is not

Clock = Callable[[], float]  # s
Image = NDArray[np.uint8]  # (height, width), grey


class CameraFrame(NamedTuple):
    """One camera picture of the mat."""

    image: Image
    captured: float  # s, best estimate of the time of exposure
    number: int


class ExposureState(NamedTuple):
    """Exposure of a camera.

    `seconds`: figure of the driver, None without; `interval`: s between two pictures, 0: unknown; `gain`: in units of
    the driver, 0 without; `dark`: too dark at the highest gain; `settled`: nothing changes any more.
    """

    seconds: float | None = None
    interval: float = 0.0
    gain: float = 0.0
    dark: bool = False
    settled: bool = False

    @property
    def bound(self) -> float:
        """The exposure, or its upper bound, s; 0: unknown."""
        return self.interval if self.seconds is None else self.seconds


class ExposureKept(NamedTuple):
    """Exposure (s) and gain (units of the driver) of a calibration."""

    seconds: float
    gain: float


class CameraSource(Protocol):
    """A camera. Its health is judged by the age of its newest frame, not by the driver's status."""

    @property
    def fault(self) -> OperatorMessage | None:
        """The present fault, or None."""

    @property
    def exposure(self) -> ExposureState:
        """Exposure and gain at present."""

    def newest(self) -> CameraFrame | None:
        """The newest frame not returned before, or None."""

    def close(self) -> None: ...


class DetectedMarker(NamedTuple):
    """A marker in a camera picture."""

    number: int
    corners: NDArray[np.float64]  # (4, 2) camera px, in ArUco's order


class Fix(NamedTuple):
    """Pose of a robot at the time of exposure, by the ground plane."""

    robot: int
    x: float  # arena px
    y: float
    heading: float  # rad
    captured: float  # s


class WheelCommand(NamedTuple):
    """Command for the motors of one robot, as shares of full speed in [-1, 1]."""

    left: float
    right: float


class Telemetry(NamedTuple):
    """The latest report of a robot."""

    robot: int
    battery: float  # V
    flags: int
    received: float  # s, when it was received


class SerialPort(Protocol):
    """The subset of pyserial's port that the link uses. All raise OSError once the device is gone."""

    @property
    def in_waiting(self) -> int: ...

    def read(self, size: int = 1) -> bytes: ...

    def write(self, data: bytes) -> int | None: ...

    def close(self) -> None: ...
