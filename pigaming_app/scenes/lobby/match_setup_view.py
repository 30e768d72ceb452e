"""Rows and small widgets of the match setup page."""

from collections.abc import Sequence
from dataclasses import dataclass

import pygame

from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import SMALLEST, Layer, LitImage, fit_lines, fit_size, span
from pigaming_app.ui.draw.surface_cache import cached

W = span(8, 4)[1]
PAD = 32  # px, inner padding of a row
CHIP, APART, CLOSE = 112, 16, 8  # px: maximum chip width, gap for few chips, gap for many
LOW = 76  # px, height of a row with its values beside its name
FEW = 4  # chips that fit at full width


@dataclass(frozen=True)
class RowSizes:
    """Heights of the rows in px, and positions in them: of the name, the value and the lines of a description."""

    choice: int
    described: int  # height of a row with a description
    gap: int  # between rows
    name: int
    value: int
    line: int
    pitch: int  # of these lines
    chip: int  # height of a chip
    small: int  # type size of names and notes
    most: int  # that of descriptions, at most
    lines: int  # of a description, at most


WIDE = RowSizes(140, 236, 16, 38, 94, 156, 48, 60, kit.BODY, kit.BODY, 2)
TIGHT = RowSizes(108, 184, 12, 25, 69, 118, 40, 46, 32, 32, 2)
LARGE_WIDE = RowSizes(124, 264, 12, 32, 84, 134, 48, 52, kit.BODY, 44, 3)
LARGE_TIGHT = RowSizes(98, 230, 10, 27, 66, 108, 44, 44, 32, kit.BODY, 3)


@cached
def row(sizes: RowSizes, name: str, value: str, note: str = "", line: str = "") -> LitImage:
    """Row with a name, a note, the value between arrows and a description line; top left at (0, 0)."""
    layer = _layer(sizes, name, sizes.described if line else sizes.choice)
    layer.canvas.body(note, W - PAD, sizes.name, kit.MIST, "r", sizes.small)
    size = fit_size(value, kit.LABEL, W - 2 * PAD - 100)
    layer.canvas.text(value, size, W / 2, sizes.value, kit.ICE, "head", "c")
    for sign, x in (("left", PAD + 14), ("right", W - PAD - 14)):
        kit.icon(layer.glow, sign, x, sizes.value, 20, kit.MIST, kit.LINE)
    room = W - 2 * PAD
    size, parts = fit_lines(line, room, sizes.lines, range(sizes.most, SMALLEST, -2))
    for i, part in enumerate(parts if line else ()):
        layer.canvas.body(part, PAD, sizes.line + sizes.pitch * i, kit.MIST, "l", size)
    return layer.render()


@cached
def chips(sizes: RowSizes, name: str, values: tuple[str, ...], value: str) -> LitImage:
    """All values side by side, the selected one lit; top left at (0, 0)."""
    layer = _layer(sizes, name, sizes.choice)
    width, pitch = chip_size(len(values))
    top = sizes.value + 2 - sizes.chip / 2
    for i, label in enumerate(values):
        _chip(layer, label, pygame.Rect(PAD + i * pitch, round(top), width, sizes.chip), label == value)
    return layer.render()


@cached
def short_chips(name: str, labels: tuple[str, ...], selected: int) -> LitImage:
    """A low row: the name, and all values beside it; top left at (0, 0)."""
    layer = Layer(0, 0, W, LOW)
    layer.glow.line(kit.cut_box(0, 0, W, LOW, 16), kit.STEEL, kit.THIN, True)
    boxes = short_boxes(labels)
    size = fit_size(name, kit.BODY, boxes[0].left - PAD - 16, "body")
    layer.canvas.body(name, PAD, LOW / 2, kit.MIST, "l", size)
    for i, (label, box) in enumerate(zip(labels, boxes, strict=True)):
        _chip(layer, label, box, i == selected)
    return layer.render()


def short_boxes(labels: tuple[str, ...]) -> list[pygame.Rect]:
    """Rectangles of the values of a low row, right-aligned."""
    widths = [round(kit.text_width(label, kit.BODY)) + 44 for label in labels]
    x, boxes = W - PAD + CLOSE - sum(widths) - CLOSE * len(widths), []
    for width in widths:
        boxes.append(pygame.Rect(x, 12, width, LOW - 24))
        x += width + CLOSE
    return boxes


