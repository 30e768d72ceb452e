"""Operator menu for robots on a mat: camera, corners, markers."""

import logging

import pygame

from pigaming_app.hardware.vision.markers import OpenCVMissing
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import Push, StackOperation
from pigaming_app.scenes.mat.session import session_if_any
from pigaming_app.storage.safe_files import NotSaved, write_atomic
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import FOCUS, GREY, ICE, LINE, PLAYERS, STEEL, THIN, GlowCanvas, cut_box
from pigaming_app.ui.draw.layers import LitImage, backdrop
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import paragraph
from pigaming_app.ui.i18n import english, with_english
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.focus import Focus
from pigaming_app.ui.widgets.labels import black_out, frame, heading
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS = ("robots", "radio", "calibrate", "check", "things", "blocks", "pin", "sheet")
ROS_ROWS = ("robots", "pin")  # a ROS network has cameras and radios of its own
SHEET = "markers.pdf"
MESSAGE_SECONDS = 8.0  # s, display time of a message
IDLE = 300.0  # s without input before the return to the title

log = logging.getLogger("pigaming")


class RobotsMenu:
    """The menu."""

    def __init__(self, context: Context) -> None:
        self.context = context
        session = session_if_any(context)
        self.focus = Focus(dials.spots(ROWS if session is None or session.radio else ROS_ROWS))
        hints = [(Button.FIRE, "robots.hint_ok"), (Button.BACK, "robots.hint_back")]
        self.navigation = Navigation(context, self.focus, hints, IDLE, MESSAGE_SECONDS)

    def on_enter(self) -> None:
        """Nothing to do."""

    def handle(self, event: InputEvent) -> StackOperation:
        """Up and down select, FIRE opens or changes, as do left and right."""
        event = self.navigation.prompts.as_button(event)
        if turn := self.navigation.handle(event):
            return turn
        if self.focus.name == "blocks" and dials.step_of(event, self.focus, self._blocks):
            self._change_blocks()
            return None
        chosen = self.focus.activated(event)
        return self._run(chosen) if chosen and (chosen != "blocks" or event.button is not Button.CLICK) else None

    def update(self, seconds: float) -> StackOperation:
        return self.navigation.update(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        words, name = self.context.words, self.focus.name
        screen.blit(backdrop(), (0, 0))
        heading(words("robots.title")).draw(screen)
        black_out(screen, dials.PANEL)
        values = {
            row: SettingValue("deed", (words("robots.write" if row == "sheet" else "robots.open"),)) for row in ROWS
        }
        values["blocks"] = self._blocks
        dials.draw(screen, self.context.words, self.focus, "robots", values)
        frame(*dials.PANEL.size).draw(screen, *dials.PANEL.topleft)
        sketch(name).draw(screen, *dials.CENTRE)
        dials.describe(screen, words(f"robots.{name}"), words(f"robots.{name}_line"))
        if self.navigation.sentence:
            lines = paragraph(self.navigation.sentence, 1600, 2, FOCUS, "c")
            for i, line in enumerate(lines):
                line.draw(screen, 960, self.navigation.prompts.y + 44 * i - 22 * (len(lines) - 1))
        else:
            self.navigation.prompts.draw(screen)

    @property
    def _blocks(self) -> SettingValue:
        words = self.context.words
        return SettingValue("toggle", (words("options.off"), words("options.on")), int(self.context.settings.blocks))

    def _change_blocks(self) -> None:
        """Switch between scanned things and blocks with markers."""
        settings = self.context.settings
        settings.blocks = not settings.blocks
        self.context.sounds.play("move")
        try:
            settings.save(folders().config)
        except NotSaved as error:
            log.warning("%s", error)
            self.navigation.show_message(self.context.words("app.unsaved"))

    def _run(self, name: str) -> StackOperation:
        from pigaming_app.scenes.mat.calibration.corner_pin_page import CornerPinPage
        from pigaming_app.scenes.mat.calibration.drift_page import DriftPage
        from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage

        if name == "blocks":
            self._change_blocks()
            return None
        self.context.sounds.play("accept")
        match name:
            case "robots":
                from pigaming_app.scenes.mat.robots.fleet_page import FleetPage

                return Push(FleetPage(self.context))
            case "radio":
                from pigaming_app.scenes.mat.radio.page import RadioPage

                return Push(RadioPage(self.context))
            case "calibrate":
                return Push(CalibrationPage(self.context))
            case "check":
                return Push(DriftPage(self.context))
            case "things":
                from pigaming_app.scenes.mat.things.arena_page import ArenaPage

                return Push(ArenaPage(self.context))
            case "pin":
                return Push(CornerPinPage(self.context))
        self._write()
        return None

    def _write(self) -> None:
        """Save the marker sheet to the user's folder, and show its path."""
        from pigaming_app.hardware.calibration.marker_sheet import sheet

        path, words = folders().data / SHEET, self.context.words
        try:
            notes = with_english(words.language, "sheet.print", "sheet.cut")
            write_atomic(path, sheet(notes=notes, block_notes=with_english(words.language, "sheet.blocks")))
            self.navigation.show_message(words("robots.written", path=path))
        except OpenCVMissing as missing:
            log.warning("%s", english().long_sentence(missing.message))
            self.navigation.show_message(words.sentence(missing.message))
        except NotSaved as error:
            log.warning("%s", error)
            self.navigation.show_message(words("app.unsaved"))


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
            ink.line(cut_box(x - 36, y - 36, 72, 72, 4), FOCUS, THIN, True)
            ink.fill([(x - 20, y - 20), (x + 4, y - 20), (x + 4, y + 4), (x - 20, y + 4)], FOCUS)
            ink.fill([(x + 4, y + 4), (x + 20, y + 4), (x + 20, y + 20), (x + 4, y + 20)], FOCUS)
    elif name == "pin":
        ink.line(cut_box(-170, -110, 340, 220, 12), STEEL, THIN, True)
        points = [(-150, -120), (176, -92), (150, 118), (-182, 96)]
        ink.line(points, FOCUS, LINE, True)
        for x, y in points:
            ink.solid(cut_box(x - 15, y - 15, 30, 30, 4)).line(cut_box(x - 15, y - 15, 30, 30, 4), ICE, LINE, True)
    else:
        ink.line(cut_box(-108, -150, 216, 300, 14), ICE, LINE, True)
        for x, y in ((-50, -84), (50, -84), (-50, 20), (50, 20)):
            ink.line(cut_box(x - 36, y - 36, 72, 72, 4), FOCUS, THIN, True)
            ink.fill([(x - 20, y - 20), (x + 4, y - 20), (x + 4, y + 4), (x - 20, y + 4)], FOCUS)
            ink.fill([(x + 4, y + 4), (x + 20, y + 4), (x + 20, y + 20), (x + 4, y + 20)], FOCUS)
        ink.line([(-80, 112), (80, 112)], ICE, LINE).line([(-80, 98), (-80, 126)], ICE, LINE)
        ink.line([(80, 98), (80, 126)], ICE, LINE)
    return LitImage(ink.lit(0.9), (-240, -170))
