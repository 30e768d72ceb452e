"""The session of real robots: camera and radio of the settings, the user's calibration and identified drivetrains.

A missing or broken camera or radio may be plugged in later: both report their fault and retry.
"""

import time
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import partial
from math import inf
from typing import TYPE_CHECKING

from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable, driver_of, new_rig
from pigaming_app.sim.world import WIDTH
from pigaming_app.storage.messages import OperatorError, OperatorMessage
from pigaming_app.storage.settings import Settings

if TYPE_CHECKING:
    from pigaming_app.hardware.calibration.ground_plane import GroundPlane
    from pigaming_app.hardware.calibration.site import CalibrationSite
    from pigaming_app.hardware.control.rig import Rig
    from pigaming_app.hardware.radio.link import CommandLink
    from pigaming_app.hardware.radio.wifi import WifiNetwork
    from pigaming_app.hardware.radio.xbee_setup import Carrier
    from pigaming_app.hardware.robot_kinds import RobotKind
    from pigaming_app.hardware.signals import CameraFrame, CameraSource, ExposureState
    from pigaming_app.sim.drivetrain import Drivetrain

NO_PORT = "no serial port"


class RealSession(RobotSession):
    """The robots of these settings. `projection` is `Canvas.projection`; None accepts a calibration of any display."""

    ground: "GroundPlane | None" = None
    _link: "CommandLink | None" = None

    def __init__(self, settings: Settings, projection: Callable[[], str | None] = lambda: None) -> None:
        self.settings, self.projection = settings, projection

    @property
    def fault(self) -> OperatorMessage | None:
        return super().fault or (self._link.fault if self._link else None)

    @property
    def arena_id(self) -> int:
        from pigaming_app.hardware.session import store

        return store.arena_id(self.settings)

    @property
    def usual(self) -> "RobotKind":
        with suppress(RobotsUnavailable):
            return driver_of(self.settings).kind
        return super().usual

    @property
    def site(self) -> "CalibrationSite":
        from pigaming_app.hardware.calibration.site import RealCalibrationSite

        return RealCalibrationSite()

    def open(self) -> "Rig":
        if self._rig is None:
            from pigaming_app.hardware.session import store
            from pigaming_app.hardware.vision.camera import Camera
            from pigaming_app.sim.drivetrain import DrivetrainError

            try:
                ground = store.load(store.calibration_file("real"), self.projection())
                drivetrains = store.load_robots(store.robots_file(emulated=False), ground.mm, self._declared(ground.mm))
                camera = SizedCamera(Camera(self.settings.camera, kept=ground.quality.kept), ground)
                try:
                    link, kinds = self._new_link(), self.settings.kinds
                    rig = new_rig(
                        camera,
                        link,
                        ground,
                        time.monotonic,
                        drivetrains,
                        kinds=kinds,
                        usual=self.usual,
                        marker_mm=driver_of(self.settings).marker_mm,
                    )
                except BaseException:
                    camera.close()
                    raise
            except OperatorError as error:
                raise RobotsUnavailable(error.message) from error
            except (DrivetrainError, ImportError) as error:
                raise RobotsUnavailable(OperatorMessage("robots_file", detail=error)) from error
            rig.channels = tuple(radio - 1 for radio in self.settings.radios)
            if self.settings.tops:
                rig.tops = [(self.settings.tops[channel] or inf) / ground.mm for channel in rig.channels]
            if self.settings.camera_delay >= 0:
                rig.begin_camera_delay(self.settings.camera_delay / 1000.0)
            self.mm, self.quality, self.ground, self._rig = ground.mm, ground.quality, ground, rig.start()
            self.printed = ground.printed
        return self._rig

    def radius(self, robots: Iterable[int]) -> float:
        from pigaming_app.hardware.control.rig import in_play
        from pigaming_app.hardware.robot_kinds import widest_radius

        chosen = self.settings
        kinds = [chosen.kinds[chosen.radios[robot] - 1] for robot in robots]
        if self._rig or not kinds:
            return super().radius(robots)
        return in_play(widest_radius(kinds, self.usual) * WIDTH / chosen.arena_mm)

    def _declared(self, mm: float) -> "list[Drivetrain]":
        """Drivetrains as the driver declares them. `mm`: of the mat per arena px. Raises RobotsUnavailable."""
        from pigaming_app.hardware.control.rig import unmeasured
        from pigaming_app.hardware.robot_kinds import robot_kind

        chosen, delay = self.settings, driver_of(self.settings).delay
        kinds = [robot_kind(chosen.kinds[radio - 1], usual=self.usual) for radio in chosen.radios]
        return [unmeasured(kind, mm, delay) for kind in kinds]

    def open_link(self) -> "CommandLink | None":
        if self._link is None:
            self._link = self._new_link().start()
        return self._link

    def close(self) -> None:
        super().close()
        link, self._link, self.network = self._link, None, None
        if link is not None:
            link.close()

    def carrier(self, number: int) -> "Carrier":
        """The radio on the port of the settings, whichever it is: they are plugged in one after another."""
        from pigaming_app.hardware.radio.serial_line import serial_port
        from pigaming_app.hardware.radio.xbee_setup import Carrier

        name = self._port_name()
        return Carrier(lambda baud: serial_port(name, baud)(), time.monotonic, name)

    def _port_name(self) -> str:
        from pigaming_app.hardware.radio.serial_line import ports

        return self.settings.port or next((port.device for port in ports()), NO_PORT)

    def _new_link(self) -> "CommandLink":
        """The link of the settings, not started. A port that does not open is reported as its `fault`.

        Raises RobotsUnavailable.
        """
        from pigaming_app.hardware.drivers.driver import LinkSite
        from pigaming_app.hardware.radio.serial_line import serial_port

        driver, chosen = driver_of(self.settings), self.settings
        name = self._port_name() if driver.serial else ""
        site = LinkSite(self.arena_id, time.monotonic, name, chosen.baud, partial(serial_port, name), self._wifi)
        link = driver.connect(site)
        self.network = link.network
        return link

    def _wifi(self) -> "WifiNetwork":
        from pigaming_app.hardware.radio.wifi import WifiNetwork
        from pigaming_app.hardware.session.store import wifi_key

        return WifiNetwork(self.arena_id, wifi_key(self.settings), time.monotonic)


class SizedCamera:
    """A camera that drops frames of another size than the calibrated one, which would misplace every robot."""

    def __init__(self, camera: "CameraSource", ground: "GroundPlane") -> None:
        self.camera, self.ground = camera, ground
        self._misfit: OperatorMessage | None = None

    @property
    def fault(self) -> OperatorMessage | None:
        """Fault of the camera, or of its frame size."""
        return self.camera.fault or self._misfit

    @property
    def exposure(self) -> "ExposureState":
        """Exposure of the camera."""
        return self.camera.exposure

    def newest(self) -> "CameraFrame | None":
        """The newest frame, once; None if there is none since the last call, or if it has the wrong size."""
        from pigaming_app.hardware.calibration.ground_plane import size_mismatch

        frame = self.camera.newest()
        if frame is None:
            return None
        size = (frame.image.shape[1], frame.image.shape[0])
        self._misfit = None if size == self.ground.lens.size else size_mismatch(self.ground, size)
        return frame if self._misfit is None else None

    def close(self) -> None:
        """Release the camera."""
        self.camera.close()
