"""Drift check: compares the corner markers seen by the camera with the calibration."""

from functools import partial

import pygame

from pigaming_app.hardware.calibration.camera_task import SPOT, DriftCheck
from pigaming_app.hardware.calibration.drift import PAUSE, WARN
from pigaming_app.hardware.calibration.ground_plane import MAX_SIZE_ERROR
from pigaming_app.hardware.calibration.quality import used_anyway
from pigaming_app.hardware.calibration.site import CalibrationSite
from pigaming_app.hardware.session import store
from pigaming_app.hardware.vision.exposure import warning_of
from pigaming_app.hardware.vision.markers import OpenCVMissing
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.mat.calibration.corner_markers import draw_corners
from pigaming_app.scenes.mat.calibration.height_page import DISC, GREY
from pigaming_app.scenes.mat.calibration.picture_quality import exposure_text
from pigaming_app.scenes.mat.calibration.setup_page import site_of
from pigaming_app.scenes.mat.session import session_if_any
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.ui.draw import ALARM, BODY, FOCUS, HERO, ICE, LABEL, LINE, MIST, STEEL, TITLE, Color, cut_box
from pigaming_app.ui.draw.layers import Layer, LitImage, paragraph, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button

BAR = pygame.Rect(560, 560, 800, 40)
ROOM = 1040  # px, width of the text between the robot spot and its mirror image
BAR_MM = 20.0  # mm at the right end of the bar


class DriftPage(Page):
    """The page, for the camera of the settings."""

    idle, closing = 300.0, (Button.FIRE, Button.START)
    hints = ((Button.BACK, "calibrate.hint_back"),)

    def __init__(self, context: Context, site: CalibrationSite | None = None) -> None:
        super().__init__(context)
        self.site = site or site_of(context)
        number = context.settings.camera if self.site.name == "real" else self.site.cameras()[0].number
        self.work = DriftCheck(
            self.site, number, partial(store.load, store.calibration_file(self.site.name), context.canvas.projection)
        )

    def on_enter(self) -> None:
        """Start the check."""
        if session := session_if_any(self.context):
            session.close()
        self.work.begin()

    def on_leave(self) -> None:
        """Release the camera."""
        self.work.close()

    def advance(self, seconds: float) -> StackOperation:
        self.site.advance(seconds)
        self.work.pump()
        return None

    def show(self, screen: pygame.Surface) -> None:
        """Draw it on black: the camera sees the picture."""
        words, work = self.context.words, self.work
        screen.fill((0, 0, 0))
        text(words("robots.check"), TITLE, ICE, "head").draw(screen, 960, 160)
        if work.fault is not None:
            for i, line in enumerate(paragraph(words.sentence(work.fault), ROOM, 4, ALARM, "c")):
                line.draw(screen, 960, 480 + 60 * i)
        elif work.mm is None:
            text(words("calibrate.looking_for"), LABEL, MIST, "body", room=ROOM).draw(screen, 960, 480)
        else:
            self._draw_drift(screen, work.mm)
        try:
            if not (work.drift and work.drift.ground.printed):
                draw_corners(screen)
        except OpenCVMissing as missing:
            work.fault = missing.message
        self._draw_picture(screen)
        self._draw_spot(screen)

    def _draw_spot(self, screen: pygame.Surface) -> None:
        """Show the size of a robot's marker here, a check of the measured mat width."""
        words, work = self.context.words, self.work
        x, y = LEFT + SPOT[0], TOP + SPOT[1]
        pygame.draw.circle(screen, GREY, (x, y), DISC)
        sentence, color = words("calibrate.put"), MIST
        if work.marker_mm is not None and work.drift is not None:
            marker_size = work.drift.ground.marker
            wrong = abs(work.marker_mm / marker_size - 1.0) > MAX_SIZE_ERROR
            key, color = ("marker_off", ALARM) if wrong else ("marker", ICE)
            sentence = words(f"calibrate.{key}", mm=f"{work.marker_mm:.1f}", true=f"{marker_size:.0f}")
        if color != ALARM and work.heights is not None and work.heights.seen:
            found, color = work.heights.height, ALARM if work.heights.wrong else ICE
            key = "lid_flat" if found is None else "height_off" if work.heights.wrong else "above"
            metres, given = (found or 0.0) / 1000.0, work.heights.ground.height / 1000.0
            sentence = words(f"calibrate.{key}", height=f"{metres:.1f}", given=f"{given:.1f}")
        for i, line in enumerate(paragraph(sentence, 330, 4, color, "c")):
            line.draw(screen, x, y + 120 + 48 * i)

    def _draw_picture(self, screen: pygame.Surface) -> None:
        """Exposure and sharpness at present, and the most serious warning about them."""
        words, quality, state = self.context.words, self.work.quality, self.work.exposure
        if self.work.fault is not None or quality is None:
            return
        share = round(100 * quality.detection)
        line = words("calibrate.picture", time=exposure_text(words, state), blur=f"{quality.blur_px:.1f}", share=share)
        text(line, BODY, MIST, room=ROOM).draw(screen, 960, 800)
        message = quality.advice if not quality.sufficient else warning_of(state) or quality.advice
        if message is None and quality.anyway:
            message = used_anyway(quality)
        if message is not None:
            color = FOCUS if quality.sufficient else ALARM
            for i, row in enumerate(paragraph(words.sentence(message), ROOM, 2, color, "c")):
                row.draw(screen, 960, 868 + 46 * i)

    def _draw_drift(self, screen: pygame.Surface, mm: float) -> None:
        key, color = ("still", ICE) if mm <= WARN else ("moved", FOCUS) if mm <= PAUSE else ("away", ALARM)
        text(self.context.words("calibrate.mm", mm=f"{mm:.1f}"), HERO, color, "head").draw(screen, 960, 380)
        bar().draw(screen)
        share = min(1.0, mm / BAR_MM)
        pygame.draw.rect(screen, color, (BAR.x + 6, BAR.y + 6, max(8, round((BAR.w - 12) * share)), BAR.h - 12))
        text(self.context.words(f"calibrate.{key}"), LABEL, color, "body", room=BAR.w).draw(screen, 960, 724)


@cached
def bar() -> LitImage:
    """The empty bar, with marks at the warning and pause limits."""
    layer = Layer(BAR.x, BAR.y - 20, BAR.w, 120)
    layer.glow.line(cut_box(BAR.x, BAR.y, BAR.w, BAR.h, 8), STEEL, 4, True)
    marks: tuple[tuple[float, Color], ...] = ((WARN, FOCUS), (PAUSE, ALARM))
    for mm, color in marks:
        x = BAR.x + BAR.w * mm / BAR_MM
        layer.glow.line([(x, BAR.y - 12), (x, BAR.bottom + 12)], color, LINE)
        layer.canvas.crisp.text(f"{mm:.0f} mm", BODY, x, BAR.bottom + 44, color, "body", "c")
    return layer.render()
