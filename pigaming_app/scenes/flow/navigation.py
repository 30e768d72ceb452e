"""Navigation of a page with a list of choices: focus, prompts, a fading sentence, and the ways out."""

from collections.abc import Callable, Sequence

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Home, Pop, StackOperation
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.button_prompts import ROOM
from pigaming_app.ui.widgets.focus import Focus


class Navigation:
    """Part of a page. `idle`: seconds without input until the title; `stay`: seconds for which a sentence is shown;
    `room`: px for the prompts.
    """

    def __init__(
        self,
        context: Context,
        focus: Focus,
        hints: Sequence[tuple[Button, str]],
        idle: float,
        stay: float = 0.0,
        device: Callable[[], Device] | None = None,
        room: int = ROOM,
    ) -> None:
        self.context, self.focus, self.idle, self.stay = context, focus, idle, stay
        self.prompts = context.prompts(hints, room=room, device=device)
        self._sentence, self._remaining = "", 0.0

    @property
    def sentence(self) -> str:
        """The visible sentence; empty if there is none."""
        return self._sentence if self._remaining > 0.0 else ""

    def show_message(self, sentence: str) -> None:
        """Show a sentence for a while."""
        self._sentence, self._remaining = sentence, self.stay

    def handle(self, event: InputEvent) -> StackOperation:
        """BACK leaves the page; directions and the mouse move the focus."""
        if event.button is Button.BACK:
            self.context.sounds.play("back")
            return Pop()
        if self.focus.handle(event):
            self.context.sounds.play("move")
        return None

    def update(self, seconds: float) -> StackOperation:
        """Animate; return to the title after a while without input."""
        self.focus.update(seconds)
        self._remaining -= seconds
        return Home() if self.context.idle > self.idle else None
