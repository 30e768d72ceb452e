"""Cached widgets: rendered once per content, then blitted additively.

Every rendering function here and in the pages is a pure function of its content and is cached. Widgets lie round
(0, 0) and are drawn at an offset.
"""

import math

import pygame

from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size
from pigaming_app.ui.draw.sprites import Sprite
from pigaming_app.ui.draw.surface_cache import cached

LEVELS = 8  # cached brightnesses of pulsing widgets


def pulse(seconds: float, low: int = 4) -> int:
    """The level, `low` to LEVELS, of a pulsing call to action, period 1 s."""
    return round(low + (LEVELS - low) * (0.5 + 0.5 * math.cos(math.tau * seconds)))


def dimmed(lit: LitImage, share: float) -> LitImage:
    """A widget at `share` (0..1) of its brightness."""
    image = lit.image.copy()
    image.fill([round(255 * share)] * 3, special_flags=pygame.BLEND_RGB_MULT)
    return LitImage(image, lit.at)


@cached
@resumable
def heading(
    title: str, right: str = "", color: kit.Color = kit.ICE, right_color: kit.Color = kit.MIST
) -> Steps[LitImage]:
    """A page heading: title, a line below it, and an optional text at the right end."""
    layer = Layer(LEFT, 54, RIGHT - LEFT, 130)
    size = fit_size(title, kit.TITLE, 1000)
    layer.canvas.text(title, size, LEFT, 112, color)
    if right:
        room = RIGHT - LEFT - 60 - kit.text_width(title, size)
        layer.canvas.body(right, RIGHT, 112, right_color, "r", fit_size(right, kit.BODY, room, "body"))
    layer.glow.line([(LEFT, 176), (RIGHT, 176)], kit.STEEL, kit.THIN).line(
        [(LEFT, 176), (LEFT + 218, 176)], color, kit.LINE
    )
    yield
    return (yield from layer.render_steps())


@cached
@resumable
def frame(w: int, h: int) -> Steps[LitImage]:
    """The frame of a picture or panel; upper left corner at (0, 0)."""
    layer = Layer(0, 0, w, h)
    kit.panel(layer.glow, 0, 0, w, h)
    yield
    return (yield from layer.render_steps())


@cached
def sign(name: str, r: int, color: kit.Color, w: float, level: int = LEVELS) -> LitImage:
    """An icon round (0, 0), `r` px to each side."""
    if level < LEVELS:
        return dimmed(sign(name, r, color, w), level / LEVELS)
    layer = Layer(-r, -r, 2 * r, 2 * r)
    kit.icon(layer.glow, name, 0, 0, r, color, w)
    return layer.render()


@cached
def call_to_action(sentence: str, label: str, size: int, level: int = LEVELS) -> LitImage:
    """A yellow prompt centred on (0, 0); "{button}" in the text is replaced by the drawn button."""
    if level < LEVELS:
        return dimmed(call_to_action(sentence, label, size), level / LEVELS)
    before, placeholder, after = sentence.partition("{button}")
    wide = kit.button_width(label) + 36 if placeholder else 0
    size = fit_size(before.strip() + after.strip(), size, 1500 - wide)
    ends = [kit.text_width(part.strip(), size) for part in (before, after)]
    x = -(sum(ends) + wide) / 2
    layer = Layer(x, -size, -2 * x, 2 * size)
    layer.canvas.text(before.strip(), size, x, 0, kit.FOCUS)
    if placeholder:
        kit.button(layer.canvas, x + ends[0] + 18, 0, label, kit.FOCUS)
    layer.canvas.text(after.strip(), size, x + ends[0] + wide, 0, kit.FOCUS)
    return layer.render()


def call_to_action_width(sentence: str, label: str, size: int) -> float:
    """Width of the call to action, px."""
    return call_to_action(sentence, label, size).image.get_width() - 96


def chip_width(word: str) -> int:
    """Width of a chip, px."""
    return round(kit.text_width(word, kit.BODY)) + 48


@cached
def chip(word: str, w: int, state: str = "off", high: int = 64) -> LitImage:
    """A box with a word, upper left corner at (0, 0). `state`: off, on, focus (on and focused), ready (highlighted)."""
    edge = {"off": kit.STEEL, "on": kit.ICE, "focus": kit.FOCUS, "ready": kit.FOCUS}[state]
    layer = Layer(0, 0, w, high)
    layer.glow.line(kit.cut_box(0, 0, w, high, 12), edge, kit.THIN, True)
    color = {"off": kit.MIST, "ready": kit.FOCUS}.get(state, kit.ICE)
    layer.canvas.crisp.text(word, fit_size(word, kit.BODY, w - 24), w / 2, high / 2, color, "head", "c")
    return layer.render()


@cached
def button_label(label: str) -> LitImage:
    """A button with its label, left edge at x = 0."""
    layer = Layer(0, -32, kit.button_width(label), 64)
    kit.button(layer.canvas, 0, 0, label)
    return layer.render()


def black_out(screen: pygame.Surface, *boxes: pygame.Rect) -> pygame.Surface:
    """Black out the floor dots inside boxes with cut corners."""
    for box in boxes:
        pygame.draw.polygon(screen, (0, 0, 0), kit.cut_box(box.x, box.y, box.w, box.h, 20))
    return screen


def glow_bar(screen: pygame.Surface, box: pygame.Rect, color: kit.Color = kit.FOCUS) -> None:
    """A faint background for the focused row."""
    screen.fill(kit.dim(color, 0.09), box, pygame.BLEND_RGB_ADD)


def blit_sprite(screen: pygame.Surface, sprite: Sprite, x: float, y: float) -> None:
    """Blit a premultiplied sprite with its anchor at (x, y)."""
    screen.blit(sprite.image, (round(x + sprite.dx), round(y + sprite.dy)), special_flags=pygame.BLEND_PREMULTIPLIED)
