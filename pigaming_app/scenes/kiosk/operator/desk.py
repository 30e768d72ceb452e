"""What the operator has on every screen: F2 changes the second screen, F10 opens the operator's page; the time limit
of a group, after whom the house's choices return.
"""

import logging
from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import pygame

from pigaming_app.scenes.features.feature import Service
from pigaming_app.scenes.flow.access import Right, Roles
from pigaming_app.scenes.flow.scene import Context, Push, Scene, Stack
from pigaming_app.scenes.guard import Guard
from pigaming_app.scenes.kiosk.operator.group_limit import GroupLimit
from pigaming_app.scenes.kiosk.scoreboard.pages import Pages
from pigaming_app.ui.draw import FOCUS, ICE
from pigaming_app.ui.draw.layers import fit_size
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.notices import MAX_WIDTH

if TYPE_CHECKING:
    from pigaming_app.scenes.kiosk.scoreboard.window import ScoreboardWindow

LOOK = 1.0  # s between two looks for displays
WAITED = 60.0  # s without a press on the title, or in attract mode, until the house's choices return
KEYBOARD = Device("keys")
SIZE, SENTENCE_Y = 34, 1047  # px, of what a group is told: below the row of prompts
MOUSE = (pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEWHEEL)

log = logging.getLogger("pigaming")


@runtime_checkable
class Waiting(Protocol):
    """A scene before anybody plays: title and attract mode."""

    waits: bool


