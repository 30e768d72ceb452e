"""Lab menu: save the robot, open another one, compare, start over."""

import pygame

from pigaming_app.scenes.flow.stack import Pop, StackOperation, Swap
from pigaming_app.scenes.lab.host import IDLE, LabHost, dimmed_background
from pigaming_app.scenes.lab.pages.compare_page import ComparePage
from pigaming_app.scenes.lab.pages.name_page import NamePage
from pigaming_app.scenes.lab.pages.open_page import OpenPage
from pigaming_app.scenes.play.pause import menu_spots, sheet_title
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LABEL, MIST
from pigaming_app.ui.draw.layers import Layer
from pigaming_app.ui.draw.text import word
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.dialog import PROMPTS, W, overlay
from pigaming_app.ui.widgets.focus import Focus

ITEMS = ("save", "open", "compare", "anew")


class LabMenu:
    """The menu; the Lab below it is paused."""

    def __init__(self, lab: LabHost) -> None:
        self.lab, self.context = lab, lab.context
        self.sure = False  # confirmation pending: the next press discards the training
        self.picture: pygame.Surface | None = None
        self.focus = Focus(menu_spots(ITEMS))
        self.prompts = self.context.prompts(
            [(Button.FIRE, "pause.hint_ok"), (Button.BACK, "lab.hint_lab")], PROMPTS, W - 80
        )

    def on_enter(self) -> None:
        """Nothing to do."""

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE selects the focused item; START and BACK return to the Lab."""
        event = self.prompts.as_button(event)
        if event.button in (Button.START, Button.BACK):
            self.context.sounds.play("back")
            return Pop()
        if self.focus.handle(event):
            self.sure = False
            self.context.sounds.play("move")
        chosen = self.focus.activated(event)
        return self._do(chosen) if chosen else None

    def update(self, seconds: float) -> StackOperation:
        self.focus.update(seconds)
        return Pop() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        if self.picture is None:
            self.picture = overlay(dimmed_background(self.lab), ICE, self._paint)
        screen.blit(self.picture, (0, 0))
        self.focus.draw(screen, ALARM if self.sure else FOCUS)
        label = self.context.words("lab.sure" if self.sure else f"lab.{self.focus.name}")
        if self.sure:
            pygame.draw.rect(screen, (0, 0, 0), self.focus.spot.rect)
        word(label, LABEL, ALARM if self.sure else FOCUS, "head", 0.45).draw(screen, *self.focus.spot.rect.center)
        self.prompts.draw(screen)

    def _do(self, name: str) -> StackOperation:
        self.context.sounds.play("accept")
        match name:
            case "save":
                return Swap(NamePage(self.lab))
            case "open":
                return Swap(OpenPage(self.lab))
            case "compare":
                return Swap(ComparePage(self.lab))
            case _ if self.sure:
                self.lab.begin()
                return Pop()
            case _:
                self.sure = True
                return None

    def _paint(self, layer: Layer) -> None:
        words = self.context.words
        sheet_title(layer, None, words("lab.title"), ICE)
        for spot in self.focus.spots:
            layer.canvas.text(words(f"lab.{spot.name}"), LABEL, *spot.rect.center, MIST, "head", "c")
