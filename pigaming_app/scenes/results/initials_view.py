"""Panels for entering initials; a panel is W x H px, its top left at (0, 0)."""

import math

import pygame

from pigaming_app.scenes.results.spelling import Spelling
from pigaming_app.scenes.views.sprites.effects import timer_ring
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import RIGHT, Layer, LitImage, fit_size, word
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.letter_picker import cursor, draw_letters
from pigaming_app.ui.widgets.player_card import BAR, BAR_Y, MIDDLE, H, W

TOP_Y, FOOT_Y = 226, 916
PITCH = W + 24
LETTERS_Y = 416  # px, centre of the letters
SLOT_W, SLOT_H, SLOT_GAP = 104, 112, 16
ARROW_Y = 78  # px from there to the arrows
LINES_Y, LINE_PITCH = 148, 50
RING = RIGHT - 56, 110


def corners(count: int) -> list[int]:
    """Left edges of `count` panels, centred on the page."""
    left = 960 - (PITCH * count - 24) // 2
    return [left + PITCH * i for i in range(count)]


def panel_at(x: int) -> pygame.Rect:
    """Rectangle of a panel."""
    return pygame.Rect(x, TOP_Y, W, H)


@cached
@resumable
def frame(seat: int, label: str, lines: tuple[tuple[str, str], ...], done: bool) -> Steps[LitImage]:
    """Panel without its letters: player, qualifying results and the letter boxes."""
    layer = Layer(0, 0, W, H)
    kit.panel(layer.glow, 0, 0, W, H, kit.PLAYERS[seat], kit.LINE if done else kit.THIN)
    kit.badge(layer.glow, seat, 72, 76, 36)
    layer.canvas.text(label, fit_size(label, kit.LABEL, W - 160), 136, 76, kit.ICE)
    for i, (name, value) in enumerate(lines):
        y = LINES_Y + LINE_PITCH * i
        room = W - 48
        if value:
            layer.canvas.text(value, kit.LABEL, W - 24, y, kit.FOCUS, "hero", "r")
            room -= round(kit.text_width(value, kit.LABEL, "hero")) + 20
        layer.canvas.body(name, 24, y, kit.ICE if value else kit.MIST, "l", fit_size(name, kit.BODY, room, "body"))
    for i in range(3):
        box = kit.cut_box(slot_x(i) - SLOT_W / 2, LETTERS_Y - SLOT_H / 2, SLOT_W, SLOT_H, 14)
        layer.glow.line(box, kit.STEEL, kit.THIN, True)
    yield
    return (yield from layer.render_steps())


def letters(screen: pygame.Surface, x: int, seat: int, spelling: Spelling) -> None:
    """Draw a player's three letters in the panel at `x`, with corners around the selected one."""
    shake = 10 * math.sin(spelling.shaking * 50) if spelling.refused else 0.0
    xs = [x + slot_x(i) + shake for i in range(3)]
    draw_letters(screen, spelling.picker, xs, TOP_Y + LETTERS_Y, kit.TITLE, 40, kit.PLAYERS[seat], not spelling.done)
    if not spelling.done:
        arrows = (ARROW_Y, 18, ARROW_Y + 30)
        lit = cursor(SLOT_W, SLOT_H, 20, 14, kit.LINE, arrows)
        lit.draw(screen, x + slot_x(spelling.picker.slot), TOP_Y + LETTERS_Y)


@cached
def refused(label: str) -> LitImage:
    """Text that replaces the button while rejected letters shake."""
    layer = Layer(*BAR)
    layer.canvas.body(label, MIDDLE, BAR_Y, kit.ALARM, "c", fit_size(label, kit.BODY, W - 48, "body"))
    return layer.render()


def slot_x(slot: int) -> float:
    """Centre of a letter, px from the left edge of its panel."""
    return MIDDLE + (slot - 1) * (SLOT_W + SLOT_GAP)


def clock(screen: pygame.Surface, left: float, whole: float) -> None:
    """Draw the remaining seconds in a ring."""
    image, dx, dy = timer_ring(kit.FOCUS, 4 * math.ceil(12 * left / whole), 46, kit.LINE)
    screen.blit(image, (RING[0] + dx, RING[1] + dy), special_flags=kit.ADD)
    word(str(math.ceil(left)), kit.LABEL, kit.FOCUS, "head").draw(screen, *RING)
