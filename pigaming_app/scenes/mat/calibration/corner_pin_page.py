"""Manual corner pin: move the corners of a grid onto the mat in steps of 1 or 10 px, with live preview.

The result is saved in the settings and applies to the whole arcade.
"""

import logging

import pygame

from pigaming_app.hardware.calibration.corner_pin import STRAIGHT, CornerPin, is_turned_over, pin_of, turned_over
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.storage.messages import OperatorError
from pigaming_app.ui.draw import (
    ALARM,
    BODY,
    FOCUS,
    HAIR,
    ICE,
    LABEL,
    LINE,
    MIST,
    STEEL,
    SUB,
    THIN,
    GlowCanvas,
    cut_box,
    dim,
    panel,
)
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import english, signed
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.button_prompts import ButtonPrompts
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.focus import DIRECTIONS

STEPS = (10, 1)  # px
CORNERS = ((0, 0), (1920, 0), (1920, 1080), (0, 1080))
BOX = pygame.Rect(460, 316, 1000, 420)  # the black box in the middle
CELL = 120  # px, grid spacing
MAX_OFFSET = 800  # px, limit of a corner's displacement

log = logging.getLogger("pigaming")


class CornerPinPage(Page):
    """The page. The previous pin is restored unless the new one is saved."""

    idle, stay = 600.0, 5.0
    prompts_y = BOX.bottom + 76
    hints = (
        (Button.FIRE, "pin.hint_next"),
        (Button.X, "pin.hint_step"),
        (Button.Y, "pin.hint_reset"),
        (Button.START, "pin.hint_save"),
        (Button.BACK, "pin.hint_back"),
    )

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.before = context.canvas.corners
        self.over = is_turned_over(self.before)  # as for a mirror; `corners` are those in the mirror
        self.corners = [round(value) for value in (turned_over(self.before) if self.over else self.before or STRAIGHT)]
        self.chosen = self.step = 0

    @property
    def prompts(self) -> ButtonPrompts:
        """The prompts, on a black plate."""
        return self.context.prompts(self.hints, self.prompts_y, solid=True)

    def on_enter(self) -> None:
        """Apply the pin; on failure, show the reason."""
        self._pin()

    def on_leave(self) -> None:
        """Discard unsaved changes."""
        self._restore()

    def press(self, event: InputEvent) -> StackOperation:
        """Directions move the corner; FIRE selects the next one."""
        match event.button:
            case Button.START:
                return self._save()
            case Button.FIRE:
                self.chosen = (self.chosen + 1) % 4
                self.context.sounds.play("move")
            case Button.X:
                self.step = 1 - self.step
                self.context.sounds.play("move")
            case Button.Y:
                self.corners, self.over = [round(value) for value in STRAIGHT], False
                self.context.sounds.play("accept")
                self._pin()
            case Button.CLICK if event.at:
                self._select(event.at)
            case button if button in DIRECTIONS:
                self._move(*DIRECTIONS[button])
        return None

    def show(self, screen: pygame.Surface) -> None:
        """Draw the grid and the selected corner."""
        words, x, y = self.context.words, BOX.centerx, BOX.y
        screen.blit(grid(), (0, 0))
        handle(self.chosen).draw(screen)
        text(words("pin.title", corner=self.chosen + 1), SUB, FOCUS, "head").draw(screen, x, y + 76)
        text(words("pin.how"), BODY, ICE, "body", room=BOX.w - 60).draw(screen, x, y + 164)
        across, down = (self.corners[2 * self.chosen + i] - CORNERS[self.chosen][i] for i in (0, 1))
        text(words("pin.at", x=signed(across), y=signed(down)), LABEL, ICE, "head", room=BOX.w - 60).draw(
            screen, x, y + 252
        )
        text(words("pin.step", step=STEPS[self.step]), LABEL, MIST, "head").draw(screen, x, y + 340)

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the message above the box."""
        if self.message:
            caption(self.message, ALARM, size=32).draw(screen, 960, BOX.y - 70)
        self.prompts.draw(screen)

    def _move(self, across: int, down: int) -> None:
        """Move the corner, unless the pin would become invalid."""
        previous, step = list(self.corners), STEPS[self.step]
        for i, delta in ((0, across * step), (1, down * step)):
            corner = CORNERS[self.chosen][i]
            moved = self.corners[2 * self.chosen + i] + delta
            self.corners[2 * self.chosen + i] = min(corner + MAX_OFFSET, max(corner - MAX_OFFSET, moved))
        if not self._pin():
            self.corners = previous

    def _select(self, at: tuple[float, float]) -> None:
        """Select the corner of the clicked quadrant."""
        right, low = at[0] > 960, at[1] > 540
        self.chosen = (2 if right else 3) if low else int(right)
        self.context.sounds.play("move")

    def _pin(self) -> bool:
        """Apply the pin; on failure, show the reason and return false."""
        try:
            self.context.canvas.pin(pin_of(turned_over(self.corners) if self.over else self.corners))
            return True
        except OperatorError as trouble:
            log.warning("%s", english().long_sentence(trouble.message))
            self.show_message(self.context.words.sentence(trouble.message), wrong=True)
            self.context.sounds.play("back")
            return False

    def _restore(self) -> None:
        try:
            self.context.canvas.pin(CornerPin(self.before) if self.before else None)
        except OperatorError as trouble:
            log.warning("%s", english().long_sentence(trouble.message))

    def _save(self) -> StackOperation:
        """Save the pin, or show that it could not be saved."""
        canvas, settings = self.context.canvas, self.context.settings
        settings.corners = [round(value) for value in canvas.corners]
        if not self.save():
            self.context.sounds.play("back")
            return None
        self.before = canvas.corners
        self.context.sounds.play("accept")
        return Pop()


@cached
@resumable
def grid() -> Steps[pygame.Surface]:
    """A full-screen grid, the edge of the arena, and a black box in the middle."""
    layer = Layer(0, 0, 1920, 1080)
    for x in range(0, 1921, CELL):
        layer.canvas.crisp.line([(x, 0), (x, 1080)], dim(ICE, 0.35), HAIR)
    yield
    for y in range(0, 1081, CELL):
        layer.canvas.crisp.line([(0, y), (1920, y)], dim(ICE, 0.35), HAIR)
    layer.canvas.crisp.line(cut_box(3, 3, 1914, 1074, 0), ICE, LINE, True)
    layer.canvas.crisp.line(cut_box(LEFT, TOP, WIDTH, HEIGHT, 28), STEEL, THIN, True)
    yield
    light = yield from layer.render_steps()
    surface = pygame.Surface((1920, 1080))
    light.draw(surface)
    yield
    pygame.draw.polygon(surface, (0, 0, 0), cut_box(BOX.x, BOX.y, BOX.w, BOX.h, 28))
    frame = Layer(*BOX)
    panel(frame.glow, BOX.x, BOX.y, BOX.w, BOX.h, STEEL, LINE, 28)
    light = yield from frame.render_steps()
    light.draw(surface)
    return surface


@cached
def handle(corner: int) -> LitImage:
    """Mark of the selected corner: a bright angle and an arrow pointing to it."""
    x, y = CORNERS[corner]
    across, down = (-1 if x else 1), (-1 if y else 1)  # from the corner into the picture
    layer = Layer(x - 300 * (across < 0), y - 300 * (down < 0), 300, 300)
    ink: GlowCanvas = layer.glow
    for width, reach in ((THIN, 20), (14, 8)):
        ends = [(x + across * 240, y + down * reach), (x + across * reach, y + down * reach)]
        ink.line([*ends, (x + across * reach, y + down * 240)], FOCUS, width)
    ink.line([(x + across * 60, y + down * 60), (x + across * 170, y + down * 170)], FOCUS, LINE)
    ink.line(
        [(x + across * 130, y + down * 60), (x + across * 60, y + down * 60), (x + across * 60, y + down * 130)],
        FOCUS,
        LINE,
    )
    return layer.render()