class OperatorDesk(Service):
    """`scoreboard`: the display of the second screen, from 1, instead of that of the settings;
    `limited`: groups have a time limit.
    """

    def __init__(self, context: Context, scoreboard: int | None, limited: bool) -> None:
        self.context, self.notices, self.limited = context, context.notices, limited
        self.board, self.roles = context.shared(Pages), context.shared(Roles)
        self.limit = GroupLimit(context)
        self.held: float | None = None  # s for which F10 has been held
        self.window: ScoreboardWindow | None = None
        self.applied = context.settings.scoreboard
        self.displays: list[tuple[int, int]] = []  # their sizes, px
        self.arena_moved = False  # by the system, as its display is gone
        self.looked = 0.0  # s since the last look at them
        self.dismissed = False  # closed by its close button
        self.returned = False  # the house's choices, since the last press
        self.number = 0  # of the display of the second screen; 0: none
        self._open(context.settings.scoreboard if scoreboard is None else scoreboard)

    def filter(self, events: Sequence[pygame.Event], scenes: Sequence[Scene]) -> list[pygame.Event]:
        """The events for the arcade: without the mouse over the second screen. Handles the operator's keys."""
        for event in events:
            if event.type == pygame.KEYDOWN and event.key == pygame.K_F2:
                if self.roles.may(KEYBOARD, Right.OPERATE):
                    self._next_page(scenes)
            elif event.type == pygame.KEYDOWN and event.key == pygame.K_F10:
                self.held = 0.0
            elif event.type == pygame.KEYUP and event.key == pygame.K_F10:
                self.held = None
        window = self.window
        return [event for event in events if not (window and event.type in MOUSE and window.owns(event))]

    def update(self, seconds: float, stack: Stack) -> None:
        """Advance the timers by `seconds`; may open the operator's page or return to the title."""
        if not stack.scenes:
            return
        if self.held is not None:
            self.held += seconds
            if self.held >= self.roles.hold:
                self.held = None
                self._open_page(stack)
        if self.context.kiosk and not self.context.settings.pin_asked and len(stack.scenes) == 1 and self.limited:
            self._offer_pin(stack)
        if self.limited:
            stack.apply(self.limit.update(seconds, stack.scenes))
            self._return_to_house(stack.scenes)

    def draw(self, screen: pygame.Surface) -> None:
        """Draw what a group is told, unless a notice is in its place."""
        sentence = self.limit.sentence if self.limited else ""
        if sentence and not self.notices.waiting:
            size = fit_size(sentence, SIZE, MAX_WIDTH - 2 * SIZE, "body")
            caption(sentence, FOCUS, ICE, size, sign="clock").draw(screen, 960, SENTENCE_Y)

    def show(self, seconds: float, left: float, scenes: Sequence[Scene]) -> None:
        """Follow the settings and draw a slice of the second screen; `left`: s that are left of this frame."""
        if self.context.settings.scoreboard != self.applied:
            self.applied = self.context.settings.scoreboard
            self._open(self.applied)
        self.looked += seconds
        if self.number and not self.dismissed and self.looked >= LOOK:
            self._follow_displays()
        if self.window and scenes:
            whole = not self.window.trouble
            self.window.update(seconds, left, self.board.chosen, scenes)
            if whole and self.window.trouble:
                self.notices.add(self.context.words("scoreboard.none"))

    def close_if_requested(self, event: pygame.Event) -> bool:
        """Close the second screen if an event requests it; true if so."""
        closed = self.window is not None and self.window.close_if_requested(event)
        self.dismissed = self.dismissed or closed
        return closed

    @property
    def has_window(self) -> bool:
        return self.window is not None

    def close(self) -> None:
        if self.window:
            self.window.close()

    def _open(self, number: int) -> None:
        """Open the second screen on a display, from 1, in place of the one before; 0: none."""
        self.close()
        self.window, self.number, self.dismissed = None, number, False
        if not number:
            return
        self.displays = pygame.display.get_desktop_sizes()
        from pigaming_app.scenes.kiosk.scoreboard.window import ScoreboardWindow

        canvas = self.context.canvas
        self.window = ScoreboardWindow(number, canvas.display, self.board.pages, canvas.headless)
        if self.window.trouble:
            self.notices.add(self.context.words("scoreboard.none"))

    def _follow_displays(self) -> None:
        """After a display was plugged or unplugged: fill the own one, or close rather than cover the arena."""
        self.looked = 0.0
        canvas, displays = self.context.canvas, pygame.display.get_desktop_sizes()
        if displays == self.displays or canvas.headless:
            return
        self.displays = displays
        there = canvas.display < len(displays)
        if there and self.arena_moved:
            canvas.show(canvas.display, canvas.fullscreen)
        self.arena_moved = not there
        from pigaming_app.scenes.kiosk.scoreboard.window import has_display

        if has_display(self.number, canvas.display, canvas.headless):
            self._open(self.number)
        elif self.window and self.window.window and self.window.fills:
            log.warning("The display of the second screen is gone.")
            self.window.close()
            self.notices.add(self.context.words("scoreboard.none"))

    def _return_to_house(self, scenes: Sequence[Scene]) -> None:
        """Give up the visitors' rules, arenas and language once nobody has pressed anything for a while."""
        context = self.context
        waiting = context.idle >= WAITED and all(isinstance(scene, Waiting) and scene.waits for scene in scenes)
        if waiting and not self.returned:
            context.settings.return_to_house()
            context.words.switch(context.settings.language)
        self.returned = waiting

    def _next_page(self, scenes: Sequence[Scene]) -> None:
        """Choose the next page that has something to show. A window that was closed opens again, with the same page."""
        if self.window and self.window.window is None:
            self._open(self.number)
            return
        pages = [page for page in self.board.pages if page.parts(scenes) is not None]
        names = [page.name for page in pages]
        if self.window is None or self.window.window is None or not names:
            return
        at = names.index(self.board.chosen) if self.board.chosen in names else -1
        self.board.chosen = names[(at + 1) % len(names)]
        self.notices.add(self.context.words(f"scoreboard.shows_{self.board.chosen}"))

    def _offer_pin(self, stack: Stack) -> None:
        """On the first title of a kiosk, its operator may set a PIN."""
        self.context.settings.pin_asked = True
        if not self.roles.pin.is_set:
            from pigaming_app.scenes.pages.pin_page import NewPinPage

            stack.apply(Push(NewPinPage(self.context, first=True)))

    def _open_page(self, stack: Stack) -> None:
        from pigaming_app.scenes.kiosk.operator.page import OperatorPage

        if not any(isinstance(scene, OperatorPage) for scene in stack.scenes):
            self.context.sounds.play("accept")
            page = Push(OperatorPage(self.context, tuple(stack.scenes)))
            stack.apply(Guard(self.context).checked(page, KEYBOARD))