def short_chip_at(labels: tuple[str, ...], x: float) -> int | None:
    """Index of the value at `x` px from the left edge of a low row, if any."""
    return next((i for i, box in enumerate(short_boxes(labels)) if box.left <= x < box.right), None)


def _chip(layer: Layer, label: str, box: pygame.Rect, on: bool) -> None:
    layer.glow.line(
        kit.cut_box(box.x, box.y, box.w, box.h, 12 if box.w >= CHIP else 10),
        kit.ICE if on else kit.STEEL,
        kit.THIN,
        True,
    )
    layer.canvas.crisp.text(label, kit.BODY, box.centerx, box.centery, kit.ICE if on else kit.MIST, "head", "c")


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
@resumable
def records(lines: tuple[tuple[str, str, str], ...]) -> Steps[LitImage]:
    """Best scores, one line each: achievement, value, initials; top left at (0, 0)."""
    layer = Layer(0, 0, W, records_height(len(lines)))
    for i, (name, value, initials) in enumerate(lines):
        y = 38 + 56 * i
        kit.icon(layer.glow, "crown", PAD + 18, y - 2, 16, kit.FOCUS, 3)
        layer.canvas.body(name, PAD + 52, y, kit.MIST, "l", fit_size(name, kit.BODY, W - 2 * PAD - 364, "body"))
        layer.canvas.text(value, kit.BODY, W - PAD - 110, y, kit.ICE, "head", "r")
        layer.canvas.text(initials, kit.BODY, W - PAD, y, kit.FOCUS, "head", "r")
    return (yield from layer.render_steps())


def records_height(lines: int) -> int:
    """Height of the best scores, px."""
    return 20 + 56 * lines


@cached
def start_button(label: str) -> LitImage:
    """The start button; top left at (0, 0)."""
    layer = Layer(0, 0, W, 96)
    layer.glow.line(kit.cut_box(0, 0, W, 96, 18), kit.dim(kit.FOCUS, 0.55), kit.THIN, True)
    size = fit_size(label, kit.SUB, W - 200)
    x = W / 2 - kit.text_width(label, size) / 2
    kit.icon(layer.glow, "right", x - 30, 48, 24, kit.FOCUS, kit.LINE)
    layer.canvas.text(label, size, W / 2 + 16, 48, kit.FOCUS, "head", "c")
    return layer.render()


@cached
def lineup(seats: tuple[tuple[int, str], ...]) -> LitImage:
    """Badges and driver icons of the players, right-aligned at x = 0."""
    pitch = 168
    layer = Layer(-pitch * len(seats), -40, pitch * len(seats), 80)
    for k, (seat, sign) in enumerate(seats):
        x = -pitch * (len(seats) - k)
        kit.badge(layer.glow, seat, x + 50, 0, 30)
        kit.icon(layer.glow, sign, x + 124, 0, 30, kit.MIST, kit.THIN)
    return layer.render()


@cached
def focus_outline(height: int) -> LitImage:
    """Additional highlight of the focused row, drawn over its outline; top left at (0, 0)."""
    layer = Layer(0, 0, W, height)
    layer.glow.line(kit.cut_box(0, 0, W, height, 16), kit.dim(kit.FOCUS, 0.55), kit.THIN, True)
    return layer.render()


def _layer(sizes: RowSizes, name: str, height: int) -> Layer:
    layer = Layer(0, 0, W, height)
    layer.glow.line(kit.cut_box(0, 0, W, height, 16), kit.STEEL, kit.THIN, True)
    layer.canvas.body(name, PAD, sizes.name, kit.MIST, "l", sizes.small)
    return layer


def draw_things(screen: pygame.Surface, things: Sequence[ThingSpec], at: tuple[float, float], scale: float) -> None:
    """Draw the things on the mat over the preview of an arena, whose upper left corner is `at`."""
    for thing in things:
        points = [(at[0] + scale * x, at[1] + scale * y) for x, y in thing.outline]
        pygame.draw.polygon(screen, kit.BLACK, points)
        pygame.draw.polygon(screen, kit.FOCUS, points, 3)
