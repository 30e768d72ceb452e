"""Operator menu for robots on a mat: camera, corners, markers."""

import logging
from collections.abc import Callable

import pygame

from pigaming_app.hardware.vision.markers import OpenCVMissing
from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Push, Scene, StackOperation
from pigaming_app.scenes.mat.session import session_if_any
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import FOCUS, GREY, ICE, LINE, PLAYERS, STEEL, THIN, GlowCanvas, cut_box
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import paragraph
from pigaming_app.ui.i18n import english, with_english
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS = ("robots", "radio", "calibrate", "check", "things", "blocks", "pin", "sheet")
ROS_ROWS = ("robots", "pin")  # a ROS network has cameras and radios of its own
SHEET = "markers.pdf"

log = logging.getLogger("pigaming")


class RobotsMenu(SettingsPage):
    """The menu."""

    right = Right.ROBOTS
    table, title = "robots", "robots.title"
    idle, stay = 300.0, 8.0
    hints = ((Button.FIRE, "robots.hint_ok"), (Button.BACK, "robots.hint_back"))

    def __init__(self, context: Context) -> None:
        session = session_if_any(context)
        super().__init__(context, ROWS if session is None or session.radio else ROS_ROWS)

    def value(self, name: str) -> SettingValue:
        """The action of a row, or whether things are blocks with markers."""
        if name == "blocks":
            return self.switch(self.context.settings.blocks)
        return self.action("robots.write" if name == "sheet" else "robots.open")

    def apply(self, name: str, chosen: int) -> None:
        self.context.settings.blocks = bool(chosen)

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        self.context.sounds.play("accept")
        if name == "sheet":
            self._write()
            return None
        return Push(self._page(name))

    def picture(self, name: str, chosen: int) -> LitImage:
        return sketch(name)

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the message in place of the prompts, which has room for the path of a file."""
        if not self.message:
            self.prompts.draw(screen)
            return
        lines = paragraph(self.message, 1600, 2, FOCUS, "c")
        for i, line in enumerate(lines):
            line.draw(screen, 960, self.prompts_y + 44 * i - 22 * (len(lines) - 1))

    def _page(self, name: str) -> Scene:
        """The page that a row opens."""
        from pigaming_app.scenes.mat.calibration.corner_pin_page import CornerPinPage
        from pigaming_app.scenes.mat.calibration.drift_page import DriftPage
        from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage
        from pigaming_app.scenes.mat.radio.page import RadioPage
        from pigaming_app.scenes.mat.robots.fleet_page import FleetPage
        from pigaming_app.scenes.mat.things.arena_page import ArenaPage

        pages: dict[str, Callable[[Context], Scene]] = {
            "robots": FleetPage,
            "radio": RadioPage,
            "calibrate": CalibrationPage,
            "check": DriftPage,
            "things": ArenaPage,
            "pin": CornerPinPage,
        }
        return pages[name](self.context)

    def _write(self) -> None:
        """Save the marker sheet to the user's folder, and show its path."""
        from pigaming_app.hardware.calibration.marker_sheet import sheet

        path, words = folders().data / SHEET, self.context.words
        notes = with_english(words.language, "sheet.print", "sheet.cut")
        try:
            drawn = sheet(notes=notes, block_notes=with_english(words.language, "sheet.blocks"))
        except OpenCVMissing as missing:
            log.warning("%s", english().long_sentence(missing.message))
            self.show_message(words.sentence(missing.message))
            return
        if self.save(lambda: write_atomic(path, drawn)):
            self.show_message(words("robots.written", path=path))


@cached
def sketch(name: str) -> LitImage:
    """Icon of a row, centred on (0, 0)."""
    ink = GlowCanvas(480, 340).set_transform(240, 170)
    if name == "robots":
        for x, y, player in ((-120, -70, 0), (120, -70, 1), (-120, 80, 2), (120, 80, 3)):
            ink.ring(x, y, 46, PLAYERS[player], LINE).disc(x, y, 34, GREY)
            ink.arc(x, y, 68, -0.5, 1.1, FOCUS, THIN).arc(x, y, 68, 2.6, 4.2, FOCUS, THIN)
    elif name == "radio":
        ink.line([(0, -10), (-50, 140), (50, 140)], ICE, LINE, True).disc(0, -34, 16, FOCUS)
        for radius in (60, 104, 148):
            ink.arc(0, -34, radius, -0.7, 0.7, FOCUS, THIN).arc(0, -34, radius, 2.44, 3.84, FOCUS, THIN)
    elif name == "calibrate":
        ink.line(cut_box(-46, -146, 92, 60, 12), ICE, LINE, True).ring(0, -84, 16, ICE, LINE)
        for x in (-150, 150):
            ink.dashes([(x * 0.16, -62), (x, 60)], FOCUS, THIN, 14, 10, False)
        ink.line([(-150, 60), (150, 60), (196, 146), (-196, 146)], ICE, LINE, True)
        for x, y in ((-90, 102), (0, 102), (90, 102)):
            ink.line(cut_box(x - 16, y - 14, 32, 28, 4), FOCUS, THIN, True)
    elif name == "check":
        ink.line(cut_box(-176, -110, 352, 220, 12), STEEL, THIN, True)
        for x, y in ((-140, -76), (140, -76), (140, 76), (-140, 76)):
            ink.line(cut_box(x - 22, y - 22, 44, 44, 4), FOCUS, LINE, True)
        ink.line([(-50, 4), (-14, 38), (56, -36)], ICE, 12)
    elif name == "things":
        from pigaming_app.scenes.mat.things.outlines import boxes

        ink.line(cut_box(-176, -120, 352, 240, 12), STEEL, THIN, True)
        boxes(ink, 0, 0, FOCUS)
    elif name == "blocks":
        for x, y, wide in ((-90, -60, 76), (90, 50, 130)):
            ink.line(cut_box(x - wide, y - 60, 2 * wide, 120, 6), ICE, LINE, True)
            _marker(ink, x, y)
    elif name == "pin":
        ink.line(cut_box(-170, -110, 340, 220, 12), STEEL, THIN, True)
        points = [(-150, -120), (176, -92), (150, 118), (-182, 96)]
        ink.line(points, FOCUS, LINE, True)
        for x, y in points:
            ink.solid(cut_box(x - 15, y - 15, 30, 30, 4)).line(cut_box(x - 15, y - 15, 30, 30, 4), ICE, LINE, True)
    elif name == "sheet":
        ink.line(cut_box(-108, -150, 216, 300, 14), ICE, LINE, True)
        for x, y in ((-50, -84), (50, -84), (-50, 20), (50, 20)):
            _marker(ink, x, y)
        ink.line([(-80, 112), (80, 112)], ICE, LINE).line([(-80, 98), (-80, 126)], ICE, LINE)
        ink.line([(80, 98), (80, 126)], ICE, LINE)
    else:
        raise KeyError(name)
    return LitImage(ink.lit(0.9), (-240, -170))


def _marker(ink: GlowCanvas, x: float, y: float) -> None:
    ink.line(cut_box(x - 36, y - 36, 72, 72, 4), FOCUS, THIN, True)
    ink.fill([(x - 20, y - 20), (x + 4, y - 20), (x + 4, y + 4), (x - 20, y + 4)], FOCUS)
    ink.fill([(x + 4, y + 4), (x + 20, y + 4), (x + 20, y + 20), (x + 4, y + 20)], FOCUS)
