"""Tile of a game for the title screen and the game selection: picture, name, tagline."""

from collections.abc import Callable, Sequence

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
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out

TILE_Y, TILE_H = 416, 416
IN_VIEW = 3  # tiles
SLIDE = 0.09  # s, time constant of a moving row


def tile_rect(i: int, y: int = TILE_Y) -> pygame.Rect:
    """Rectangle of the i-th tile from the left; beyond the third they lie outside the picture."""
    x, w = span(4 * i, 4)
    return pygame.Rect(x, y, w, TILE_H)


class TileStrip:
    """A row of tiles, three in the picture; the row moves when the focus goes beyond, and the next tile peeks in."""

    def __init__(self, names: Sequence[str], y: int = TILE_Y) -> None:
        self.names, self.y = list(names), y
        self.first = 0  # index of the leftmost tile in the picture
        self.offset = 0.0  # the same while the row moves

    def spots(self) -> list[FocusSpot]:
        """The tiles as spots of a focus, where they will come to rest."""
        return [FocusSpot(name, tile_rect(i - self.first, self.y)) for i, name in enumerate(self.names)]

    def follow(self, focus: Focus) -> bool:
        """Bring the focused tile into the picture. True if the row moves; the spots are others then."""
        if focus.name not in self.names:
            return False
        i, before = self.names.index(focus.name), self.first
        self.first = min(max(self.first, i - IN_VIEW + 1), i)
        return self.first != before

    def update(self, seconds: float) -> None:
        """Move the row."""
        left = self.first - self.offset
        self.offset = float(self.first) if abs(left) < 0.002 else self.offset + left * min(1.0, seconds / SLIDE)

    def draw(self, screen: pygame.Surface, lit: Callable[[str], LitImage]) -> None:
        """Draw the tiles; `lit(name)` is the picture of one. At rest, those that peek in are empty: no word is cut."""
        pitch = tile_rect(1).x - tile_rect(0).x
        for i, name in enumerate(self.names):
            box = tile_rect(i, self.y).move(-round(self.offset * pitch), 0)
            if box.colliderect(screen.get_rect()):
                black_out(screen, box)
                whole = self.offset != self.first or i in range(self.first, self.first + IN_VIEW)
                (lit(name) if whole else empty_tile()).draw(screen, *box.topleft)


@cached
def empty_tile() -> LitImage:
    """The frame of a tile that peeks in; top left at (0, 0)."""
    w = span(0, 4)[1]
    layer = Layer(0, 0, w, TILE_H)
    panel(layer.glow, 0, 0, w, TILE_H, STEEL)
    layer.glow.line([(24, 284), (w - 24, 284)], STEEL, HAIR)
    return layer.render()


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
