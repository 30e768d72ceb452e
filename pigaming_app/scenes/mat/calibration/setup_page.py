"""The calibration setup: display, camera and measurements, with a live camera preview."""

import logging
from collections.abc import Callable
from dataclasses import replace

import pygame

from pigaming_app.games.arenas import widest_of_all
from pigaming_app.hardware.calibration.camera_task import SMALL, CameraPreview
from pigaming_app.hardware.calibration.floor_surface import narrow_arena
from pigaming_app.hardware.calibration.ground_plane import CalibrationError
from pigaming_app.hardware.calibration.quality import used_anyway
from pigaming_app.hardware.calibration.site import CalibrationSite, Measurements, RealCalibrationSite
from pigaming_app.hardware.control.virtual_walls import SPARE
from pigaming_app.hardware.robot_kinds import DEFAULT, widest_radius
from pigaming_app.hardware.session import store
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.hardware.vision.camera import shown
from pigaming_app.hardware.vision.discovery import CameraId
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.mat.calibration.boards_page import BoardsPage
from pigaming_app.scenes.mat.calibration.picture_quality import exposure_text
from pigaming_app.scenes.mat.calibration.printed_page import PrintedPage
from pigaming_app.scenes.mat.phone_camera.page import PhoneCameraPage
from pigaming_app.scenes.mat.session import session_if_any
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import PHONE
from pigaming_app.ui.draw import BODY, FOCUS, LABEL, MIST
from pigaming_app.ui.draw.layers import LitImage, fit_size, paragraph, text
from pigaming_app.ui.draw.pixels import grey_surface
from pigaming_app.ui.i18n import english
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.labels import heading
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS = ("floor", "display", "camera", "address", "phone", "width", "lid", "by", "height", "begin")
LIMITS = {"width": (500, 10000), "lid": (0, 300), "height": (500, 10000)}  # mm
REPEAT_STEPS = ((40, 100), (14, 10), (0, 1))  # step in mm after this many auto-repeats
DEFAULT_HEIGHT = 2500  # mm, initial height
MAX_STREAM = 200
URL_LETTERS = "abcdefghijklmnopqrstuvwxyz0123456789.:/-_?=&@%"
SCAN_PERIOD = 2.0  # s between two scans for cameras
PICTURE = pygame.Rect(dials.PANEL.x + 20, dials.PANEL.y + 20, *SMALL)

log = logging.getLogger("pigaming")


def site_of(context: Context) -> CalibrationSite:
    """The calibration site: of the emulated arena, if the arcade has one, else the real one."""
    try:
        session = session_if_any(context)
        return session.site if session is not None else RealCalibrationSite()
    except RobotsUnavailable:
        return RealCalibrationSite()  # without OpenCV there is none; the page shows the reason


