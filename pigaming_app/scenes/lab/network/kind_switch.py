"""The switch between the two kinds of robots: one learns with a table, the other with a network."""

import pygame

from pigaming_app.scenes.lab.layout import MATCH, SPEED
from pigaming_app.ui.draw import BLUE, BODY, ICE, MIST, STEEL, THIN, Color, GlowCanvas, cut_box, dim, text_width
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words

KINDS = TABLE, NETWORK = "table", "network"
SIGN, GAP, EDGE = 17, 14, 20  # px: half a sign, from the sign to the label, from the sign or label to the edge
DIMMED = 0.6  # brightness of a kind that cannot learn here


def parts(words: Words) -> list[tuple[int, int]]:
    """x within the switch and width of each kind, px."""
    widths = [round(2 * EDGE + 2 * SIGN + GAP + text_width(words(f"lab.{kind}"), BODY)) for kind in KINDS]
    return [(0, widths[0]), (widths[0], widths[1])]


def kind_rect(words: Words) -> pygame.Rect:
    """The switch: between the title and the right edge of the match."""
    w = sum(width for _, width in parts(words))
    return pygame.Rect(MATCH.right - w, SPEED.y, w, SPEED.h)


def kind_at(x: float, words: Words) -> str:
    """The kind at `x` px on the canvas."""
    return TABLE if x < kind_rect(words).left + parts(words)[0][1] else NETWORK


@cached
def kind_switch(language: str, chosen: str, networks: bool) -> LitImage:
    """Both kinds, the chosen one lit; top left at (0, 0). `networks`: they can learn here, perhaps after a
    fetch.
    """
    words = Words(language)
    w, h = kind_rect(words).size
    layer = Layer(0, 0, w, h)
    layer.glow.line(cut_box(0, 0, w, h, 16), BLUE, THIN, True)
    for kind, (x, width) in zip(KINDS, parts(words), strict=True):
        on = kind == chosen
        if on:
            layer.canvas.crisp.fill(cut_box(x + 8, 8, width - 16, h - 16, 10), dim(BLUE, 0.3))
        color: Color = ICE if on else MIST if kind == TABLE or networks else dim(STEEL, DIMMED)
        sign = table_sign if kind == TABLE else network_sign
        sign(layer.canvas.crisp, x + EDGE + SIGN, h / 2, BLUE if on else color if color != MIST else STEEL)
        layer.canvas.crisp.text(words(f"lab.{kind}"), BODY, x + EDGE + 2 * SIGN + GAP, h / 2, color, "head")
    return layer.render()


def table_sign(ink: GlowCanvas, x: float, y: float, color: Color) -> None:
    """A table of three by three cells round (x, y)."""
    ink.line(
        [(x - SIGN, y - SIGN), (x + SIGN, y - SIGN), (x + SIGN, y + SIGN), (x - SIGN, y + SIGN)], color, THIN, True
    )
    for d in (-SIGN / 3, SIGN / 3):
        ink.line([(x - SIGN, y + d), (x + SIGN, y + d)], color, 3)
        ink.line([(x + d, y - SIGN), (x + d, y + SIGN)], color, 3)


def network_sign(ink: GlowCanvas, x: float, y: float, color: Color) -> None:
    """Two neurons, connected with three others, round (x, y)."""
    left = [(x - 0.8 * SIGN, y + d * SIGN) for d in (-0.9, 0.0, 0.9)]
    right = [(x + 0.8 * SIGN, y + d * SIGN) for d in (-0.45, 0.45)]
    for one in left:
        for other in right:
            ink.line([one, other], color, 2.5)
    for point in (*left, *right):
        ink.disc(*point, 5, color)
