"""Operator menu for robots on a mat: camera, corners, markers."""

from collections.abc import Callable

import pygame

from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.scene import Context, Push, Scene, StackOperation
from pigaming_app.scenes.mat.paper.sheet_file import write_sheet
from pigaming_app.scenes.mat.robots.sketches import sketch
from pigaming_app.scenes.mat.session import session_if_any
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.ui.draw import FOCUS
from pigaming_app.ui.draw.layers import LitImage, paragraph
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS = ("guide", "robots", "board", "radio", "calibrate", "check", "things", "blocks", "pin", "sheet")
ROS_ROWS = ("robots", "pin")  # a ROS network has cameras and radios of its own


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
            self.show_message(write_sheet(self))
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
        from pigaming_app.scenes.mat.robots.guide_page import GuidePage
        from pigaming_app.scenes.mat.robots.set_up_page import SetUpPage
        from pigaming_app.scenes.mat.things.arena_page import ArenaPage

        pages: dict[str, Callable[[Context], Scene]] = {
            "guide": lambda context: GuidePage(context, self._page, lambda: write_sheet(self)),
            "robots": FleetPage,
            "board": SetUpPage,
            "radio": RadioPage,
            "calibrate": CalibrationPage,
            "check": DriftPage,
            "things": ArenaPage,
            "pin": CornerPinPage,
        }
        return pages[name](self.context)
