"""The robot session: lifecycle of camera, tracker and radio, real or emulated.

`open` starts them for a match, a page or a job; `close` stops the robots and ends all threads. Every rig that a session
opens also measures, from the projected corner markers, how far the camera has drifted since its calibration.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

from pigaming_app.hardware.control.safety import REMOTE
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.messages import OperatorError, OperatorMessage

if TYPE_CHECKING:
    from pigaming_app.hardware.calibration.ground_plane import GroundPlane
    from pigaming_app.hardware.calibration.quality import CameraQuality
    from pigaming_app.hardware.calibration.site import CalibrationSite
    from pigaming_app.hardware.control.rig import Rig
    from pigaming_app.hardware.radio.link import Link
    from pigaming_app.hardware.radio.wifi import WifiNetwork
    from pigaming_app.hardware.radio.xbee_setup import Carrier
    from pigaming_app.hardware.scan.expected import ExpectedLight
    from pigaming_app.hardware.signals import CameraSource, Clock
    from pigaming_app.hardware.tracking.tracker import Tracker
    from pigaming_app.sim.drivetrain import Drivetrain
    from pigaming_app.storage.settings import Settings

LIGHT_AFTER = 0.035  # s from rendering an image until its light reaches the mat


class RobotsUnavailable(OperatorError):
    """The robots cannot be used."""


class RobotSession(Protocol):
    """Robots on a mat with a camera, a radio and a projector."""

    emulated: bool
    radio: bool  # False: cameras and radios are those of a ROS network, and the settings of the mat do not apply
    network: "WifiNetwork | None"  # of Wi-Fi robots, while the session is open
    expected: "ExpectedLight | None"  # the mat as scanned last, for the watch over its things

    @property
    def fault(self) -> OperatorMessage | None:
        """Fault of camera or radio; None if there is none, or if they are not in use."""

    @property
    def site(self) -> "CalibrationSite":
        """Interface to this mat for calibration. Raises RobotsUnavailable."""

    @property
    def arena_id(self) -> int:
        """Id of this computer's arena; robots with another one are not driven. Raises RobotsUnavailable."""

    @property
    def mm(self) -> float:
        """mm of the mat per arena px, valid while the session is open."""

    @property
    def quality(self) -> "CameraQuality | None":
        """Quality of the calibrated picture, valid while the session is open; None before."""

    @property
    def ground(self) -> "GroundPlane | None":
        """The calibration, valid while the session is open; None if the camera is not the arcade's own."""

    def open(self) -> "Rig":
        """Start camera, tracker and radio, or return the running rig. Raises RobotsUnavailable."""

    def open_link(self) -> "Link | None":
        """The radio alone, for use when `open` raises; None if there is none either."""

    def carrier(self, number: int) -> "Carrier":
        """The USB carrier with the radio of the computer (0) or of a robot (1 to 4), for XBeeSetup.

        Raises RobotsUnavailable.
        """

    def tick(self) -> None:
        """Sleep until 1/50 s after the last call, or advance simulated time by 1/50 s."""

    def advance(self, seconds: float) -> float:
        """Advance simulated time by `seconds`; returns the time that passed, s. Real time passes by itself."""

    def close(self) -> None:
        """Stop the robots and end the threads of camera, tracker and radio. Idempotent; `open` may follow."""

    def end(self) -> None:
        """Close for good, including an emulated arena."""


def new_rig(
    camera: "CameraSource",
    link: "Link",
    ground: "GroundPlane",
    clock: "Clock",
    drivetrains: "Sequence[Drivetrain]",
    tracker: "type[Tracker] | None" = None,
    kinds: "Sequence[str]" = ("",) * ROBOTS,
) -> "Rig":
    """A rig whose tracker also measures camera drift. `kinds`: see Rig. Raises OpenCVMissing."""
    from pigaming_app.hardware.calibration.drift import DriftMonitor
    from pigaming_app.hardware.control.rig import Rig
    from pigaming_app.hardware.tracking.tracker import Tracker

    drift = DriftMonitor(ground)
    follower = (tracker or Tracker)(ground, clock, drivetrains, drift)
    return Rig(camera, follower, link, clock, drivetrains, lambda: drift.mm, ground.mm, kinds)


def settings_problem(settings: "Settings") -> OperatorMessage | None:
    """Operator message if these settings forbid matches (factory firmware has no deadman), else None."""
    if settings.radio != "stock":
        return None
    from pigaming_app.hardware.radio.stock_protocol import NO_DEADMAN

    return NO_DEADMAN


def fault_of(rig: "Rig") -> OperatorMessage | None:
    """Fault of a rig's camera, or else of its radio."""
    return rig.camera.fault or rig.link.fault


def camera_warning(session: RobotSession, rig: "Rig") -> OperatorMessage | None:
    """Warning about a session's camera: exposure, sharpness, the arena's width; or None."""
    from pigaming_app.hardware.calibration.ground_plane import MARKER
    from pigaming_app.hardware.calibration.quality import used_anyway
    from pigaming_app.hardware.vision.exposure import warning_of

    quality = session.quality
    warning = warning_of(rig.camera.exposure)
    if warning is None and quality is not None and quality.anyway:
        return used_anyway(quality)
    if warning is None and rig.tracker.wrong_size is not None:
        return OperatorMessage("marker_off", mm=f"{rig.tracker.wrong_size:.1f}", true=f"{MARKER:.0f}")
    return warning


def cause_of(rig: "Rig", fault: str) -> OperatorMessage | None:
    """Message of the camera or radio behind a fault of `safety`, or None."""
    if fault in ("camera", REMOTE["camera"]):
        return rig.camera.fault
    return rig.link.fault if fault in ("radio", REMOTE["radio"]) else None
