"""What the operator has on every screen: F2 changes the second screen, F10 opens the operator's page; the time limit
of a group.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import pygame

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Push, Scene, Stack
from pigaming_app.scenes.operator.group_limit import GroupLimit
from pigaming_app.ui.draw import FOCUS, ICE
from pigaming_app.ui.draw.text import fit_size
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.notices import MAX_WIDTH, Notices

if TYPE_CHECKING:
    from pigaming_app.scenes.scoreboard.window import ScoreboardWindow

HOLD, HOLD_IN_KIOSK = 1.0, 5.0  # s for which F10 is held
SIZE, SENTENCE_Y = 34, 1047  # px, of what a group is told: below the row of prompts
MOUSE = (pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEWHEEL)


class OperatorDesk:
    """Part of the arcade. `scoreboard`: the display of the second screen, from 1, instead of that of the settings;
    `limited`: groups have a time limit.
    """

    def __init__(self, context: Context, notices: Notices, scoreboard: int | None, limited: bool) -> None:
        self.context, self.notices, self.limited = context, notices, limited
        self.limit = GroupLimit(context)
        self.held: float | None = None  # s for which F10 has been held
        self.window: ScoreboardWindow | None = None
        self.applied = context.settings.scoreboard
        self._open(context.settings.scoreboard if scoreboard is None else scoreboard)

    def filter(self, events: Sequence[pygame.Event], scenes: Sequence[Scene]) -> list[pygame.Event]:
        """The events for the arcade: without the mouse over the second screen. Handles the operator's keys."""
        for event in events:
            if event.type == pygame.KEYDOWN and event.key == pygame.K_F2:
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
            if self.held >= (HOLD_IN_KIOSK if self.context.kiosk else HOLD):
                self.held = None
                self._open_page(stack)
        if self.limited:
            stack.apply(self.limit.update(seconds, stack.scenes))

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
        if self.window and scenes:
            self.window.update(seconds, left, self.context.board_page, scenes)

    def close_if_requested(self, event: pygame.Event) -> bool:
        """Close the second screen if an event requests it; true if so."""
        return self.window is not None and self.window.close_if_requested(event)

    def close(self) -> None:
        if self.window:
            self.window.close()

    def _open(self, number: int) -> None:
        """Open the second screen on a display, from 1, in place of the one before; 0: none."""
        self.close()
        self.window = None
        if not number:
            return
        from pigaming_app.scenes.scoreboard.pages import complete
        from pigaming_app.scenes.scoreboard.window import ScoreboardWindow

        canvas = self.context.canvas
        complete(self.context)
        self.window = ScoreboardWindow(number, canvas.display, self.context.board_pages, canvas.headless)
        if self.window.trouble:
            self.notices.add(self.context.words("scoreboard.none"))

    def _next_page(self, scenes: Sequence[Scene]) -> None:
        """Choose the next page that has something to show."""
        pages = [page for page in self.context.board_pages if page.parts(scenes) is not None]
        names = [page.name for page in pages]
        if self.window is None or self.window.window is None or not names:
            return
        at = names.index(self.context.board_page) if self.context.board_page in names else -1
        self.context.board_page = names[(at + 1) % len(names)]
        self.notices.add(self.context.words(f"scoreboard.shows_{self.context.board_page}"))

    def _open_page(self, stack: Stack) -> None:
        from pigaming_app.scenes.operator.page import OperatorPage

        if not any(isinstance(scene, OperatorPage) for scene in stack.scenes):
            self.context.sounds.play("accept")
            stack.apply(Push(OperatorPage(self.context, tuple(stack.scenes))))
