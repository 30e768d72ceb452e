"""The sweep: pictures of fringes full screen and nothing else, then the computation on a dark mat."""

import math
from collections.abc import Callable

import pygame

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.scan.patterns import Pattern
from pigaming_app.hardware.scan.rig_scan import RigScan
from pigaming_app.hardware.scan.things import ThingLayout
from pigaming_app.hardware.session.robot_session import RobotSession
from pigaming_app.hardware.session.things_on_mat import with_choices
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.views.sprites.effects import timer_ring
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, LINE
from pigaming_app.ui.draw.layers import text
from pigaming_app.ui.draw.pixels import grey_surface
from pigaming_app.ui.input.events import Button

CENTRE = 960, 540
STEPS = 48  # of the ring


class SweepPage(Page):
    """One scan. `advance`: advances the session, or a match whose robots stand, by some seconds.

    `done` gets the result: a layout in which the operator's choices are kept, or a fault.
    """

    idle = math.inf
    prompts_y, closing = 1020, (Button.START, Button.STOP)
    hints = ((Button.BACK, "things.hint_stop"),)

    def __init__(
        self,
        context: Context,
        session: RobotSession,
        rig: Rig,
        before: ThingLayout,
        advance: Callable[[float], object],
        done: "Callable[[RigScan, ThingLayout | None], None]",
    ) -> None:
        assert session.ground is not None
        super().__init__(context)
        self.session, self.before, self.advance_rig, self.done = session, before, advance, done
        self.work = RigScan(rig, session.ground, before)
        self._pattern: Pattern | None = None
        self._picture = pygame.Surface((1920, 1080))

    def on_enter(self) -> None:
        self.context.hush()

    def on_leave(self) -> None:
        """End the scan."""
        self.work.close()

    def advance(self, seconds: float) -> StackOperation:
        """Follow the scan; hand over its result."""
        self.context.idle = 0.0
        self.advance_rig(seconds)
        self.work.step()
        scan = self.work.scan
        if not scan.finished:
            return None
        if scan.layout is None:
            self.context.sounds.play("error")
            self.done(self.work, None)
        else:
            self.session.expected = scan.expected
            self.context.sounds.play("accept")
            self.done(self.work, with_choices(scan.layout, self.before))
        return Pop()

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the pattern, or the progress of the computation."""
        pattern = self.work.scan.pattern
        if pattern is None:
            self._draw_progress(screen)
            return
        if pattern is not self._pattern:
            self._pattern, self._picture = pattern, grey_surface(pattern.picture())
        screen.blit(self._picture, (0, 0))
        self.work.scan.mark_shown(pattern)

    def _draw_progress(self, screen: pygame.Surface) -> None:
        screen.fill((0, 0, 0))
        image, dx, dy = timer_ring(FOCUS, math.ceil(STEPS * self.work.scan.progress), 60, LINE)
        screen.blit(image, (CENTRE[0] + dx, CENTRE[1] + dy), special_flags=pygame.BLEND_RGB_ADD)
        text(self.context.words("things.computing"), LABEL, ICE, "body", "c", 1700).draw(screen, 960, CENTRE[1] + 130)
        self.prompts.draw(screen)
