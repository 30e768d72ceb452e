"""Button prompts: the row at the foot of a page, labelled for the device used last, and clickable."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import pygame

from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import SMALLEST, Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent

ROOM = 1760  # px, width of the row
GAPS = (56, 44, 32, 24)
HIGH = 34  # px from the middle of the row to the edge of the clickable area


class ButtonPrompts:
    """A row of (button, text key), centred at y px of the canvas, at most `room` px wide.

    `solid`: draw the row on a black plate. `device`: the device whose buttons are shown, if not the one used last.
    """

    def __init__(
        self,
        words: Words,
        controls: Controls,
        items: Sequence[tuple[Button, str]],
        y: int = 980,
        room: int = ROOM,
        solid: bool = False,
        device: Callable[[], Device] | None = None,
    ) -> None:
        self.words, self.controls = words, controls
        self.items, self.y, self.room, self.solid, self.device = tuple(items), y, room, solid, device

    @property
    def labels(self) -> tuple[tuple[str, str], ...]:
        """The current (label, text) pairs; buttons the device lacks are left out."""
        words = self.words
        return tuple(
            (words.key_name(self._label(action)), words(key)) for action, key in self.items if self._label(action)
        )

    @property
    def buttons(self) -> list[Button]:
        """The buttons of the visible prompts."""
        return [action for action, _ in self.items if self._label(action)]

    def as_button(self, event: InputEvent) -> InputEvent:
        """A click on a prompt as a press of its button; any other event unchanged."""
        if event.button is not Button.CLICK or event.at is None or abs(event.at[1] - self.y) > HIGH:
            return event
        for action, (left, right) in zip(self.buttons, places(self.labels, self.room), strict=True):
            if left <= event.at[0] <= right:
                return replace(event, button=action)
        return event

    def draw(self, screen: pygame.Surface) -> None:
        if self.solid:
            ends = places(self.labels, self.room)
            outline = kit.cut_box(ends[0][0] - 40, self.y - 46, ends[-1][1] - ends[0][0] + 80, 92)
            pygame.draw.polygon(screen, kit.BLACK, outline)
            pygame.draw.polygon(screen, kit.STEEL, outline, kit.THIN)
        row(self.labels, self.y, self.room).draw(screen)

    def _label(self, button: Button) -> str:
        """The button's label; "<>" for RIGHT, which stands for left and right."""
        return "<>" if button is Button.RIGHT else self.controls.label(self.device() if self.device else None, button)


def places(prompts: Sequence[tuple[str, str]], room: int) -> list[tuple[float, float]]:
    """Left and right end of each prompt, px."""
    size = type_size(prompts, room)
    widths = _widths(prompts, size)
    fitting = [gap for gap in GAPS if sum(widths) + gap * (len(widths) - 1) <= room]
    gap = fitting[0] if fitting else GAPS[-1]
    x, ends = (1920 - sum(widths) - gap * (len(widths) - 1)) / 2, []
    for width in widths:
        ends.append((x, x + width))
        x += width + gap
    return ends


def type_size(prompts: Sequence[tuple[str, str]], room: int) -> int:
    """The size of the texts, px: the readable one if the row has room for it, else the largest that has."""
    gaps = GAPS[-1] * (len(prompts) - 1)
    sizes = [kit.readable(kit.BODY), *range(kit.BODY, SMALLEST, -2), SMALLEST]
    return next((size for size in sizes if sum(_widths(prompts, size)) + gaps <= room), SMALLEST)


def _widths(prompts: Sequence[tuple[str, str]], size: int) -> list[float]:
    """The width of each prompt, px; the labels of buttons are at most of size BODY."""
    return [
        kit.button_width(label, min(size, kit.BODY)) + 18 + kit.text_width(text, size, "body")
        for label, text in prompts
    ]


@cached
@resumable
def row(prompts: tuple[tuple[str, str], ...], y: int, room: int) -> Steps[LitImage]:
    """The rendered row."""
    ends, size = places(prompts, room), type_size(prompts, room)
    layer = Layer(ends[0][0], y - HIGH, ends[-1][1] - ends[0][0], 2 * HIGH)
    for (label, text), (left, _) in zip(prompts, ends, strict=True):
        wide = kit.button(layer.canvas, left, y, label, size=min(size, kit.BODY))
        layer.canvas.body(text, left + wide + 18, y, kit.MIST, "l", size)
    return (yield from layer.render_steps())
