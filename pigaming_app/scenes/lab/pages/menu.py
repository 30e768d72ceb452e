"""Lab menu: save the robot under a name, open another one, compare, start over."""

import pygame

from pigaming_app.scenes.flow.scene import Pop, StackOperation, Swap
from pigaming_app.scenes.lab.host import IDLE, LabHost, dimmed_background
from pigaming_app.scenes.lab.pages.compare_page import ComparePage
from pigaming_app.scenes.lab.pages.open_page import OpenPage
from pigaming_app.scenes.lab.saved_robots import LENGTH, RobotFileError, delete_robot, file_of, names, proposal
from pigaming_app.scenes.pages import name_page
from pigaming_app.scenes.pages.sheet import Sheet
from pigaming_app.scenes.play.pause import menu_spots, sheet_title
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LABEL, MIST
from pigaming_app.ui.draw.layers import Layer, word
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus

ITEMS = ("save", "open", "compare", "anew")


class LabMenu(Sheet):
    """The menu; the Lab below it is paused."""

    idle, when_idle, closing = IDLE, Pop(), (Button.START,)
    hints = ((Button.FIRE, "pause.hint_ok"), (Button.BACK, "lab.hint_lab"))

    def __init__(self, lab: LabHost) -> None:
        super().__init__(lab.context, Focus(menu_spots(ITEMS)))
        self.lab = lab
        self.sure = False  # confirmation pending: the next press discards the training

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE selects the focused item."""
        before = self.focus.name
        turn = super().press(event)
        self.sure = self.sure and self.focus.name == before
        return turn

    @property
    def behind(self) -> pygame.Surface:
        return dimmed_background(self.lab)

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the focused item."""
        self.focus.draw(screen, ALARM if self.sure else FOCUS)
        label = self.context.words("lab.sure" if self.sure else f"lab.{self.focus.name}")
        if self.sure:
            pygame.draw.rect(screen, (0, 0, 0), self.focus.spot.rect)
        word(label, LABEL, ALARM if self.sure else FOCUS, "head", 0.45).draw(screen, *self.focus.spot.rect.center)

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        self.context.sounds.play("accept")
        match name:
            case "save":
                return Swap(RobotNamePage(self.lab))
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

    def paint_sheet(self, layer: Layer) -> None:
        words = self.context.words
        sheet_title(layer, None, words("lab.title"), ICE)
        for spot in self.focus.spots:
            layer.canvas.text(words(f"lab.{spot.name}"), LABEL, *spot.rect.center, MIST, "head", "c")


class RobotNamePage(name_page.NamePage):
    """Prompts for a name and saves the robot under it."""

    def __init__(self, lab: LabHost) -> None:
        super().__init__(lab.context, "lab.name_title", lab.name or proposal(), LENGTH, IDLE)
        self.lab = lab

    def is_taken(self, name: str) -> bool:
        return name != self.lab.name and name in names()

    def keep(self, name: str) -> StackOperation:
        words = self.context.words
        try:
            if name != self.lab.name:
                delete_robot(name)
            self.lab.trainer.save(name)
            self.lab.name = name
            self.lab.show_message(words("lab.saved", name=name, file=file_of(name)))
        except RobotFileError as error:
            self.lab.show_message(words(str(error)), wrong=True)
        return Pop()
