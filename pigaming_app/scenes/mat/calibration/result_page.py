"""The calibration result: errors on the held-out board, as numbers and as a plot.

A failure is shown as one sentence beside the camera's last picture.
"""

import logging
from collections.abc import Callable
from dataclasses import dataclass, replace

import pygame

from pigaming_app.hardware.calibration.corner_pin import pin_of, turned_over
from pigaming_app.hardware.calibration.ground_plane import MAX_SIZE_ERROR, GroundPlane
from pigaming_app.hardware.calibration.quality import NEEDED, SMALL_EDGE, CameraQuality, used_anyway
from pigaming_app.hardware.calibration.site import CalibrationSite, Measurements
from pigaming_app.hardware.calibration.solver import MAX_MM, MEAN_MM, Residuals
from pigaming_app.hardware.session import store
from pigaming_app.hardware.signals import ExposureState, Image
from pigaming_app.hardware.vision.discovery import CameraId
from pigaming_app.hardware.vision.exposure import warning_of
from pigaming_app.scenes.flow.scene import Context, Pop, Scene, StackOperation, Swap
from pigaming_app.scenes.mat.calibration.picture_quality import exposure_text
from pigaming_app.scenes.mat.calibration.residual_plot import AREA, SIDE, arrows, fact, figure
from pigaming_app.scenes.pages.page import Page
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import ALARM, BODY, FOCUS, ICE, MIST, STEEL, Color
from pigaming_app.ui.draw.layers import LitImage, paragraph, text
from pigaming_app.ui.draw.pixels import grey_surface
from pigaming_app.ui.i18n import english
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, chip, heading

HIGH = 84  # px, height of a chip
FOOT = 836  # px, top of the chips
GAUGE, FACT = 146, 38  # px, pitch of the gauges, and of the quantities without a limit
PROMPTS_ROOM = 2 * (SIDE.x - 960) - 48  # px, left of the warning beside the plot

UNKNOWN = ExposureState()

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class CalibrationResult:
    """Inputs and result of a calibration. `marker_mm`: measured size of a robot's marker, 0 if none was seen."""

    site: CalibrationSite
    number: CameraId
    measures: Measurements
    ground: GroundPlane | None
    residuals: Residuals | None
    trouble: OperatorMessage | None = None
    picture: Image | None = None  # last picture of the camera
    marker_mm: float = 0.0
    exposure: ExposureState = UNKNOWN
    weak: tuple[float, float] | None = None  # arena px: the place with the most blur or the least light, if poor

    @property
    def accurate(self) -> bool:
        """True if the errors are small enough to play."""
        return self.trouble is None and self.residuals is not None and self.residuals.accepted

    @property
    def good(self) -> bool:
        """True if it may be saved: accurate, and enough markers are expected to be found."""
        return self.accurate and self.ground is not None and self.ground.quality.sufficient


