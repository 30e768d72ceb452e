"""A robot session: everything outside the computer that robots need, real or emulated, and its parts while in use.

`open` starts camera, tracker and radio for a match, a page or a job; `close` stops the robots and ends every thread.
The session watches the projected corner markers, so that every rig it opens knows by how much the camera has moved.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

from pigaming_app.hardware.messages import OperatorError, OperatorMessage

if TYPE_CHECKING:
    from pigaming_app.hardware.calibration.ground_plane import GroundPlane
    from pigaming_app.hardware.calibration.site import CalibrationSite
    from pigaming_app.hardware.control.rig import Rig
    from pigaming_app.hardware.radio.link import Link
    from pigaming_app.hardware.signals import CameraSource, Clock
    from pigaming_app.hardware.tracking.tracker import Tracker
    from pigaming_app.sim.drivetrain import Drivetrain
    from pigaming_app.storage.settings import Settings

LIGHT_AFTER = 0.035  # s from a picture being painted until its light lands on the mat


class RobotsUnavailable(OperatorError):
    """The robots cannot be used."""


class RobotSession(Protocol):
    """Robots on a mat with a camera, a radio and a projector."""

    emulated: bool

    @property
    def trouble(self) -> OperatorMessage | None:
        """A fault of camera or radio; None: there is none, or they are not in use."""

    @property
    def site(self) -> "CalibrationSite":
        """The same mat for the calibration. Raises RobotsUnavailable."""

    @property
    def mm(self) -> float:
        """Mm of the mat to an arena px; only while it is open."""

    def open(self) -> "Rig":
        """Start camera, tracker and radio, or go on with those in use. Raises RobotsUnavailable."""

    def listen(self) -> "Link | None":
        """The radio alone, where `open` raises; None: there is none either."""

    def tick(self) -> None:
        """Wait until 1/50 s has passed since the last time, or let it pass in simulated time."""

    def advance(self, seconds: float) -> float:
        """Let simulated time pass; the s that have passed. Real time passes by itself."""

    def close(self) -> None:
        """Stop the robots and end the threads of camera, tracker and radio. May be called again."""

    def end(self) -> None:
        """Close for good."""


def new_rig(
    camera: "CameraSource",
    link: "Link",
    ground: "GroundPlane",
    clock: "Clock",
    drivetrains: "Sequence[Drivetrain]",
    tracker: "type[Tracker] | None" = None,
) -> "Rig":
    """A rig whose tracker also measures the drift of the camera. Raises OpenCVMissing."""
    from pigaming_app.hardware.calibration.drift import DriftMonitor
    from pigaming_app.hardware.control.rig import Rig
    from pigaming_app.hardware.tracking.tracker import Tracker

    drift = DriftMonitor(ground)
    follower = (tracker or Tracker)(ground, clock, drivetrains, drift)
    return Rig(camera, follower, link, clock, drivetrains, lambda: drift.mm)


def unfit(settings: "Settings") -> OperatorMessage | None:
    """Why no match may begin with robots on the radio of these settings, emulated ones included; None: it may."""
    if settings.radio != "stock":
        return None
    from pigaming_app.hardware.radio.stock_protocol import NO_DEADMAN

    return NO_DEADMAN


def trouble_of(rig: "Rig") -> OperatorMessage | None:
    """The fault of a rig's camera, or else of its radio."""
    return rig.camera.trouble or rig.link.trouble


def cause_of(rig: "Rig", fault: str) -> OperatorMessage | None:
    """The message of the part that a fault of `safety` is about, if there is one."""
    if fault == "camera":
        return rig.camera.trouble
    return rig.link.trouble if fault == "radio" else None
