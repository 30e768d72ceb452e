"""The height page: a robot is placed on spot after spot, and its positions give the height of the camera."""

import math
from collections.abc import Callable
from dataclasses import replace

import pygame

from pigaming_app.hardware.calibration.height_procedure import PLACES, STILL, HeightProcedure
from pigaming_app.scenes.flow.scene import Context, Scene, StackOperation, Swap
from pigaming_app.scenes.mat.calibration.result_page import CalibrationResult, ResultPage
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, LINE, MIST, STEEL, THIN, GlowCanvas, dim
from pigaming_app.ui.draw.layers import LitImage, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button

DISC = 72  # px: the light must cover a lid, 70 mm above the mat, at an angle
GREY = (128, 128, 128)
NEAR, FAR = 86, 128  # px from the middle: ends of the four aiming lines


class HeightPage(Page):
    """The page. `finding`: a calibration without camera position; `retry`: makes the page that repeats it."""

    idle = math.inf
    prompts_y = 1040
    hints = ((Button.BACK, "calibrate.hint_stop"),)

    def __init__(self, context: Context, finding: CalibrationResult, retry: Callable[[], Scene]) -> None:
        assert finding.ground is not None
        super().__init__(context)
        self.finding, self.retry = finding, retry
        self.work = HeightProcedure(finding.site, finding.number, finding.ground)
        self.work.begin()
        self.seen_count = 0

    def on_leave(self) -> None:
        """Release the camera."""
        self.work.close()

    def advance(self, seconds: float) -> StackOperation:
        """Poll for the robot on the next spot; after the last, show the result."""
        work = self.work
        self.finding.site.advance(seconds)
        work.pump()
        if len(work.seen) != self.seen_count:
            self.seen_count = len(work.seen)
            self.context.sounds.play("accept")
        if work.place is not None:
            return None
        self.on_leave()
        ground = work.found or self.finding.ground
        result = replace(self.finding, ground=ground, trouble=work.fault, marker_mm=work.marker_mm, picture=work.small)
        return Swap(ResultPage(self.context, result, self.retry))

    def draw(self, screen: pygame.Surface) -> None:
        """Draw it on black: the camera sees the picture."""
        place, words = self.work.place, self.context.words
        screen.fill((0, 0, 0))
        for i, (x, y) in enumerate(PLACES):
            if i == place:
                pygame.draw.circle(screen, GREY, (LEFT + x, TOP + y), DISC)
            spot(i == place, i < (place or 0)).draw(screen, LEFT + x, TOP + y)
        if place is None:
            return
        x, y = PLACES[place]
        filled = round(self.work.steady * STILL)
        for i in range(STILL):
            box = pygame.Rect(LEFT + x - STILL * 9 + 18 * i, TOP + y + (150 if y < 450 else -164), 14, 14)
            pygame.draw.rect(screen, FOCUS if i < filled else STEEL, box, 0 if i < filled else 2)
        text(words("calibrate.outline"), LABEL, ICE, "head").draw(screen, 960, 560)
        text(words("calibrate.count", place=place + 1, places=len(PLACES)), LABEL, MIST, "head").draw(screen, 960, 640)
        self.prompts.draw(screen)
        self.work.mark_shown(place)


@cached
def spot(here: bool, done: bool) -> LitImage:
    """Four aiming lines; no light near the marker."""
    color = FOCUS if here else dim(ICE, 0.5) if done else STEEL
    ink = GlowCanvas(2 * FAR + 60, 2 * FAR + 60).set_transform(FAR + 30, FAR + 30)
    for across, down in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        ink.line([(NEAR * across, NEAR * down), (FAR * across, FAR * down)], color, LINE if here else THIN)
    if done:
        ink.line([(-26, 2), (-8, 20), (28, -18)], color, LINE)
    return LitImage(ink.plain(), (-FAR - 30, -FAR - 30))