class ResultPage(Page):
    """The page: save, again, or back. `retry`: makes the page that repeats the calibration."""

    idle, stay = 600.0, 6.0
    prompts_room = PROMPTS_ROOM
    hints = ((Button.FIRE, "calibrate.hint_ok"), (Button.BACK, "calibrate.hint_back"))

    def __init__(self, context: Context, finding: CalibrationResult, retry: Callable[[], Scene]) -> None:
        self.finding, self.retry = finding, retry
        names = ("save", "again", "leave") if finding.good else ("again", "leave")
        if finding.accurate and not finding.good:
            names = ("again", "anyway", "leave")
        if finding.trouble and finding.trouble.key == "mirrored":
            names = ("flip", "again", "leave")
        super().__init__(context, Focus([FocusSpot(name, self._box(i)) for i, name in enumerate(names)]))
        self.arrows: tuple[LitImage, int] | None = None
        small = finding.picture
        self.picture = None if small is None else grey_surface(small)

    def on_enter(self) -> None:
        """Log the errors."""
        if self.finding.residuals and not self.finding.trouble:
            log.info("calibration: %s", english().long_sentence(self.finding.residuals.verdict))

    def advance(self, seconds: float) -> StackOperation:
        self.finding.site.advance(seconds)
        return None

    @property
    def heading(self) -> LitImage:
        finding = self.finding
        title = "good" if finding.good else "failed" if finding.residuals is None or finding.trouble else "bad"
        return heading(self.context.words(f"calibrate.{title}"), color=ICE if finding.good else ALARM)

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the errors, or the failure, and what can be done."""
        words, finding = self.context.words, self.finding
        black_out(screen, AREA)
        if finding.residuals is None or finding.trouble:
            self._draw_failure(screen)
        else:
            self._draw_errors(screen, finding.residuals)
        for spot in self.focus.spots:
            black_out(screen, spot.rect)
            state = "focus" if spot.name == self.focus.name else "on"
            chip(words(f"calibrate.{spot.name}"), spot.rect.w, state, HIGH).draw(screen, *spot.rect.topleft)
        self.focus.draw(screen)

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the message below the prompts."""
        for line in paragraph(self.message, 1600, 1, FOCUS, "c") if self.message else ():
            line.draw(screen, 960, 1046)
        self.prompts.draw(screen)

    # ---- drawing

    def _box(self, i: int) -> pygame.Rect:
        return pygame.Rect(AREA.x + 388 * i, FOOT, 368, HIGH)

    def _draw_errors(self, screen: pygame.Surface, residuals: Residuals) -> None:
        words, finding = self.context.words, self.finding
        self.arrows = self.arrows or arrows(residuals, finding.weak)
        lit, times = self.arrows
        lit.draw(screen)
        text(words("calibrate.enlarged", times=times), BODY, MIST, "body", "l", AREA.w).draw(
            screen, AREA.x + 24, AREA.bottom - 36
        )
        y = SIDE.y
        for key, value, limit in (("mean", residuals.mean_mm, MEAN_MM), ("most", residuals.max_mm, MAX_MM)):
            limit_text = words("calibrate.limit", mm=f"{limit:g}")
            value_text = words("calibrate.mm", mm=f"{value:.1f}")
            figure(words(f"calibrate.{key}"), value_text, value / limit, limit_text).draw(screen, SIDE.x, y)
            y += GAUGE
        if finding.ground is None or not finding.accurate:
            for i, line in enumerate(paragraph(words.sentence(residuals.verdict), SIDE.w, 5)):
                line.draw(screen, SIDE.x, y + 20 + 52 * i)
            return
        quality, missed = finding.ground.quality, 1.0 - finding.ground.quality.detection
        limit_text = words("calibrate.limit_percent", share=f"{100 * (1 - NEEDED):.0f}")
        value_text = words("calibrate.percent", share=f"{100 * missed:.0f}")
        figure(words("calibrate.missed"), value_text, missed / (1.0 - NEEDED), limit_text).draw(screen, SIDE.x, y)
        y += GAUGE
        warning, color = self._warning(quality)
        for name, value_text, warned in self._facts(finding.ground, quality):
            fact(words(f"calibrate.{name}"), value_text, color if warned else ICE).draw(screen, SIDE.x, y)
            y += FACT
        for i, line in enumerate(paragraph(warning, SIDE.w, 4, color)):
            line.draw(screen, SIDE.x, y + 12 + 46 * i)

    def _facts(self, ground: GroundPlane, quality: CameraQuality) -> list[tuple[str, str, bool]]:
        """Name, value and warning of the quantities without a limit of their own."""
        words, state, robot = self.context.words, self.finding.exposure, self.finding.marker_mm
        facts = [
            ("height", words("calibrate.metres", m=f"{ground.height / 1000.0:.2f}"), False),
            ("edge", words("calibrate.px", px=f"{quality.marker_px:.0f}"), quality.marker_px < SMALL_EDGE),
            ("blur", words("calibrate.px", px=f"{quality.blur_px:.1f}"), _cause(quality) == "finds_blurred"),
            ("light", words("calibrate.percent", share=round(100 * quality.light)), _cause(quality) == "finds_dim"),
            ("exposure", exposure_text(words, state), warning_of(state) is not None),
        ]
        if robot:
            wrong = abs(robot / ground.marker - 1.0) > MAX_SIZE_ERROR
            facts.append(("size", words("calibrate.mm", mm=f"{robot:.1f}"), wrong))
        return facts

    def _warning(self, quality: CameraQuality) -> tuple[str, Color]:
        """The sentence of the most serious warning, and its colour."""
        words, finding = self.context.words, self.finding
        message = None if quality.sufficient else quality.advice
        if message is None and finding.ground is not None and finding.marker_mm:
            true = finding.ground.marker
            if abs(finding.marker_mm / true - 1.0) > MAX_SIZE_ERROR:
                return words("calibrate.marker_off", mm=f"{finding.marker_mm:.1f}", true=f"{true:.0f}"), ALARM
        message = message or warning_of(finding.exposure) or quality.advice
        return (words.sentence(message), FOCUS if quality.sufficient else ALARM) if message else ("", ICE)

    def _draw_failure(self, screen: pygame.Surface) -> None:
        words, trouble = self.context.words, self.finding.trouble
        sentence = words.sentence(trouble) if trouble else ""
        for i, line in enumerate(paragraph(sentence, SIDE.w, 9)):
            line.draw(screen, SIDE.x, SIDE.y + 40 + 52 * i)
        key = "unseen" if self.picture is None else "sees"
        text(words(f"calibrate.{key}"), BODY, MIST, "body", "l").draw(screen, AREA.x + 24, AREA.bottom - 36)
        room = AREA.inflate(-48, -136).move(0, -20)
        if self.picture is not None:
            w, h = self.picture.get_size()
            scale = min(room.w / w, room.h / h)
            scaled = pygame.transform.smoothscale(self.picture, (round(w * scale), round(h * scale)))
            screen.blit(scaled, scaled.get_rect(center=room.center))
        pygame.draw.rect(screen, STEEL, room, 2)

    # ---- actions

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        finding = self.finding
        if name == "leave":
            return self.leave()
        if name == "flip":
            self._turn_over()
        if name in ("again", "flip"):
            self.context.sounds.play("accept")
            return Swap(self.retry())
        if finding.ground is None:
            return None
        quality = replace(finding.ground.quality, anyway=name == "anyway")
        if quality.anyway:
            log.warning("calibration used anyway: %s", english().long_sentence(used_anyway(quality)))
        path = store.calibration_file(finding.site.name)
        try:
            store.save(replace(finding.ground, quality=quality), path)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.context.sounds.play("back")
            self.show_message(self.context.words("calibrate.unsaved", path=path))
            return None
        self.context.sounds.play("accept")
        return Pop()

    def _turn_over(self) -> None:
        """Turn the picture over, for a projector that shines by a mirror."""
        canvas, settings = self.context.canvas, self.context.settings
        canvas.pin(pin_of(turned_over(canvas.corners)))
        settings.corners = [round(value) for value in canvas.corners]
        self.save()


def _cause(quality: CameraQuality) -> str:
    """Key of the reason why too few markers are found; "" if enough are."""
    return "" if quality.sufficient or quality.advice is None else quality.advice.key
