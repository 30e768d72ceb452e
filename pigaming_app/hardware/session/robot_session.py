"""The robot session: lifecycle of camera, tracker and radio, real or emulated.

`open` starts them for a match, a page or a job; `close` stops the robots and ends all threads. Every rig that a session
opens also measures, from the projected corner markers, how far the camera has drifted since its calibration.
"""

import time
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from pigaming_app.hardware.control.safety import REMOTE
from pigaming_app.hardware.robot_kinds import DEFAULT
from pigaming_app.sim.world import DT, RADIUS, ROBOTS
from pigaming_app.storage.messages import OperatorError, OperatorMessage

if TYPE_CHECKING:
    from pigaming_app.hardware.calibration.ground_plane import GroundPlane
    from pigaming_app.hardware.calibration.quality import CameraQuality
    from pigaming_app.hardware.calibration.site import CalibrationSite
    from pigaming_app.hardware.control.rig import Rig
    from pigaming_app.hardware.drivers.driver import RobotDriver
    from pigaming_app.hardware.radio.link import CommandLink
    from pigaming_app.hardware.radio.wifi import WifiNetwork
    from pigaming_app.hardware.radio.xbee_setup import Carrier
    from pigaming_app.hardware.robot_kinds import RobotKind
    from pigaming_app.hardware.scan.expected import ExpectedLight
    from pigaming_app.hardware.signals import CameraSource, Clock
    from pigaming_app.hardware.tracking.tracker import Tracker
    from pigaming_app.sim.drivetrain import Drivetrain
    from pigaming_app.storage.settings import Settings

LIGHT_AFTER = 0.035  # s from rendering an image until its light reaches the mat


class RobotsUnavailable(OperatorError):
    """The robots cannot be used."""


class RobotSession:
    """Robots on a mat with a camera, a radio and a projector."""

    emulated = False
    radio = True  # False: cameras and radios are those of a ROS network, and the settings of the mat do not apply
    network: "WifiNetwork | None" = None  # of Wi-Fi robots, while the session is open
    expected: "ExpectedLight | None" = None  # the mat as scanned last, for the watch over its things
    quality: "CameraQuality | None" = None  # of the calibrated picture, valid while the session is open
    mm = 0.0  # of the mat per arena px, valid while the session is open
    printed = False  # True while it is open on a printed floor: robots are shown on a screen beside it
    _rig: "Rig | None" = None
    _next = 0.0  # s, time of the next tick

    @property
    def fault(self) -> OperatorMessage | None:
        """Fault of camera or radio; None if there is none, or if they are not in use."""
        return (self._rig.camera.fault or self._rig.link.fault) if self._rig else None

    @property
    def usual(self) -> "RobotKind":
        """The kind of a robot that neither the settings nor its announcement name."""
        return DEFAULT

    @property
    def site(self) -> "CalibrationSite":
        """Interface to this mat for calibration. Raises RobotsUnavailable."""
        raise NotImplementedError

    @property
    def arena_id(self) -> int:
        """Id of this computer's arena; robots with another one are not driven. Raises RobotsUnavailable."""
        raise NotImplementedError

    @property
    def ground(self) -> "GroundPlane | None":
        """The calibration, valid while the session is open; None if the camera is not the arcade's own."""
        return None

    @property
    def empty(self) -> bool:
        """True if nothing stands on the mat, whatever was found there before."""
        return False

    def open(self) -> "Rig":
        """Start camera, tracker and radio, or return the running rig. Raises RobotsUnavailable."""
        raise NotImplementedError

    def radius(self, robots: Iterable[int]) -> float:
        """The radius of robots in a match with these real ones, px; as far as is known before it is open."""
        return self._rig.radius_in_play(robots) if self._rig else RADIUS

    def open_link(self) -> "CommandLink | None":
        """The radio alone, for use when `open` raises; None if there is none either."""
        return None

    def carrier(self, number: int) -> "Carrier":
        """The USB carrier with the radio of the computer (0) or of a robot (1 to 4), for XBeeSetup.

        Raises RobotsUnavailable.
        """
        raise NotImplementedError

    def tick(self) -> None:
        """Sleep until 1/50 s after the last call, or advance simulated time by 1/50 s."""
        self._next = max(self._next + DT, time.monotonic() - DT)
        time.sleep(max(0.0, self._next - time.monotonic()))

    def advance(self, seconds: float) -> float:
        """Advance simulated time by `seconds`; returns the time that passed, s. Real time passes by itself."""
        return seconds

    def furnish(self) -> None:
        """Put random things on an emulated mat, away from the robots, unless there are some already."""

    def close(self) -> None:
        """Stop the robots and end the threads of camera, tracker and radio. Idempotent; `open` may follow."""
        rig, self._rig = self._rig, None
        if rig is not None:
            rig.close()

    def end(self) -> None:
        """Close for good, including an emulated arena."""
        self.close()


