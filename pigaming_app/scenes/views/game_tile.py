"""Tile of a game for the title screen and the game selection: picture, name, tagline."""

from collections.abc import Callable, Sequence

import pygame

from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, MARGIN, Layer, LitImage, fit_lines, fit_size, span, wrap_balanced
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out

TILE_Y, TILE_H = 416, 416
IN_VIEW = 4  # tiles
W = span(0, 12 // IN_VIEW)[1]  # px, of a tile
PITCH = span(12 // IN_VIEW, 1)[0] - LEFT  # px, from tile to tile
PICTURE = pygame.Rect(MARGIN, MARGIN, 560, 284)  # as games draw it
SMALLER = W / PICTURE.w  # of the picture on a tile
RULE_Y, NAME_Y, LINE_Y = 222, 272, 330  # px
TEXT_X, LINE_PITCH = 24, 48  # px
SLIDE = 0.09  # s, time constant of a moving row


class TileStrip:
    """A row of tiles, four in the picture; the row moves when the focus goes beyond, and the next tile peeks in."""

    def __init__(self, names: Sequence[str], y: int = TILE_Y) -> None:
        self.names, self.y = list(names), y
        self.left = LEFT + PITCH * max(0, IN_VIEW - len(self.names)) // 2  # fewer are centred
        self.first = 0  # index of the leftmost tile in the picture
        self.offset = 0.0  # the same while the row moves

    def spots(self) -> list[FocusSpot]:
        """The tiles as spots of a focus, where they will come to rest."""
        return [FocusSpot(name, self._box(i, self.first)) for i, name in enumerate(self.names)]

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
        for i, name in enumerate(self.names):
            box = self._box(i, self.offset)
            if box.colliderect(screen.get_rect()):
                black_out(screen, box)
                whole = self.offset != self.first or i in range(self.first, self.first + IN_VIEW)
                (lit(name) if whole else empty_tile()).draw(screen, *box.topleft)

    def _box(self, i: int, first: float) -> pygame.Rect:
        """Rectangle of the i-th tile while the `first` one is the leftmost."""
        return pygame.Rect(self.left + PITCH * i - round(PITCH * first), self.y, W, TILE_H)


@cached
def empty_tile() -> LitImage:
    """The frame of a tile that peeks in; top left at (0, 0)."""
    layer = Layer(0, 0, W, TILE_H)
    draw_frame(layer.glow, kit.STEEL)
    return layer.render()


@cached
@resumable
def tile(game: str, name: str, line: str, hot: bool) -> Steps[LitImage]:
    """Picture and name of a game; top left at (0, 0)."""
    layer, room = Layer(0, 0, W, TILE_H), W - 2 * TEXT_X
    draw_frame(layer.glow, kit.dim(kit.FOCUS, 0.55) if hot else kit.STEEL)
    layer.canvas.text(name, fit_size(name, kit.LABEL, room), TEXT_X, NAME_Y, kit.FOCUS if hot else kit.ICE)
    size, lines = fit_lines(line, room, 2)
    for i, part in enumerate(wrap_balanced(line, len(lines), size)):
        layer.canvas.body(part, TEXT_X, LINE_Y + LINE_PITCH * i, kit.ICE if hot else kit.MIST, "l", size)
    drawn = picture(game)
    lit = yield from layer.render_steps()
    yield
    smaller = pygame.transform.smoothscale_by(drawn.image, SMALLER)
    LitImage(smaller, (round(SMALLER * drawn.at[0]), round(SMALLER * drawn.at[1]))).draw(lit.image, MARGIN, MARGIN)
    return lit


def draw_frame(ink: kit.GlowCanvas, color: kit.Color) -> None:
    """The frame of a tile, and the rule below its picture."""
    kit.panel(ink, 0, 0, W, TILE_H, color)
    ink.line([(TEXT_X, RULE_Y), (W - TEXT_X, RULE_Y)], kit.STEEL, kit.HAIR)


@cached
@resumable
def picture(game: str) -> Steps[LitImage]:
    """The picture of a game, 560 x 284 px; top left at (0, 0)."""
    layer = Layer(*PICTURE)  # no offset: robots are placed directly on the sheet
    SCREENS[game].tile(layer.glow, MARGIN, MARGIN + 4)
    yield
    lit = yield from layer.render_steps()
    return LitImage(lit.image, (-MARGIN, -MARGIN))
