"""The keys that play a lesson: the stick or the steering keys, FIRE and TURBO, lit while they are pressed."""

import re

import pygame

from pigaming_app.scenes.flow.scene import Context
from pigaming_app.sim.world import Action
from pigaming_app.ui.draw import BODY, FOCUS, MIST, button, button_width, cut_box, dim
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.key_caps import CAP, PITCH, PLACES, RADIUS, draw_steering_key, draw_stick, steering_signs

STEERS = re.compile(r"go|turn|^\S+$")  # steps that steer, or a brain
PRESSED = 0.25  # deflection from which a steering key is lit
WAY = 22  # px, the way of a stick's knob
APART = 24  # px between the steering keys and the others
SIZES = (BODY, 32, 28)  # px, of the labels of the others: the first that fits


def draw_keys(screen: pygame.Surface, context: Context, script: str, action: Action, box: pygame.Rect) -> None:
    """Draw the keys of the device used last that a script needs, in the middle of a box, by what is pressed."""
    controls, device, (x, y) = context.controls, context.controls.last, box.center
    turbo = Button.LEAVE_SEAT if device.kind == "keys" else Button.BACK
    wanted = (("fire", Button.FIRE, action.fire), ("turbo", turbo, action.turbo))
    labels = [(controls.label(device, key), bool(on)) for word, key, on in wanted if word in script]
    shown = [(context.words.key_name(label), on) for label, on in labels if label]
    steers, moves = bool(STEERS.search(script)), controls.moves(device)
    wide = steers * (APART + (3 * PITCH if moves else 2 * RADIUS))
    widths = {size: wide + sum(APART + button_width(label, size) for label, _ in shown) - APART for size in SIZES}
    size = next((size for size in SIZES if widths[size] <= box.w), SIZES[-1])
    left = x - widths[size] / 2
    if steers and moves:
        pressed = (action.linear, -action.angular, -action.linear, action.angular)
        for sign, (column, row), share in zip(steering_signs(moves), PLACES, pressed, strict=True):
            at = left + PITCH * (column + 1.5), y + PITCH * (row - 0.5)
            steering_key(sign, share > PRESSED).draw(screen, *at)
    elif steers:
        stick().draw(screen, left + RADIUS, y)
        knob().draw(screen, left + RADIUS + WAY * action.angular, y - WAY * action.linear)
    left += wide
    for label, on in shown:
        key_cap(label, on, size).draw(screen, left, y)
        left += button_width(label, size) + APART


@cached
def steering_key(sign: str, on: bool) -> LitImage:
    """A steering key, centred on (0, 0)."""
    layer = Layer(-CAP / 2, -CAP / 2, CAP, CAP)
    if on:
        layer.glow.fill(cut_box(-CAP / 2, -CAP / 2, CAP, CAP, 8), dim(FOCUS, 0.35))
    draw_steering_key(layer, sign, 0, 0, _color(on))
    return layer.render()


@cached
def key_cap(label: str, on: bool, size: int) -> LitImage:
    """Another key, with its left edge at (0, 0)."""
    wide = button_width(label, size)
    layer = Layer(0, -30, wide, 60)
    if on:
        layer.glow.fill(cut_box(4, -24, wide - 8, 48, 24 if wide == 60 else 10), dim(FOCUS, 0.35))
    button(layer.canvas, 0, 0, label, _color(on), size)
    return layer.render()


@cached
def stick() -> LitImage:
    """The socket of a stick, centred on (0, 0)."""
    layer = Layer(-RADIUS, -RADIUS, 2 * RADIUS, 2 * RADIUS)
    draw_stick(layer, 0, 0, MIST)
    return layer.render()


@cached
def knob() -> LitImage:
    """The knob of a stick, centred on (0, 0)."""
    layer = Layer(-20, -20, 40, 40)
    layer.glow.disc(0, 0, 19, FOCUS)
    return layer.render()


def _color(on: bool) -> tuple[int, int, int]:
    return FOCUS if on else MIST
