"""What passes between the parts of the robot loop: frames, fixes, wheels, telemetry. Nothing here knows cv2 or serial.

CameraFrame -> DetectedMarker -> GroundPlane -> Fix -> Tracker -> Sighting -> match -> twist -> Safety -> WheelCommand.
Every time is in seconds of one clock, which is handed in: `time.monotonic` in the arena, simulated time in the tests.
"""

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.messages import OperatorMessage

Clock = Callable[[], float]  # s
Image = NDArray[np.uint8]  # (height, width), grey


class CameraFrame(NamedTuple):
    """One picture of the mat."""

    image: Image
    captured: float  # s, when the light fell on the sensor, as well as that can be known
    number: int


class CameraSource(Protocol):
    """A camera. Its health is the age of its newest frame, never the word of the driver."""

    @property
    def trouble(self) -> OperatorMessage | None:
        """What is wrong with it; None: nothing."""

    def newest(self) -> CameraFrame | None:
        """The newest frame that was not given out before, or None."""

    def close(self) -> None: ...


class DetectedMarker(NamedTuple):
    """A marker as the camera sees it."""

    number: int
    corners: NDArray[np.float64]  # (4, 2) camera px, in ArUco's order


class Fix(NamedTuple):
    """Where the ground says that a robot was when the frame was taken."""

    robot: int
    x: float  # arena px
    y: float
    heading: float  # rad
    captured: float  # s


class WheelCommand(NamedTuple):
    """What one robot's motors are told, as shares of full speed in [-1, 1]."""

    left: float
    right: float


class Telemetry(NamedTuple):
    """What a robot said last."""

    robot: int
    battery: float  # V
    flags: int
    heard: float  # s, when it was heard


class SerialPort(Protocol):
    """The part of a serial port that the link uses, as pyserial has it. When the peer is gone, all raise OSError."""

    @property
    def in_waiting(self) -> int: ...

    def read(self, size: int = 1) -> bytes: ...

    def write(self, data: bytes) -> int | None: ...

    def close(self) -> None: ...
