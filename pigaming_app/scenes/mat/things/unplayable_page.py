"""Page before a match whose arena cannot be played with the things on the mat: build again, or play without them."""

from collections.abc import Callable, Sequence

from pigaming_app.games.game import Setup
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_choice import arena_title, load_cached
from pigaming_app.scenes.flow.stack import Push, Scene, StackOperation, Swap
from pigaming_app.scenes.mat.things.arena_page import ArenaPage
from pigaming_app.scenes.mat.things.outlines import boxes
from pigaming_app.scenes.pages.sheet import Sheet
from pigaming_app.scenes.play.pause import sheet_title
from pigaming_app.ui.draw import ALARM, ICE, MIST
from pigaming_app.ui.draw.layers import Layer
from pigaming_app.ui.draw.text import write_lines
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.dialog import HEAD, ICON, ROOM, TEXT_X


class UnplayablePage(Sheet):
    """The page. `again` and `without` make the match with the things, as they are then, and without."""

    color = ALARM
    hints = ((Button.FIRE, "things.hint_build"), (Button.X, "things.hint_without"), (Button.BACK, "mat.hint_leave"))

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None],
        again: Callable[[], Scene],
        without: Callable[[], Scene],
    ) -> None:
        self.setup, self.devices, self.again, self.without = setup, devices, again, without
        self.building = False
        self.access = Access(context, lambda: self.devices)
        super().__init__(context, gate=self.access)

    def on_enter(self) -> None:
        if not self.building:
            self.context.sounds.play("error")

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
