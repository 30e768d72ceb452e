"""A page that lies over a match: the match dark and frozen, a black sheet with cut corners on it, all one picture.

A scene paints the still part once; what moves on it is added frame by frame.
"""

from collections.abc import Callable, Hashable

import pygame

from pigaming_app.ui.draw import BLACK, LINE, STEEL, THIN, Color, cut_box, panel
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, span

X, W = span(2, 8)
Y, H = 216, 648
HEAD, FOOT = Y + 208, Y + 528  # the two lines across the sheet
PROMPTS = Y + 588  # the row of hints


def overlay(
    behind: pygame.Surface, color: Color, paint: Callable[[Layer], None], shown: Hashable = None
) -> pygame.Surface:
    """The picture `behind` (canvas size) under a sheet outlined in `color`, on which `paint` has drawn.

    `shown` is whatever `paint` depends on besides its object. Raises Unfinished where the budget of the frame is spent.
    """
    light = _sheet(color, paint, shown)
    out = behind.copy()
    pygame.draw.polygon(out, BLACK, cut_box(X - 12, Y - 12, W + 24, H + 24, 32))
    light.draw(out)
    return out


@resumable
def _sheet(color: Color, paint: Callable[[Layer], None], shown: Hashable) -> Steps[LitImage]:
    """The light of the sheet."""
    layer = Layer(X, Y, W, H)
    panel(layer.glow, X, Y, W, H, color, LINE, 28)
    for y in (HEAD, FOOT):
        layer.glow.line([(X + 40, y), (X + W - 40, y)], STEEL, THIN)
    yield
    paint(layer)
    yield
    return (yield from layer.lighting())
