"""Sheets before a match on the mat: it cannot have real robots, or things are in the way in its arena."""

from collections.abc import Callable, Collection, Sequence

from pigaming_app.games.game import Setup
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import arena_title
from pigaming_app.scenes.flow.scene import Context, Push, Scene, StackOperation, Swap
from pigaming_app.scenes.mat.fault_icons import sign
from pigaming_app.scenes.mat.things.arena_page import ArenaPage
from pigaming_app.scenes.mat.things.outlines import boxes
from pigaming_app.scenes.pages.sheet import Sheet
from pigaming_app.scenes.play.pause import sheet_title
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.draw import ALARM, ICE, MIST
from pigaming_app.ui.draw.layers import Layer, write_lines
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.dialog import HEAD, ICON, ROOM, TEXT_X

UNCALIBRATED = ("none", "damaged", "changed", "version", "other_display")  # messages that require calibration


class BeforeMatchPage(Sheet):
    """A sheet for those who were about to play."""

    color = ALARM

    def __init__(self, context: Context, setup: Setup, devices: Sequence[Device | None]) -> None:
        self.setup, self.devices = setup, devices
        self.access = Access(context, lambda: self.devices)
        super().__init__(context, gate=self.access)

    def on_enter(self) -> None:
        self.context.sounds.play("error")


class UnavailablePage(BeforeMatchPage):
    """Real robots are not available: try again, or play with simulated ones. `message`: the reason; `match_of`: match
    factory for a set of real seats.
    """

    hints = ((Button.FIRE, "mat.hint_simulated"), (Button.X, "mat.hint_again"), (Button.BACK, "mat.hint_leave"))

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None],
        real: Collection[int],
        message: OperatorMessage,
        match_of: Callable[..., Scene],
    ) -> None:
        super().__init__(context, setup, devices)
        self.real, self.reason, self.match_of = real, message, match_of

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE plays with simulated robots, X retries."""
        if event.button in (Button.FIRE, Button.START):
            self.context.sounds.play("accept")
            return Swap(self.match_of(self.setup, self.devices, ()))
        if event.button is Button.X:
            return Swap(self.match_of(self.setup, self.devices, self.real))
        return None

    def paint_sheet(self, layer: Layer) -> None:
        words = self.context.words
        sheet_title(layer, None, words("mat.refused"), ICE)
        sign(layer.glow, "robot", *ICON, 76, ALARM)
        y = write_lines(layer, words.sentence(self.reason), TEXT_X, HEAD + 56, ROOM, ICE)
        lost = self.reason.key in UNCALIBRATED
        write_lines(layer, words("mat.calibrate" if lost else "mat.anyway"), TEXT_X, y + 16, ROOM, MIST)


class UnplayablePage(BeforeMatchPage):
    """An arena cannot be played with the things on the mat: build again, or play without them. `again` and `without`
    make the match with the things, as they are then, and without.
    """

    hints = ((Button.FIRE, "things.hint_build"), (Button.X, "things.hint_without"), (Button.BACK, "mat.hint_leave"))

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None],
        again: Callable[[], Scene],
        without: Callable[[], Scene],
    ) -> None:
        super().__init__(context, setup, devices)
        self.again, self.without = again, without
        self.building = False

    def on_enter(self) -> None:
        if not self.building:
            super().on_enter()

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE builds again, X plays without the things."""
        match event.button:
            case Button.FIRE | Button.START:
                self.building = True
                self.context.sounds.play("accept")
                return Push(ArenaPage(self.context, lambda: self.devices))
            case Button.X:
                self.context.sounds.play("accept")
                return Swap(self.without())
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Try again after the arena was built."""
        return Swap(self.again()) if self.building else None

    def paint_sheet(self, layer: Layer) -> None:
        words = self.context.words
        title = arena_title(load_cached(self.setup.game, self.setup.arena), words.language)
        sheet_title(layer, None, words("things.in_the_way"), ICE)
        boxes(layer.glow, *ICON, ALARM)
        y = write_lines(layer, words("things.unplayable", arena=title), TEXT_X, HEAD + 56, ROOM, ICE)
        write_lines(layer, words("things.move_them"), TEXT_X, y + 16, ROOM, MIST)
