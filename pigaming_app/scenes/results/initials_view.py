"""Panels for entering initials; a panel is W x H px, its top left at (0, 0)."""

import math

import pygame

from pigaming_app.scenes.results.spelling import Spelling
from pigaming_app.scenes.views.sprites.effects import timer_ring
from pigaming_app.ui.draw import (
    ADD,
    ALARM,
    BODY,
    FOCUS,
    ICE,
    LABEL,
    LINE,
    MIST,
    PLAYERS,
    STEEL,
    THIN,
    TITLE,
    badge,
    cut_box,
    panel,
    text_width,
)
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import RIGHT, Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size, word
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
    panel(layer.glow, 0, 0, W, H, PLAYERS[seat], LINE if done else THIN)
    badge(layer.glow, seat, 72, 76, 36)
    layer.canvas.text(label, fit_size(label, LABEL, W - 160), 136, 76, ICE)
    for i, (name, value) in enumerate(lines):
        y = LINES_Y + LINE_PITCH * i
        room = W - 48
        if value:
            layer.canvas.text(value, LABEL, W - 24, y, FOCUS, "hero", "r")
            room -= round(text_width(value, LABEL, "hero")) + 20
        layer.canvas.body(name, 24, y, ICE if value else MIST, "l", fit_size(name, BODY, room, "body"))
    for i in range(3):
        box = cut_box(slot_x(i) - SLOT_W / 2, LETTERS_Y - SLOT_H / 2, SLOT_W, SLOT_H, 14)
        layer.glow.line(box, STEEL, THIN, True)
    yield
    return (yield from layer.render_steps())


def letters(screen: pygame.Surface, x: int, seat: int, spelling: Spelling) -> None:
    """Draw a player's three letters in the panel at `x`, with corners around the selected one."""
    shake = 10 * math.sin(spelling.shaking * 50) if spelling.refused else 0.0
    xs = [x + slot_x(i) + shake for i in range(3)]
    draw_letters(screen, spelling.picker, xs, TOP_Y + LETTERS_Y, TITLE, 40, PLAYERS[seat], not spelling.done)
    if not spelling.done:
        arrows = (ARROW_Y, 18, ARROW_Y + 30)
        lit = cursor(SLOT_W, SLOT_H, 20, 14, LINE, arrows)
        lit.draw(screen, x + slot_x(spelling.picker.slot), TOP_Y + LETTERS_Y)


@cached
def refused(label: str) -> LitImage:
    """Text that replaces the button while rejected letters shake."""
    layer = Layer(*BAR)
    layer.canvas.body(label, MIDDLE, BAR_Y, ALARM, "c", fit_size(label, BODY, W - 48, "body"))
    return layer.render()


def slot_x(slot: int) -> float:
    """Centre of a letter, px from the left edge of its panel."""
    return MIDDLE + (slot - 1) * (SLOT_W + SLOT_GAP)


def clock(screen: pygame.Surface, left: float, whole: float) -> None:
    """Draw the remaining seconds in a ring."""
    image, dx, dy = timer_ring(FOCUS, 4 * math.ceil(12 * left / whole), 46, LINE)
    screen.blit(image, (RING[0] + dx, RING[1] + dy), special_flags=ADD)
    word(str(math.ceil(left)), LABEL, FOCUS, "head").draw(screen, *RING)
