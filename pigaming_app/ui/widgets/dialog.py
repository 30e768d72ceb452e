"""Dialogs: a sheet with cut corners over the darkened, frozen match, composed into one picture.

A scene draws the static part once and adds moving parts frame by frame.
"""

from collections.abc import Callable, Hashable

import pygame

from pigaming_app.ui.draw import BLACK, LINE, STEEL, THIN, Color, cut_box, panel
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, span

X, W = span(2, 8)
Y, H = 216, 648
HEAD, FOOT = Y + 208, Y + 528  # the two horizontal lines of the sheet
PROMPTS = Y + 588  # the row of prompts
ICON = X + 150, HEAD + 112  # of a sheet with an icon and sentences
TEXT_X, ROOM = X + 280, W - 280 - 64


def overlay(
    behind: pygame.Surface, color: Color, paint: Callable[[Layer], None], cache_key: Hashable = None
) -> pygame.Surface:
    """The picture `behind` (canvas size) under a sheet outlined in `color`, with the drawing of `paint` on it.

    `cache_key`: everything else that `paint` depends on. Raises Unfinished if the frame budget is spent.
    """
    light = _sheet(color, paint, cache_key)
    out = behind.copy()
    pygame.draw.polygon(out, BLACK, cut_box(X - 12, Y - 12, W + 24, H + 24, 32))
    light.draw(out)
    return out


@resumable
def _sheet(color: Color, paint: Callable[[Layer], None], cache_key: Hashable) -> Steps[LitImage]:
    layer = Layer(X, Y, W, H)
    panel(layer.glow, X, Y, W, H, color, LINE, 28)
    for y in (HEAD, FOOT):
        layer.glow.line([(X + 40, y), (X + W - 40, y)], STEEL, THIN)
    yield
    paint(layer)
    yield
    return (yield from layer.render_steps())
