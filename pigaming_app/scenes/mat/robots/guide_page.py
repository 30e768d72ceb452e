"""The guide: one checklist from the box to the first match with real robots. Each step checks itself."""

from collections.abc import Callable

import pygame

from pigaming_app.hardware.session.guide import STEPS, GuideStep, next_step, steps
from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.scene import Context, Home, Push, Scene, StackOperation
from pigaming_app.scenes.mat.robots.fleet_state import FleetState
from pigaming_app.scenes.mat.robots.sketches import sketch
from pigaming_app.scenes.mat.session import session_of
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import FOCUS, GREEN, LINE
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets.labels import heading, sign
from pigaming_app.ui.widgets.setting_row import SettingValue

EVERY = 0.5  # s between two checks
PAGES = {
    "robots": "board",
    "pair": "robots",
    "drive": "robots",
}  # rows of the menu that a step opens under another name
PICTURES = {**PAGES, "mat": "things", "pair": "radio", "drive": "check", "match": "robots"}


class GuidePage(SettingsPage):
    """The page. `page_of`: the page of a row of the menu; `write`: saves the marker sheet, and returns what to show."""

    right = Right.ROBOTS
    table, title = "guide", "guide.title"
    idle, stay = 600.0, 8.0

    def __init__(self, context: Context, page_of: Callable[[str], Scene], write: Callable[[], str]) -> None:
        self.page_of, self.write = page_of, write
        self.fleet = FleetState(session_of(context), context.settings)
        self.steps = {name: GuideStep(name, False) for name in STEPS}
        self.heard, self.since = 0, 0.0
        self.following = True  # the focus goes to the next step by itself, until a button is pressed
        super().__init__(context, STEPS)

    def on_enter(self) -> None:
        """Open the radio, and check all steps: a page behind this one may have done one."""
        self.fleet.begin()
        self.following = True
        self._check()

    def on_leave(self) -> None:
        """Release camera and radio for the next page."""
        self.fleet.end()

    def press(self, event: InputEvent) -> StackOperation:
        self.following = False
        return super().press(event)

    def advance(self, seconds: float) -> StackOperation:
        self.fleet.update(seconds)
        self.since += seconds
        if self.since >= EVERY:
            self._check()
        return None

    @property
    def heading(self) -> LitImage:
        done = sum(step.done for step in self.steps.values())
        state = self.context.words("guide.state", done=done, all=len(STEPS))
        return heading(self.context.words(self.title), state, right_color=GREEN if done == len(STEPS) else FOCUS)

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the page, with a tick at the end of each row that is done."""
        super().paint(screen)
        for spot in self.focus.spots:
            if self.steps[spot.name].done:
                sign("check", 20, GREEN, LINE).draw(screen, spot.rect.right - 70, spot.rect.centery)

    def description(self, name: str) -> tuple[str, str]:
        """Heading and sentence of a step; the sentence is what is wrong, if anything is."""
        problem = self.steps[name].problem
        return self.label(name), self.context.words.sentence(problem) if problem else self.line(name)

    def value(self, name: str) -> SettingValue:
        if name == "mat":
            return self.switch(self.context.settings.mat)
        if name == "robots" and self.heard:
            return SettingValue("action", (self.context.words("guide.heard", count=self.heard),))
        return self.action("guide.done" if self.steps[name].done else "robots.open")

    def apply(self, name: str, chosen: int) -> None:
        self.context.settings.mat = bool(chosen)

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Open the page of a step, save the marker sheet, or go to the games."""
        self.context.sounds.play("accept")
        if name == "sheet":
            self.show_message(self.write())
            return None
        return Home() if name == "match" else Push(self.page_of(PAGES.get(name, name)))

    def picture(self, name: str, chosen: int) -> LitImage:
        return sketch(PICTURES.get(name, name))

    def _check(self) -> None:
        """Check all steps; where one changed, the rows are drawn anew."""
        self.since = 0.0
        context, fleet = self.context, self.fleet
        heard = sum(fleet.heard(robot) for robot in range(ROBOTS)) if fleet.link else 0
        site = "emulated" if fleet.session.emulated else "real"
        fault = fleet.link.fault if fleet.link else None
        found = steps(context.settings, folders().data, site, context.canvas.projection, heard, fault)
        now = {step.name: step for step in found}
        if (now, heard) != (self.steps, self.heard):
            self.steps, self.heard = now, heard
            self.rewarm()
        if self.following:
            self.focus.move_to(next_step(found) or STEPS[-1])
