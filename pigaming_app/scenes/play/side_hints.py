"""Hints in the margins beside the arena, stacked, so that they cover no part of a match."""

from dataclasses import replace

import pygame

from pigaming_app.scenes.views.background import LEFT
from pigaming_app.sim.world import WIDTH
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, THIN, Color, button, button_width, cut_box, text_width
from pigaming_app.ui.draw.layers import Layer, LitImage, wrap
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.button_prompts import ButtonPrompts

ROOM = 136  # px of the 160 px between the arena and the edge of the picture
X = LEFT + WIDTH + (1920 - LEFT - WIDTH) // 2  # middle of the right margin; the left one is at 1920 - X
TOP, LINE, GAP = 170, 50, 44  # px, before scaling: top of the column, line pitch, gap between hints
MAX_LABEL, LABEL_PITCH = 7, 42  # letters of a label on one line; px from one line of a longer one to the next
MAX_LINE = 230  # px, length of a line before scaling
MAX_SCALE = 0.8  # maximum scale, relative to hints elsewhere


class SideHints:
    """The hints of `prompts` in the right margin."""

    def __init__(self, prompts: ButtonPrompts) -> None:
        self.prompts = prompts

    def as_button(self, event: InputEvent) -> InputEvent:
        """A click on a hint as a press of its button, LEFT on the left half of "<>"; any other event unchanged."""
        if event.button is not Button.CLICK or event.at is None:
            return event
        for hint_button, box in zip(self.prompts.buttons, boxes(self.prompts.labels), strict=True):
            if box.collidepoint(event.at):
                left = hint_button is Button.RIGHT and event.at[0] < box.centerx
                return replace(event, button=Button.LEFT if left else hint_button)
        return event

    def draw(self, screen: pygame.Surface) -> None:
        """Draw them in place of signs in the margin."""
        places = boxes(self.prompts.labels)
        screen.fill("black", places[0].union(places[-1]))
        column(self.prompts.labels).draw(screen)


def boxes(prompts: tuple[tuple[str, str], ...]) -> list[pygame.Rect]:
    """The rectangle of each hint."""
    k, y, rects = scale_to_fit(prompts), float(TOP), []
    for label, text in prompts:
        high = k * (key_size(label)[1] + LINE * len(wrap(text, BODY, MAX_LINE)))
        rects.append(pygame.Rect(X - ROOM // 2, round(y), ROOM, round(high)))
        y += high + k * GAP
    return rects


def scale_to_fit(prompts: tuple[tuple[str, str], ...]) -> float:
    """The scale at which the widest hint fits."""
    lines = [text_width(line, BODY, "body") for _, text in prompts for line in wrap(text, BODY, MAX_LINE)]
    labels = [key_size(label)[0] for label, _ in prompts]
    return min(MAX_SCALE, ROOM / max(*lines, *labels))


def _label_lines(label: str) -> list[str]:
    """The lines of a label on a key; a long one is broken at its space, or in the middle with a hyphen."""
    if len(label) <= MAX_LABEL:
        return [label]
    half, parts = len(label) // 2, label.split(" ", 1)
    return parts if max(map(len, parts)) <= MAX_LABEL else [f"{label[:half]}-", label[half:]]


def key_size(label: str) -> tuple[float, int]:
    """Width and height of a key with its label, px before scaling."""
    lines = _label_lines(label)
    return max(map(button_width, lines)), 60 + LABEL_PITCH * (len(lines) - 1)


@cached
def column(prompts: tuple[tuple[str, str], ...]) -> LitImage:
    """The rendered column: each button above its text."""
    k, places = scale_to_fit(prompts), boxes(prompts)
    layer = Layer(X - ROOM / 2, TOP, ROOM, places[-1].bottom - TOP)
    for (label, text), box in zip(prompts, places, strict=True):
        for ink in (layer.canvas.glow, layer.canvas.soft, layer.canvas.crisp):
            ink.set_transform(box.centerx - layer.at[0], box.top - layer.at[1], 0.0, k)
        draw_key(layer, label, ICE)
        for i, line in enumerate(wrap(text, BODY, MAX_LINE)):
            layer.canvas.body(line, 0, key_size(label)[1] + LINE * (i + 0.5), MIST, "c")
    return layer.render()


def draw_key(layer: Layer, label: str, color: Color) -> None:
    """Draw a button, or a key with a label of two lines, below (0, 0)."""
    lines = _label_lines(label)
    if len(lines) == 1:
        button(layer.canvas, -button_width(label) / 2, 30, label, color)
        return
    w = key_size(label)[0]
    layer.canvas.glow.line(cut_box(-w / 2, 2, w, key_size(label)[1] - 4, 10), color, THIN, True)
    for i, line in enumerate(lines):
        layer.canvas.crisp.text(line, BODY, 0, 30 + LABEL_PITCH * i, color, "head", "c")


@cached
def side_note(label: str, figure: str) -> LitImage:
    """A word above a number, in the left margin."""
    size = min(BODY, round(BODY * ROOM / text_width(label, BODY)))
    layer = Layer(1920 - X - ROOM / 2, TOP, ROOM, 140)
    layer.canvas.text(label, size, 1920 - X, TOP + 24, ICE, "head", "c")
    layer.canvas.text(figure, LABEL, 1920 - X, TOP + 84, FOCUS, "head", "c")
    return layer.render()
