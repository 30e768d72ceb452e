"""The mat as a feature: real robots, their camera and radio, calibration."""

from collections.abc import Sequence

import pygame

from pigaming_app.scenes.features.board_page import BoardPage
from pigaming_app.scenes.features.feature import Feature, OptionRow, ReplayKind, Service
from pigaming_app.scenes.flow.scene import Context, RobotMat, Scene, Stack
from pigaming_app.scenes.launch import Options
from pigaming_app.storage.settings import PHONE
from pigaming_app.ui.draw import FOCUS, ICE, LINE, GlowCanvas, cut_box
from pigaming_app.ui.window import Pin


class CameraView(Service):
    """The window of the emulated camera, if the emulated arena runs in real time."""

    def __init__(self, context: Context) -> None:
        from pigaming_app.hardware.session.emulated import EmulatedSession
        from pigaming_app.scenes.mat.camera_window import CameraWindow
        from pigaming_app.scenes.mat.session import session_of

        session = session_of(context)
        self.window = CameraWindow(session) if isinstance(session, EmulatedSession) and session.live else None

    @property
    def has_window(self) -> bool:
        return self.window is not None

    def show(self, seconds: float, left: float, scenes: Sequence[Scene]) -> None:
        if self.window:
            self.window.update(seconds)

    def close_if_requested(self, event: pygame.Event) -> bool:
        return self.window is not None and self.window.close_if_requested(event)

    def close(self) -> None:
        """Close the window while SDL is there: freed later, it would take another at its address with it."""
        if self.window:
            self.window.close()


class PhoneCameraService(Service):
    """Serves the page for the phone that is the camera, if the settings say so."""

    def __init__(self, context: Context) -> None:
        self.context, self.on = context, False

    def update(self, seconds: float, stack: Stack) -> None:
        on = self.context.settings.camera == PHONE
        if on or self.on:
            self._follow(on)

    def close(self) -> None:
        if self.on:
            self._follow(False)

    def _follow(self, on: bool) -> None:
        from pigaming_app.scenes.mat.phone_camera.host import phone_camera_host

        self.on = on
        self.context.shared(phone_camera_host).follow(on, self.context.settings.phones_network, self.context.words)


def service(context: Context, options: Options) -> Service | None:
    return CameraView(context) if options.emulator_seed is not None else PhoneCameraService(context)


def mat(context: Context, options: Options) -> RobotMat:
    from pigaming_app.scenes.mat.mat import opened

    return opened(context, options)


def corner_pin(corners: Sequence[float]) -> Pin:
    from pigaming_app.hardware.calibration.corner_pin import CornerPin

    return CornerPin(corners)


def replays() -> ReplayKind:
    from pigaming_app.scenes.mat.replays import RealReplays

    return RealReplays()


def page(context: Context) -> Scene:
    from pigaming_app.scenes.mat.robots.menu import RobotsMenu

    return RobotsMenu(context)


def board_pages(context: Context) -> Sequence[BoardPage]:
    from pigaming_app.scenes.mat.camera_page import CameraPage

    return [CameraPage()]


def sketch(ink: GlowCanvas, beat: int) -> None:
    """Draw a robot with its marker."""
    ink.ring(0, 0, 104, FOCUS, LINE).line(cut_box(-46, -46, 92, 92, 4), ICE, LINE, True)
    ink.fill([(-30, -30), (0, -30), (0, 0), (-30, 0)], ICE).fill([(0, 0), (30, 0), (30, 30), (0, 30)], ICE)
    for y in (-118, 118):
        ink.line([(-34, y), (34, y)], FOCUS, LINE)
    ink.line([(122, -22), (146, 0), (122, 22)], FOCUS, LINE)


FEATURE = Feature(
    "mat",
    rooms=("scenes.mat", "jobs.mat", "hardware", "ui.web.phone_camera", "ui.web.certificate"),
    options={"robots": OptionRow("", "ease", page, sketch)},
    service=service,
    mat=mat,
    corner_pin=corner_pin,
    replays=replays,
    board_pages=board_pages,
    preload=(
        "pigaming_app.scenes.mat.robots.menu",
        "pigaming_app.scenes.mat.calibration.drift_page",
        "pigaming_app.scenes.mat.calibration.setup_page",
        "pigaming_app.scenes.mat.calibration.corner_pin_page",
        "pigaming_app.scenes.mat.robots.fleet_page",
    ),
)
