"""Reason page when a match cannot have real robots: retry, or play with simulated ones."""

from collections.abc import Collection, Sequence

from pigaming_app.games.game import Setup
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import StackOperation, Swap
from pigaming_app.scenes.mat.fault_icons import sign
from pigaming_app.scenes.mat.robots.interrupted import MatchOf
from pigaming_app.scenes.pages.sheet import Sheet
from pigaming_app.scenes.play.pause import sheet_title
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.draw import ALARM, ICE, MIST
from pigaming_app.ui.draw.layers import Layer
from pigaming_app.ui.draw.text import write_lines
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.dialog import HEAD, ICON, ROOM, TEXT_X

UNCALIBRATED = ("none", "damaged", "changed", "version", "other_display")  # messages that require calibration


class UnavailablePage(Sheet):
    """The page. `message`: the reason; `match_of`: match factory for a set of real seats."""

    color = ALARM
    hints = ((Button.FIRE, "mat.hint_simulated"), (Button.X, "mat.hint_again"), (Button.BACK, "mat.hint_leave"))

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None],
        real: Collection[int],
        message: OperatorMessage,
        match_of: MatchOf,
    ) -> None:
        self.setup, self.devices, self.real, self.reason = setup, devices, real, message
        self.match_of = match_of
        self.access = Access(context, lambda: self.devices)
        super().__init__(context, gate=self.access)

    def on_enter(self) -> None:
        self.context.sounds.play("error")

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
