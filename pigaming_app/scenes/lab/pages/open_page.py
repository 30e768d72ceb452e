"""Selection of a saved robot to continue with."""

from datetime import datetime

import pygame

from pigaming_app.scenes.files import is_network
from pigaming_app.scenes.flow.scene import Pop, StackOperation
from pigaming_app.scenes.lab.host import IDLE, LabHost
from pigaming_app.scenes.lab.network.kind_switch import SIGN, network_sign, table_sign
from pigaming_app.scenes.lab.saved_robots import RobotFileError, delete_robot, file_of, load_robot, names
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, SUB, THIN, cut_box
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_size, span, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out

COLUMNS, ROWS = 3, 4
TOP, HIGH, PITCH = 236, 140, 164
INPUT_LOCKOUT = 0.3  # s during which input is ignored


class OpenPage(Page):
    """Paged cards of the saved robots, most recent first."""

    title, idle, when_idle = "lab.open_title", IDLE, Pop()

    def __init__(self, lab: LabHost) -> None:
        self.lab = lab
        self.names = names()
        self.networks: dict[str, bool] = {}  # whether a robot has a network, once it was shown
        self.page = 0
        self.asked = ""  # the robot that the next X deletes
        super().__init__(lab.context, Focus(self._spots()))

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE opens, Y shows the next page."""
        if not self.names:
            return self.leave() if event.button in (Button.FIRE, Button.START) else None
        if event.button is Button.Y and self.pages > 1:
            self.page = (self.page + 1) % self.pages
            self.focus = Focus(self._spots())
            self.context.sounds.play("move")
            return None
        if event.button is Button.X and not self.context.kiosk:
            self._delete(self.focus.name)
            return None
        return super().press(event)

    @property
    def subtitle(self) -> str:
        return f"{self.page + 1} / {self.pages}" if self.pages > 1 else ""

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the cards of this page."""
        words = self.context.words
        if self.names:
            black_out(screen, *(spot.rect for spot in self.focus.spots))
            for spot in self.focus.spots:
                if spot.name not in self.networks:
                    self.networks[spot.name] = is_network(file_of(spot.name))
                hot = spot.name == self.focus.name
                when = saved(words, spot.name)
                card(spot.name, when, self.networks[spot.name], hot).draw(screen, *spot.rect.topleft)
            self.focus.draw(screen)
        else:
            text(words("lab.none"), LABEL, MIST, "head").draw(screen, 960, 520)

    # ---- inside

    @property
    def pages(self) -> int:
        """Number of pages."""
        return max(1, -(-len(self.names) // (COLUMNS * ROWS)))

    def _spots(self) -> list[FocusSpot]:
        first = self.page * COLUMNS * ROWS
        return [FocusSpot(name, place(i)) for i, name in enumerate(self.names[first : first + COLUMNS * ROWS])] or [
            FocusSpot("", place(0))
        ]

    def _delete(self, name: str) -> None:
        """Ask at the first press, delete at the second."""
        words = self.context.words
        if self.asked != name or not self.message:
            self.asked = name
            self.show_message(words("lab.delete_sure", name=name))
            self.context.sounds.play("move")
            return
        self.asked = ""
        try:
            delete_robot(name)
        except RobotFileError as error:
            self.show_message(words(str(error), name=name), wrong=True)
            return
        self.show_message(words("lab.deleted", name=name))
        self.context.sounds.play("back")
        self.names = names()
        self.page = min(self.page, self.pages - 1)
        self.focus = Focus(self._spots())

    @property
    def hints(self) -> Hints:
        more = [(Button.Y, "lab.hint_page")] if self.pages > 1 else []
        more += [(Button.X, "replays.hint_delete")] if self.names and not self.context.kiosk else []
        return ([(Button.FIRE, "lab.hint_open")] if self.names else []) + more + [(Button.BACK, "lab.hint_lab")]

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        if self.age <= INPUT_LOCKOUT:
            return None
        words = self.context.words
        try:
            robot = load_robot(name)
            self.lab.open(robot, name)
            self.lab.show_message(words("lab.opened_other" if robot.other_engine else "lab.opened", name=name))
        except RobotFileError as error:
            self.lab.show_message(words(str(error), name=name), wrong=True)
        return Pop()


def place(i: int) -> pygame.Rect:
    """Rectangle of the i-th card of a page."""
    x, w = span(4 * (i % COLUMNS), 4)
    return pygame.Rect(x, TOP + PITCH * (i // COLUMNS), w, HIGH)


def saved(words: Words, name: str) -> str:
    """Local time at which a robot was saved, or "" if its file no longer exists."""
    try:
        return words.moment(datetime.fromtimestamp(file_of(name).stat().st_mtime))
    except OSError:
        return ""


@cached
def card(name: str, when: str, network: bool, hot: bool) -> LitImage:
    """Kind, name and save time of a robot; top left at (0, 0)."""
    w = span(0, 4)[1]
    layer = Layer(0, 0, w, HIGH)
    layer.glow.line(cut_box(0, 0, w, HIGH, 16), STEEL, THIN, True)
    (network_sign if network else table_sign)(layer.canvas.crisp, 32 + SIGN, HIGH / 2, MIST)
    layer.canvas.text(name, fit_size(name, SUB, w - 374, "hero"), 84, HIGH / 2, FOCUS if hot else ICE, "hero")
    layer.canvas.body(when, w - 32, HIGH / 2, MIST, "r", BODY)
    return layer.render()
