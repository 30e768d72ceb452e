"""How to play: four animated pictures per game with captions, and the buttons of the device used last."""

from collections.abc import Sequence

import pygame

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_words import FIRES, last_minutes, limits_line
from pigaming_app.scenes.flow.stack import Home, Pop, StackOperation
from pigaming_app.scenes.howto.lessons import LESSONS
from pigaming_app.ui.draw import (
    BLACK,
    BODY,
    ICE,
    LABEL,
    MIST,
    STEEL,
    button,
    button_width,
    panel,
    regular_polygon,
    text_width,
)
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, backdrop, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size, text, wrap, wrap_balanced
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.labels import black_out, button_label, chip, chip_width, heading

TOP, HIGH = 220, 620
CAPTION_Y, LIMITS_Y, FOOT_Y = TOP + 546, 884, 950
IDLE = 90.0  # seconds without input until the title
LEAVE = (Button.FIRE, Button.BACK, Button.START, Button.CLICK)


class HowTo:
    """The page of one game; left and right, or a click on a name, switch games, most other buttons leave."""

    def __init__(self, context: Context, game: str = "pitanks") -> None:
        self.context, self.game = context, game
        self.clock = 0.0

    def on_enter(self) -> None:
        """Restart the animations."""
        self.clock = 0.0

    def handle(self, event: InputEvent) -> StackOperation:
        """Switch games, or leave."""
        clicked = next((game for game, box in self._names() if event.at and box.collidepoint(event.at)), None)
        if event.button in (Button.LEFT, Button.RIGHT):
            games = list(LESSONS)
            self._show(games[(games.index(self.game) + (1 if event.button is Button.RIGHT else -1)) % len(games)])
        elif event.button is Button.CLICK and clicked:
            self._show(clicked)
        elif event.button in LEAVE:
            self.context.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> StackOperation:
        self.clock += seconds
        return Home() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        words = self.context.words
        screen.blit(backdrop(), (0, 0))
        heading(words("title.howto")).draw(screen)
        for game, box in self._names():
            chip(words(f"games.{game}"), box.w, "on" if game == self.game else "off").draw(screen, *box.topleft)
        button_label("<>").draw(screen, self._names()[0][1].left - 24 - button_width("<>"), 112)
        boxes = [pygame.Rect(span(3 * i, 3)[0], TOP, span(3 * i, 3)[1], HIGH) for i in range(4)]
        black_out(screen, *boxes)
        for i, (box, (name, picture)) in enumerate(zip(boxes, LESSONS[self.game].items(), strict=True)):
            screen.set_clip(box.inflate(-8, -8))
            key = picture(screen, box.centerx, TOP + 268, self.clock)
            screen.set_clip(None)
            frame(i + 1, box.w).draw(screen, *box.topleft)
            if key:
                text(words(key), LABEL, ICE, "head", "c", box.w - 40).draw(screen, box.centerx, TOP + 446)
            caption(words(f"howto.{name}"), box.w - 48).draw(screen, box.centerx, CAPTION_Y)
        limits = limits_line(words, self.game, last_minutes(self.context.settings, self.game))
        text(limits, BODY, ICE, "body", "l", RIGHT - LEFT).draw(screen, LEFT, LIMITS_Y)
        keys(self._keys()).draw(screen)

    def _show(self, game: str) -> None:
        if game != self.game:
            self.context.sounds.play("move")
            self.game, self.clock = game, 0.0

    def _names(self) -> list[tuple[str, pygame.Rect]]:
        """The games and the rectangles of their names, at the right end of the heading."""
        boxes, right = [], RIGHT
        for game in reversed(LESSONS):
            w = chip_width(self.context.words(f"games.{game}"))
            boxes.append((game, pygame.Rect(right - w, 80, w, 64)))
            right -= w + 16
        return boxes[::-1]

    def _keys(self) -> tuple[tuple[str, str], ...]:
        """(label, action) pairs for the device used last; the last pair is right-aligned."""
        words, controls = self.context.words, self.context.controls
        device = controls.last
        turbo = Button.LEAVE_SEAT if device.kind == "keys" else Button.BACK
        pairs = [
            (controls.moves(device) or "<>", words("howto.hint_drive")),
            (controls.label(device, turbo), words("howto.hint_turbo")),
            (controls.label(device, Button.BACK), words("howto.hint_back")),
        ]
        if self.game in FIRES:
            pairs.insert(1, (words.key_name(controls.label(device, Button.FIRE)), words(f"howto.{FIRES[self.game]}")))
        return tuple((label, action) for label, action in pairs if label)


@cached
@resumable
def frame(number: int, w: int) -> Steps[LitImage]:
    """An empty panel with its number; upper left corner at (0, 0)."""
    layer = Layer(0, 0, w, HIGH)
    panel(layer.glow, 0, 0, w, HIGH, STEEL)
    layer.glow.fill(regular_polygon(40, 32, 0, w / 2, 0), ICE)
    layer.glow.text(str(number), LABEL, w / 2, 0, BLACK, "hero", "c")
    yield
    return (yield from layer.render_steps())


@cached
def caption(sentence: str, room: int) -> LitImage:
    """A caption in lines of similar length, centred on (0, 0)."""
    lines = wrap_balanced(sentence, len(wrap(sentence, BODY, room)))
    layer = Layer(-room / 2, -70, room, 140)
    for i, line in enumerate(lines):
        size = fit_size(line, BODY, room, "body")
        layer.canvas.body(line, 0, 54 * (i - (len(lines) - 1) / 2), ICE, "c", size)
    return layer.render()


@cached
@resumable
def keys(items: Sequence[tuple[str, str]]) -> Steps[LitImage]:
    """The row at the foot: left-aligned, except for the last item at the right end."""
    layer = Layer(LEFT, FOOT_Y - 40, RIGHT - LEFT, 80)
    x: float = LEFT
    for i, (label, action) in enumerate(items):
        if i == len(items) - 1:
            x = RIGHT - _width(label) - 10 - text_width(action, BODY, "body")
        for part in label.split():
            x += button(layer.canvas, x, FOOT_Y, part) + 8
        layer.canvas.body(action, x + 10, FOOT_Y, MIST)
        x += 10 + text_width(action, BODY, "body") + 56
    yield
    return (yield from layer.render_steps())


def _width(label: str) -> float:
    return sum(button_width(part) + 8 for part in label.split())
