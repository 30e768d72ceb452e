"""Drawings of pads and keys for the controls test: static images and highlights.

A card is W x H px, with its upper left corner at (0, 0).
"""

import pygame

from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_size, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button

W, H = span(0, 3)[1], 340
STICK, REACH = (112, 188), 58  # px: centre of the stick, and reach of its knob
KEY = 70
KEYS = {
    Button.UP: pygame.Rect(104, 2, KEY, KEY),
    Button.LEFT: pygame.Rect(26, 80, KEY, KEY),
    Button.DOWN: pygame.Rect(104, 80, KEY, KEY),
    Button.RIGHT: pygame.Rect(182, 80, KEY, KEY),
    Button.FIRE: pygame.Rect(26, 158, 226, 58),
    Button.LEAVE_SEAT: pygame.Rect(26, 224, 226, 58),
}
ROBOT, PAD_ROBOT = (322, 100), (320, 70)  # px: the robot on a card
STYLE, PAD_STYLE = (47, 314), (238, 314)  # px: the picture of the driving style
DIAMOND = {Button.FIRE: (296, 262), Button.BACK: (352, 206), Button.X: (240, 206), Button.Y: (296, 150)}
START = pygame.Rect(28, 286, 168, 40)
START_LINE = kit.cut_box(START.x, START.y, START.w, START.h, 10)


@cached
def no_pad(title: str, hint: str) -> LitImage:
    """The placeholder of a pad."""
    layer = Layer(0, 0, W, H)
    layer.glow.dashes(kit.cut_box(0, 0, W, H, 20), kit.STEEL, kit.THIN, 22, 16)
    kit.icon(layer.glow, "pad", W / 2, 118, 62, kit.STEEL, kit.THIN)
    layer.canvas.body(title, W / 2, 222, kit.MIST, "c", fit_size(title, kit.BODY, W - 40, "body"))
    layer.canvas.body(hint, W / 2, 276, kit.dim(kit.MIST, 0.7), "c", fit_size(hint, kit.BODY, W - 40, "body"))
    return layer.render()


@cached
@resumable
def pad(name: str, labels: tuple[str, ...]) -> Steps[LitImage]:
    """A pad with its name and the labels of FIRE, BACK, X, Y and START."""
    layer = Layer(0, 0, W, H)
    kit.panel(layer.glow, 0, 0, W, H, kit.STEEL)
    kit.icon(layer.glow, "pad", 62, 56, 34, kit.MIST, kit.THIN)
    layer.canvas.crisp.text(name, fit_size(name, kit.BODY, W - 250), 110, 56, kit.ICE, "head")
    layer.glow.ring(*STICK, REACH + 20, kit.STEEL, kit.LINE)
    for (x, y), label in zip(DIAMOND.values(), labels, strict=False):
        layer.glow.ring(x, y, 30, kit.STEEL, kit.THIN)
        _draw_label(layer.glow, label, x, y, kit.MIST)
    if labels[-1]:
        layer.glow.line(START_LINE, kit.STEEL, kit.THIN, True)
        size = fit_size(labels[-1], 30, START.w - 16)
        layer.canvas.crisp.text(labels[-1], size, START.centerx, START.centery, kit.MIST, "head", "c")
    return (yield from layer.render_steps())


@cached
def pad_light(button: Button, label: str) -> LitImage:
    """The highlight of a pressed pad button, to draw over its card."""
    if button is Button.START:
        layer = Layer(*START)
        layer.glow.fill(START_LINE, kit.dim(kit.FOCUS, 0.35)).line(START_LINE, kit.FOCUS, kit.THIN, True)
        return layer.render()
    x, y = DIAMOND[button]
    layer = Layer(x - 32, y - 32, 64, 64)
    layer.glow.disc(x, y, 30, kit.dim(kit.FOCUS, 0.35)).ring(x, y, 30, kit.FOCUS, kit.THIN)
    _draw_label(layer.glow, label, x, y, kit.FOCUS)
    return layer.render()


@cached
def style(text: str, picture: str) -> LitImage:
    """A driving style: its picture round (0, 0), and its name."""
    layer = Layer(-24, -24, 200, 48)
    kit.icon(layer.glow, picture, 0, 0, 21, kit.ICE, kit.THIN)
    layer.canvas.crisp.text(text, fit_size(text, 32, 120), 36, 0, kit.MIST, "head")
    return layer.render()


@cached
def keypad(name: str) -> LitImage:
    """The picture of the keypad and its name, beside the upper key of its card."""
    layer = Layer(0, 0, W, 80)
    kit.icon(layer.glow, "keypad", 58, 36, 32, kit.MIST, 3)
    layer.canvas.body(name, W - 4, 14, kit.MIST, "r", fit_size(name, 32, W - 187, "body"))
    return layer.render()


@cached
def knob() -> LitImage:
    """The knob of a stick, centred on (0, 0)."""
    return LitImage(kit.GlowCanvas(96, 96).disc(48, 48, 20, kit.FOCUS).lit(1.0), (-48, -48))


@cached
def cap(label: str, w: int, h: int, down: bool) -> LitImage:
    """A key, pressed or not; a wide one is wider than `w` px if its name takes more."""
    if w > KEY:
        w = max(w, min(round(kit.text_width(label, kit.BODY)) + 40, W - 52))
    layer = Layer(0, 0, w, h)
    edge = kit.FOCUS if down else kit.STEEL
    if down:
        layer.glow.fill(kit.cut_box(0, 0, w, h, 12), kit.dim(kit.FOCUS, 0.35))
    layer.glow.line(kit.cut_box(0, 0, w, h, 12), edge, kit.THIN, True)
    color = kit.FOCUS if down else kit.MIST
    if label in kit.ARROWS:
        kit.icon(layer.glow, kit.ARROWS[label], w / 2, h / 2, 18, color, kit.LINE)
    else:
        layer.canvas.crisp.text(label, fit_size(label, kit.BODY, w - 20), w / 2, h / 2, color, "head", "c")
    return layer.render()


def _draw_label(ink: kit.GlowCanvas, label: str, x: float, y: float, color: kit.Color) -> None:
    """A letter, or the icon for its label."""
    if label in kit.SIGNS:
        kit.icon(ink, kit.SIGNS[label], x, y, 17, color, kit.THIN)
    else:
        size = kit.BODY if kit.text_width(label, kit.BODY) < 40 else 30
        ink.text(label, size, x, y, color, "head", "c")


KEY_ICONS = {"fire": "shoot", "turbo": "speed", "x": "plus", "start": "play", "normal": "turn_left"}


@cached
def key(name: str, device: str, lit: bool) -> LitImage:
    """The function `name` of a key or a button: a sign in its outline, which glows if `lit`. `device`: its icon."""
    ink, color = kit.GlowCanvas(480, 340).set_transform(240, 170), kit.FOCUS if lit else kit.STEEL
    if name == "device":
        kit.icon(ink, device, 0, 10, 120, color, kit.LINE)
        return LitImage(ink.lit(0.9), (-240, -170))
    if device != "pad":
        ink.line(kit.cut_box(-110, -110, 220, 220, 24), color, kit.LINE, True)
    else:
        ink.ring(0, 0, 116, color, kit.LINE)
    if name == "y":
        ink.text("ABC", kit.LABEL, 0, 0, kit.ICE, "head", "c")
    else:
        kit.icon(ink, KEY_ICONS.get(name, name), 0, 0, 60, kit.ICE, kit.LINE)
    return LitImage(ink.lit(0.9), (-240, -170))