class CalibrationPage(SettingsPage):
    """The page. `camera`: the initial one, else that of the settings; `printed`: the floor is, else as last time."""

    table = "calibrate"
    idle, stay = 600.0, 5.0

    def __init__(
        self,
        context: Context,
        site: CalibrationSite | None = None,
        camera: CameraId | None = None,
        printed: bool = False,
    ) -> None:
        self.context, self.site = context, site or site_of(context)
        self.number: CameraId = context.settings.camera if camera is None else camera
        if camera == PHONE and self.site.name == "real":
            context.settings.camera = PHONE  # it is served from now on
        self.printed = printed or self._was_printed()
        self.measures = self._initial_measures()
        self.preview: CameraPreview | None = None
        self.cameras = self.site.cameras()
        self.state, self.anyway = "", False  # of the calibration; saved despite its picture
        self._state_of: tuple[int, int] = (0, 0)
        self.since_scan = 0.0  # s since the last scan for cameras
        self.repeats = 0
        self._small: object = None
        self._shown: pygame.Surface | None = None
        super().__init__(context, self._rows())

    def on_enter(self) -> None:
        """Open the camera, also when a calibration returns here."""
        self.cameras = self.site.cameras()
        known = [self.number if isinstance(self.number, str) else -1, *(camera.number for camera in self.cameras)]
        if self.site.name == "real" and self.cameras and self.number not in known:
            self.number = self.cameras[0].number
        self._open_camera()

    def on_leave(self) -> None:
        """Release the camera."""
        if self.preview is not None:
            self.preview.close()

    def press(self, event: InputEvent) -> StackOperation:
        """Lengths change faster, the longer the direction is held."""
        self.repeats = self.repeats + 1 if event.repeat else 0
        return super().press(event)

    def advance(self, seconds: float) -> StackOperation:
        self.since_scan += seconds
        if self.since_scan > SCAN_PERIOD:
            self.since_scan, self.cameras = 0.0, self.site.cameras()
        self.site.advance(seconds)
        if self.preview is not None:
            self.preview.pump()
            if self.preview.size != self._state_of:
                self._load_state(self.preview.size)
        return None

    @property
    def heading(self) -> LitImage:
        return heading(self.context.words("calibrate.title"), self.state, right_color=FOCUS if self.anyway else MIST)

    def describe(self, screen: pygame.Surface, name: str) -> None:
        """Draw name and description of a row below the camera picture."""
        label = text(self.label(name), LABEL, FOCUS, "head", "l", dials.PANEL.w - 40)
        label.draw(screen, PICTURE.x, dials.PANEL.bottom - 216)
        for i, line in enumerate(paragraph(self.line(name), dials.PANEL.w - 40, 3, MIST)):
            line.draw(screen, PICTURE.x, dials.PANEL.bottom - 156 + 50 * i)

    # ---- drawing

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        """Draw the camera picture, or the reason for its absence."""
        preview, words = self.preview, self.context.words
        if preview is None:
            return
        room, below = dials.PANEL.w - 40, PICTURE.bottom + 30
        if preview.fault is not None or preview.small is None:
            sentence = preview.fault or OperatorMessage("yet")
            lines = paragraph(words.sentence(sentence), room - 40, 5, align="c")
            for i, line in enumerate(lines):
                line.draw(screen, PICTURE.centerx, PICTURE.centery + 52 * i - 26 * (len(lines) - 1))
            pygame.draw.rect(screen, (58, 76, 112), PICTURE, 2)
            return
        if preview.small is not self._small:
            self._small, self._shown = preview.small, grey_surface(preview.small)
        if self._shown is not None:
            screen.blit(self._shown, self._shown.get_rect(center=PICTURE.center))
        w, h = preview.size
        caption = words("calibrate.rate", width=w, height=h, rate=round(preview.rate)) if preview.rate else f"{w} × {h}"
        size = fit_size(caption, BODY, room, "body")
        text(caption, size, MIST, "body", "l").draw(screen, PICTURE.x, below)
        if preview.exposure.bound:
            exposed = words("calibrate.exposed", time=exposure_text(words, preview.exposure))
            text(exposed, size, MIST, "body", "l").draw(screen, PICTURE.x, below + 38)

    def _load_state(self, size: tuple[int, int]) -> None:
        """Show the state of the calibration for this camera and display."""
        self._state_of, words = size, self.context.words
        try:
            file = store.calibration_file(self.site.name)
            ground = store.load(file, self.context.canvas.projection, size)
            self.state = words("calibrate.state", mean=f"{ground.mean_mm:.1f}", most=f"{ground.max_mm:.1f}")
            self.anyway = ground.quality.anyway
            if self.anyway:
                self.state = words.sentence(used_anyway(ground.quality))
        except CalibrationError as trouble:
            log.warning("%s", english().long_sentence(trouble.message))
            self.anyway = False
            self.state = words.sentence(trouble.message)

    # ---- rows

    def line(self, name: str) -> str:
        printed = f"{self.table}.{name}_printed_line"
        return self.context.words(printed) if self.printed and printed in self.context.words else super().line(name)

    def _was_printed(self) -> bool:
        try:
            return store.load(store.calibration_file(self.site.name)).printed
        except CalibrationError:
            return False

    def _rows(self) -> tuple[str, ...]:
        without = {"display", "by"} if self.printed else {"height"} if not self.measures.height else set()
        without |= set() if self.site.name == "real" else {"address", "phone"}
        return tuple(name for name in ROWS if name not in without)

    def value(self, name: str) -> SettingValue:
        words, measures, canvas = self.context.words, self.measures, self.context.canvas
        match name:
            case "floor":
                names = words("calibrate.projected"), words("calibrate.printed")
                return SettingValue("toggle", names, self.printed)
            case "display":
                return SettingValue("arrows", tuple(canvas.displays()), canvas.display)
            case "camera":
                return SettingValue("arrows", (self._camera(),))
            case "by":
                return SettingValue("toggle", (words("calibrate.ruler"), words("calibrate.robot")), not measures.height)
            case "address":
                return self.action("calibrate.type")
            case "phone":
                return self.action("calibrate.show_code")
            case "begin":
                return self.action("calibrate.start")
        return SettingValue("arrows", (words("calibrate.mm", mm=f"{getattr(self.measures, name):.0f}"),))

    def _camera(self) -> str:
        words = self.context.words
        if isinstance(self.number, str):
            return words("calibrate.phone") if self.number == PHONE else str(shown(self.number))
        if not self.cameras:
            return words("calibrate.no_cameras")
        name = next((camera.name for camera in self.cameras if camera.number == self.number), "")
        return words("calibrate.camera_name", number=self.number, name=name) if name else str(self.number)

    def step(self, name: str, by: int) -> None:
        """Step a length or the camera; cameras go round."""
        if name not in ("camera", *LIMITS):
            super().step(name, by)
            return
        if name == "camera":
            self._next_camera(by)
        else:
            self._measure(name, by)
        self.context.sounds.play("move")
        self.save()

    def fire(self, name: str, event: InputEvent) -> StackOperation:
        """FIRE: the next camera; nothing happens to a length."""
        if name == "camera":
            self.step(name, 1)
        return None if name in ("camera", *LIMITS) else super().fire(name, event)

    def apply(self, name: str, chosen: int) -> None:
        measures = self.measures
        if name == "display":
            self._show(chosen, self.context.canvas.fullscreen)
        elif name == "floor":
            self.printed = bool(chosen)
            self.measures = replace(self.measures, height=self.measures.height or DEFAULT_HEIGHT)
            self.show_rows(self._rows())
        else:
            height = 0.0 if chosen else self.site.measures.height or DEFAULT_HEIGHT
            self.measures = Measurements(measures.width, height, measures.lid)
            self.show_rows(self._rows())

    def _measure(self, name: str, by: int) -> None:
        low, high = LIMITS[name]
        step = next(step for count, step in REPEAT_STEPS if self.repeats >= count)
        new = min(high, max(low, round(getattr(self.measures, name) / step + by) * step))
        self.measures = replace(self.measures, **{name: new})

    def _show(self, display: int, fullscreen: bool) -> None:
        """Move the picture; the calibration depends on the display."""
        canvas, settings = self.context.canvas, self.context.settings
        canvas.show(display, fullscreen)
        settings.display, settings.fullscreen = canvas.display, canvas.fullscreen
        self._state_of = (0, 0)

    def _next_camera(self, by: int) -> None:
        self.cameras = self.site.cameras()
        numbers = [camera.number for camera in self.cameras] or [0]
        here = numbers.index(self.number) if self.number in numbers else 0
        self.number = numbers[(here + by) % len(numbers)]
        self._open_camera()

    # ---- actions

    def _open_camera(self) -> None:
        """Open the selected camera, after closing the previous one."""
        self._state_of = (0, 0)
        if session := session_if_any(self.context):
            session.close()
        self.on_leave()
        self.preview = CameraPreview(self.site, self.number)
        self.preview.begin()

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Start the calibration, full screen, or type the address of a camera, or show the code for a phone."""
        if name == "begin" and (reason := self._narrow()):
            self.context.sounds.play("error")
            self.show_message(self.context.words.sentence(reason))
            return None
        self.context.sounds.play("accept")
        self.on_leave()
        if name == "address":
            before = self.number if isinstance(self.number, str) and self.number != PHONE else "http://"
            return Push(TextPage(self.context, self.label(name), before, MAX_STREAM, self._choose, True, URL_LETTERS))
        if name == "phone":
            self.number = self.context.settings.camera = PHONE
            self.save()
            return Push(PhoneCameraPage(self.context))
        if self.printed:
            self.save()
            return Push(PrintedPage(self.context, self.site, self.number, self.measures))
        canvas = self.context.canvas
        if self.site.name == "real" and not canvas.fullscreen and not canvas.headless:
            self._show(canvas.display, True)
        self.save()
        return Push(BoardsPage(self.context, self.site, self.number, self.measures))

    def _narrow(self) -> OperatorMessage | None:
        """The message if the arena is too small for its robots."""
        session = session_if_any(self.context)
        usual = session.usual if session else DEFAULT
        return narrow_arena(
            self.measures.width, widest_radius(self.context.settings.kinds, usual), widest_of_all(SPARE)
        )

    def _choose(self, address: str) -> str:
        """Use the camera at an address; the reason why not, if it is none."""
        try:
            self.context.settings.choose("camera", address)
        except ValueError:
            return self.context.words("calibrate.no_address")
        self.number = address
        self.save()
        return ""

    def _initial_measures(self) -> Measurements:
        settings = self.context.settings
        if self.site.name != "real":
            return self.site.measures
        height = settings.camera_mm or (DEFAULT_HEIGHT if self.printed else 0.0)
        return Measurements(settings.arena_mm, height, settings.lid_mm)

    def save(self, write: Callable[[], object] | None = None) -> bool:
        """Save the choices, except for an emulated arena."""
        settings, measures = self.context.settings, self.measures
        if self.site.name != "real":
            return True
        settings.camera = self.number
        settings.arena_mm, settings.camera_mm, settings.lid_mm = measures.width, measures.height, measures.lid
        return super().save(write)
