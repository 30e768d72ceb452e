"""A page: backdrop, heading, button prompts, messages, the way back and the time without input.

Pages inherit from `Page`, describe themselves by its class attributes, and add their content and their buttons.
"""

import logging
from collections.abc import Callable, Sequence

import pygame

from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Context, Home, Pop, StackOperation
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import ALARM, BODY, FOCUS
from pigaming_app.ui.draw.layers import LEFT, RIGHT, LitImage, backdrop, fit_size
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.button_prompts import ROOM, ButtonPrompts
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.focus import DIRECTIONS, Focus, FocusSpot
from pigaming_app.ui.widgets.labels import heading

Hints = Sequence[tuple[Button, str]]
MESSAGE_ROOM = RIGHT - LEFT - 60  # px
NOWHERE = FocusSpot("", pygame.Rect(0, 0, 0, 0))
log = logging.getLogger("pigaming")


class Page:
    """A scene with a heading and prompts. `focus`: of its elements; `gate`: decides who may press, else everybody."""

    title = ""  # key of the heading
    idle = 90.0  # s without input
    when_idle: StackOperation = Home()  # after them
    stay = 4.0  # s for which a message is shown
    prompts_y, prompts_room = 980, ROOM  # px
    closing: Sequence[Button] = ()  # buttons that leave, besides BACK
    lockout = 0.0  # s after opening in which only directions count: players may still hammer

    def __init__(self, context: Context, focus: Focus | None = None, gate: Access | None = None) -> None:
        self.context, self.focus, self.gate = context, focus or Focus([NOWHERE]), gate
        self.age = 0.0  # s since it was opened
        self.untouched = 0.0  # s since it was opened or got an input
        self.wrong = False  # the message is bad news
        self._message, self._message_left = "", 0.0

    # ---- of the page

    @property
    def hints(self) -> Hints:
        """Buttons and the keys of their texts."""
        raise NotImplementedError

    @property
    def heading(self) -> LitImage:
        """The heading, with the subtitle at its right end."""
        return heading(self.context.words(self.title), self.subtitle)

    @property
    def subtitle(self) -> str:
        """The text beside the heading."""
        return ""

    @property
    def resting(self) -> float:
        """s without input: since the last one anywhere, if the page does not count for itself."""
        return self.context.idle

    def press(self, event: InputEvent) -> StackOperation:
        """Act on an input other than BACK: move the focus, or do what it activates."""
        if self.focus.handle(event):
            self.context.sounds.play("move")
        chosen = self.focus.activated(event)
        return self.choose(chosen, event) if chosen else None

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        """Act on the element that was activated."""
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Advance what moves on the page, by `seconds` of real time."""
        return None

    def paint(self, screen: pygame.Surface) -> None:
        """Draw what lies between heading and prompts."""

    # ---- scene

    def on_enter(self) -> None:
        """Nothing to do."""

    def handle(self, event: InputEvent) -> StackOperation:
        """BACK leaves; other inputs are up to the page."""
        self.untouched = 0.0
        if self.age < self.lockout and event.button not in (*DIRECTIONS, Button.POINT):
            return None
        admitted: InputEvent | None = self.prompts.as_button(event)
        if self.gate and admitted:
            admitted = self.gate.admit(admitted)
        if admitted is None:
            return None
        leaves = admitted.button is Button.BACK or admitted.button in self.closing
        return self.leave() if leaves else self.press(admitted)

    def update(self, seconds: float) -> StackOperation:
        """Animate; leave after a while without input."""
        self.age += seconds
        self.untouched += seconds
        self._message_left -= seconds
        self.focus.update(seconds)
        if self.gate and self.gate.update(seconds):
            return self.leave()
        return self.advance(seconds) or (self.when_idle if self.resting > self.idle else None)

    def draw(self, screen: pygame.Surface) -> None:
        self.show(screen)
        self.draw_foot(screen)

    def show(self, screen: pygame.Surface) -> None:
        """Draw it without what only a visitor needs."""
        screen.blit(backdrop(), (0, 0))
        self.heading.draw(screen)
        self.paint(screen)

    # ---- parts

    @property
    def prompts(self) -> ButtonPrompts:
        """The prompts, for the device that may act."""
        gate = self.gate
        device = (lambda: gate.hint_device) if gate else None
        return self.context.prompts(self.hints, self.prompts_y, self.prompts_room, device=device)

    @property
    def message(self) -> str:
        """The visible message; empty if there is none."""
        return self._message if self._message_left > 0.0 else ""

    def show_message(self, message: str, wrong: bool = False) -> None:
        """Show a message for a while."""
        self._message, self._message_left, self.wrong = message, self.stay, wrong

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the message in place of the prompts, or the prompts."""
        message, color = self.message, ALARM if self.wrong else FOCUS
        if message:
            fitting = fit_size(message, BODY, MESSAGE_ROOM, "body")
            caption(message, color, size=fitting if fitting < BODY else 0).draw(screen, 960, self.prompts_y)
        else:
            self.prompts.draw(screen)

    def leave(self) -> StackOperation:
        """Go back, with its sound."""
        self.context.sounds.play("back")
        return Pop()

    def save(self, write: Callable[[], object] | None = None) -> bool:
        """Save the settings, or what `write` saves; true if they are saved, else a message says so."""
        try:
            write() if write else self.context.settings.save(folders().config)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.show_message(self.context.words("app.unsaved"), wrong=True)
            return False
        return True
