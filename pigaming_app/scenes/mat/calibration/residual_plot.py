"""The residual plot: magnified error arrows at every corner of the held-out board."""

import pygame

from pigaming_app.hardware.calibration.solver import MAX_MM, Residuals
from pigaming_app.ui.draw import (
    ALARM,
    BODY,
    FOCUS,
    HAIR,
    ICE,
    LINE,
    MIST,
    STEEL,
    SUB,
    THIN,
    Color,
    cut_box,
    dim,
    panel,
    text_width,
)
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_size, span
from pigaming_app.ui.draw.surface_cache import cached

AREA = pygame.Rect(span(0, 8)[0], 210, span(0, 8)[1], 596)  # of the plot
SIDE = pygame.Rect(span(8, 4)[0] + 24, 226, span(8, 4)[1] - 24, 600)  # of the numbers beside it
GAP = 20  # px, between a name and its value
SCALE = 0.47  # plot px per canvas px
RING = 44.0  # px, radius of the ring round a weak place
MAX_LENGTH = 40.0  # px, length of the longest arrow
TIMES = (2, 5, 10, 20, 50, 100, 200, 500, 1000)


def arrows(residuals: Residuals, weak: tuple[float, float] | None = None) -> tuple[LitImage, int]:
    """The plot and its magnification. Built once, not in a steady frame. `weak`: a place to be marked, arena px."""
    lengths = (residuals.misses**2).sum(axis=1) ** 0.5
    longest = max(float(lengths.max()) * SCALE, 1e-6)
    times = max((factor for factor in TIMES if factor * longest <= MAX_LENGTH), default=1)
    mm = residuals.max_mm / max(float(lengths.max()), 1e-9)
    layer = Layer(*AREA)
    panel(layer.glow, *AREA)
    layer.canvas.crisp.line(cut_box(*_at(-160, -140), 1920 * SCALE, 1080 * SCALE, 0), STEEL, HAIR, True)
    layer.glow.line(cut_box(*_at(0, 0), 1600 * SCALE, 900 * SCALE, 12), STEEL, THIN, True)
    for (x, y), (dx, dy), length in zip(
        residuals.places.tolist(), residuals.misses.tolist(), lengths.tolist(), strict=True
    ):
        begin, end = _at(x, y), _at(x + dx * times, y + dy * times)
        color = ALARM if length * mm > MAX_MM else FOCUS
        layer.glow.disc(*begin, 3, dim(ICE, 0.6))
        layer.canvas.crisp.line([begin, end], color, HAIR + 1)
        layer.canvas.crisp.disc(*end, 3.5, color)
    if weak:
        layer.glow.ring(*_at(*weak), RING, ALARM)
    return layer.render(), times


def _at(x: float, y: float) -> tuple[float, float]:
    """Arena px as px on the page; the canvas extends beyond the arena."""
    return AREA.centerx + (x + 160 - 960) * SCALE, AREA.y + 12 + (y + 140) * SCALE


@cached
def figure(name: str, value: str, share: float, limit: str) -> LitImage:
    """One error as a number and a bar, full at twice the limit; `share` of the limit. Upper left corner at (0, 0)."""
    layer = Layer(0, -20, SIDE.w, 160)
    color: Color = ICE if share <= 1.0 else ALARM
    layer.canvas.body(name, 0, 14, MIST, size=fit_size(name, BODY, SIDE.w - text_width(value, SUB - 8) - GAP, "body"))
    layer.canvas.text(value, SUB - 8, SIDE.w, 14, color, "head", "r")
    bar = SIDE.w
    layer.glow.line(cut_box(0, 54, bar, 22, 7), STEEL, THIN, True)
    layer.glow.fill(cut_box(4, 58, max(12.0, (bar - 8) * min(1.0, share / 2.0)), 14, 4), color)
    layer.glow.line([(bar / 2, 46), (bar / 2, 84)], ICE, LINE)
    layer.canvas.body(limit, SIDE.w, 106, MIST, "r", BODY - 10)
    return layer.render()


@cached
def fact(name: str, value: str, color: Color = ICE) -> LitImage:
    """A quantity without a limit: name on the left, value on the right, on the line y = 0."""
    layer = Layer(0, -30, SIDE.w, 60)
    room = SIDE.w - text_width(value, BODY - 4, "body") - GAP
    layer.canvas.body(name, 0, 0, MIST, size=fit_size(name, BODY - 4, room, "body"))
    layer.canvas.body(value, SIDE.w, 0, color, "r", BODY - 4)
    return layer.render()
