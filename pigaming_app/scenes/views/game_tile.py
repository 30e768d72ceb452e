"""Tile of a game for the title screen and the game selection: picture, name, tagline."""

import pygame

from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.ui.draw import (
    BODY,
    FOCUS,
    HAIR,
    ICE,
    LABEL,
    MIST,
    STEEL,
    GlowCanvas,
    dim,
    panel,
)
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import MARGIN, Layer, LitImage, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size

TILE_Y, TILE_H = 416, 416


def tile_rect(i: int) -> pygame.Rect:
    """Rectangle of the i-th tile from the left."""
    x, w = span(4 * i, 4)
    return pygame.Rect(x, TILE_Y, w, TILE_H)


@cached
@resumable
def tile(game: str, name: str, line: str, hot: bool) -> Steps[LitImage]:
    """Picture and name of a game; top left at (0, 0)."""
    w = span(0, 4)[1]
    layer = Layer(0, 0, w, TILE_H)
    panel(layer.glow, 0, 0, w, TILE_H, dim(FOCUS, 0.55) if hot else STEEL)
    layer.glow.line([(24, 284), (w - 24, 284)], STEEL, HAIR)
    color = FOCUS if hot else ICE
    layer.canvas.text(name, fit_size(name, LABEL, w - 64), 32, 326, color)
    layer.canvas.body(line, 32, 380, ICE if hot else MIST, "l", fit_size(line, BODY, w - 64, "body"))
    drawn = picture(game)
    lit = yield from layer.render_steps()
    drawn.draw(lit.image, -lit.at[0], -lit.at[1])
    return lit


@cached
@resumable
def picture(game: str) -> Steps[LitImage]:
    """The picture of a game, 560 x 284 px; top left at (0, 0)."""
    layer = Layer(MARGIN, MARGIN, 560, 284)  # no offset: robots are placed directly on the sheet
    vignette(game, layer.glow, MARGIN, MARGIN)
    yield
    lit = yield from layer.render_steps()
    return LitImage(lit.image, (-MARGIN, -MARGIN))


def vignette(game: str, ink: GlowCanvas, x: float, y: float) -> GlowCanvas:
    """Draw the picture of a game in the upper 284 px of a 560 x 416 px tile at (x, y)."""
    SCREENS[game].tile(ink, x, y + 4)
    return ink