def new_rig(
    camera: "CameraSource",
    link: "CommandLink",
    ground: "GroundPlane",
    clock: "Clock",
    drivetrains: "Sequence[Drivetrain]",
    tracker: "type[Tracker] | None" = None,
    kinds: "Sequence[str]" = ("",) * ROBOTS,
    usual: "RobotKind | None" = None,
    marker_mm: float = 0.0,
) -> "Rig":
    """A rig whose tracker also measures camera drift. `kinds`, `usual`: see Rig; `marker_mm`: see RobotDriver.

    Raises OpenCVMissing.
    """
    from pigaming_app.hardware.calibration.drift import DriftMonitor
    from pigaming_app.hardware.control.rig import Rig
    from pigaming_app.hardware.tracking.tracker import Tracker

    drift = DriftMonitor(ground)
    follower = (tracker or Tracker)(ground, clock, drivetrains, drift)
    follower.ahead = marker_mm / ground.mm
    return Rig(camera, follower, link, clock, drivetrains, lambda: drift.mm, ground.mm, kinds, usual or DEFAULT)


def driver_of(settings: "Settings") -> "RobotDriver":
    """The driver of the settings. Raises RobotsUnavailable if its plug-in is gone."""
    from pigaming_app.hardware.drivers.registry import DRIVERS

    if settings.radio not in DRIVERS:
        raise RobotsUnavailable(OperatorMessage("driver_gone", name=settings.radio))
    return DRIVERS[settings.radio]


def settings_problem(settings: "Settings") -> OperatorMessage | None:
    """Operator message if these settings forbid matches (robots that may not stop by themselves), else None."""
    from pigaming_app.hardware.drivers.fitness import match_problem

    try:
        return match_problem(driver_of(settings))
    except RobotsUnavailable as error:
        return error.message


def camera_warning(session: RobotSession, rig: "Rig") -> OperatorMessage | None:
    """Warning about a session's camera: exposure, sharpness, the arena's width; or None."""
    from pigaming_app.hardware.calibration.ground_plane import MARKER, MAX_KEYSTONE
    from pigaming_app.hardware.calibration.quality import used_anyway
    from pigaming_app.hardware.vision.exposure import warning_of

    quality = session.quality
    warning = warning_of(rig.camera.exposure)
    if warning is None and quality is not None and quality.anyway:
        return used_anyway(quality)
    if warning is None and rig.tracker.wrong_size is not None:
        return OperatorMessage("marker_off", mm=f"{rig.tracker.wrong_size:.1f}", true=f"{MARKER:.0f}")
    if warning is None and (share := rig.tracker.keystone) > MAX_KEYSTONE:
        return OperatorMessage("keystone", share=round(100 * share))
    return warning


def cause_of(rig: "Rig", fault: str) -> OperatorMessage | None:
    """Message of the camera or radio behind a fault of `safety`, or None."""
    if fault in ("camera", REMOTE["camera"]):
        return rig.camera.fault
    return rig.link.fault if fault in ("radio", REMOTE["radio"]) else None
