"""Rows and small widgets of the match setup page."""

import pygame

from pigaming_app.ui.draw import (
    BODY,
    FOCUS,
    ICE,
    LABEL,
    LINE,
    MIST,
    STEEL,
    SUB,
    THIN,
    badge,
    cut_box,
    dim,
    icon,
    text_width,
)
from pigaming_app.ui.draw.layers import Layer, LitImage, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_lines, fit_size

W = span(8, 4)[1]
PAD = 32  # px, inner padding of a row
CHIP, APART, CLOSE = 112, 16, 8  # px: maximum chip width, gap for few chips, gap for many
HEIGHTS = {"arena": 140, "goal": 140, "minutes": 140, "rounds": 76, "rules": 236}  # px, rows
TIGHT = {"arena": 116, "goal": 116, "minutes": 116, "rounds": 76, "rules": 192}  # px, rows where there are many
FEW = 4  # chips that fit at full width


@cached
def row(name: str, value: str, note: str = "", line: str = "", tight: bool = False) -> LitImage:
    """Row with a name, a note, the value between arrows and a description line; top left at (0, 0)."""
    heights = TIGHT if tight else HEIGHTS
    layer = _layer(name, heights["rules" if line else "arena"], tight)
    head, middle, below, pitch = (30, 76, 126, 42) if tight else (38, 94, 156, 48)
    layer.canvas.body(note, W - PAD, head, MIST, "r")
    size = fit_size(value, LABEL, W - 2 * PAD - 100)
    layer.canvas.text(value, size, W / 2, middle, ICE, "head", "c")
    for sign, x in (("left", PAD + 14), ("right", W - PAD - 14)):
        icon(layer.glow, sign, x, middle, 20, MIST, LINE)
    room = W - 2 * PAD
    size, parts = fit_lines(line, room, 2)
    for i, part in enumerate(parts):
        layer.canvas.body(part, PAD, below + pitch * i, MIST, "l", size)
    return layer.render()


@cached
def chips(name: str, values: tuple[str, ...], value: str, tight: bool = False) -> LitImage:
    """All values side by side, the selected one lit; top left at (0, 0)."""
    layer = _layer(name, (TIGHT if tight else HEIGHTS)["minutes"], tight)
    width, pitch = chip_size(len(values))
    top, high = (54, 52) if tight else (66, 60)
    for i, label in enumerate(values):
        _chip(layer, label, pygame.Rect(PAD + i * pitch, top, width, high), label == value)
    return layer.render()


@cached
def short_chips(name: str, labels: tuple[str, ...], selected: int) -> LitImage:
    """A low row: the name, and all values beside it; top left at (0, 0)."""
    layer = Layer(0, 0, W, HEIGHTS["rounds"])
    layer.glow.line(cut_box(0, 0, W, HEIGHTS["rounds"], 16), STEEL, THIN, True)
    boxes = short_boxes(labels)
    size = fit_size(name, BODY, boxes[0].left - PAD - 16, "body")
    layer.canvas.body(name, PAD, HEIGHTS["rounds"] / 2, MIST, "l", size)
    for i, (label, box) in enumerate(zip(labels, boxes, strict=True)):
        _chip(layer, label, box, i == selected)
    return layer.render()


def short_boxes(labels: tuple[str, ...]) -> list[pygame.Rect]:
    """Rectangles of the values of a low row, right-aligned."""
    widths = [round(text_width(label, BODY)) + 44 for label in labels]
    x, boxes = W - PAD + CLOSE - sum(widths) - CLOSE * len(widths), []
    for width in widths:
        boxes.append(pygame.Rect(x, 12, width, HEIGHTS["rounds"] - 24))
        x += width + CLOSE
    return boxes


def short_chip_at(labels: tuple[str, ...], x: float) -> int | None:
    """Index of the value at `x` px from the left edge of a low row, if any."""
    return next((i for i, box in enumerate(short_boxes(labels)) if box.left <= x < box.right), None)


def _chip(layer: Layer, label: str, box: pygame.Rect, on: bool) -> None:
    layer.glow.line(cut_box(box.x, box.y, box.w, box.h, 12 if box.w >= CHIP else 10), ICE if on else STEEL, THIN, True)
    layer.canvas.crisp.text(label, BODY, box.centerx, box.centery, ICE if on else MIST, "head", "c")


def chip_size(count: int) -> tuple[int, int]:
    """Width of each of `count` chips and the gap between them, px."""
    apart = APART if count <= FEW else CLOSE
    width = min(CHIP, (W - 2 * PAD + apart) // count - apart)
    return width, width + apart


def chip_at(count: int, x: float) -> int | None:
    """Index of the chip at `x` px from the left edge of the row, if any."""
    width, pitch = chip_size(count)
    i, rest = divmod(x - PAD, pitch)
    return int(i) if 0 <= i < count and rest < width else None


@cached
def records(lines: tuple[tuple[str, str, str], ...]) -> LitImage:
    """Best scores, one line each: feat, value, initials; top left at (0, 0)."""
    layer = Layer(0, 0, W, records_height(len(lines)))
    for i, (name, value, initials) in enumerate(lines):
        y = 38 + 56 * i
        icon(layer.glow, "crown", PAD + 18, y - 2, 16, FOCUS, 3)
        layer.canvas.body(name, PAD + 52, y, MIST, "l", fit_size(name, BODY, W - 2 * PAD - 364, "body"))
        layer.canvas.text(value, BODY, W - PAD - 110, y, ICE, "head", "r")
        layer.canvas.text(initials, BODY, W - PAD, y, FOCUS, "head", "r")
    return layer.render()


def records_height(lines: int) -> int:
    """Height of the best scores, px."""
    return 20 + 56 * lines


@cached
def start_button(label: str) -> LitImage:
    """The start button; top left at (0, 0)."""
    layer = Layer(0, 0, W, 96)
    layer.glow.line(cut_box(0, 0, W, 96, 18), dim(FOCUS, 0.55), THIN, True)
    size = fit_size(label, SUB, W - 200)
    x = W / 2 - text_width(label, size) / 2
    icon(layer.glow, "right", x - 30, 48, 24, FOCUS, LINE)
    layer.canvas.text(label, size, W / 2 + 16, 48, FOCUS, "head", "c")
    return layer.render()


@cached
def lineup(seats: tuple[tuple[int, str], ...]) -> LitImage:
    """Badges and driver icons of the players, right-aligned at x = 0."""
    pitch = 168
    layer = Layer(-pitch * len(seats), -40, pitch * len(seats), 80)
    for k, (seat, sign) in enumerate(seats):
        x = -pitch * (len(seats) - k)
        badge(layer.glow, seat, x + 50, 0, 30)
        icon(layer.glow, sign, x + 124, 0, 30, MIST, THIN)
    return layer.render()


@cached
def mark(seat: int) -> LitImage:
    """Start position marker of a seat, centred on (0, 0)."""
    layer = Layer(-24, -24, 48, 48)
    badge(layer.glow, seat, 0, 0, 17)
    return layer.render()


@cached
def focus_outline(height: int) -> LitImage:
    """Additional highlight of the focused row, drawn over its outline; top left at (0, 0)."""
    layer = Layer(0, 0, W, height)
    layer.glow.line(cut_box(0, 0, W, height, 16), dim(FOCUS, 0.55), THIN, True)
    return layer.render()


def _layer(name: str, height: int, tight: bool) -> Layer:
    layer = Layer(0, 0, W, height)
    layer.glow.line(cut_box(0, 0, W, height, 16), STEEL, THIN, True)
    layer.canvas.body(name, PAD, 30 if tight else 38, MIST)
    return layer
