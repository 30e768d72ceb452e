"""The stars of allies: those that they have won, and the outlines of the others."""

from pigaming_app.ui.draw import FOCUS, LINE, STEEL, THIN, GlowCanvas, star_points
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached

STARS, HIGH = 3, 232  # number; px, height of a row


@cached
def star(lit: bool, r: int) -> LitImage:
    """A star of radius `r` px, centred on (0, 0)."""
    half = r + 40
    ink = draw_star(GlowCanvas(2 * half, 2 * half), lit, r, half, half)
    return LitImage(ink.lit(0.8), (-half, -half))


def star_row(won: int, x: int, y: int, w: int, r: int = 92) -> LitImage:
    """`won` of three stars, spread over `w` px from (x, y)."""
    layer = Layer(x, y, w, HIGH)
    for i in range(STARS):
        draw_star(layer.glow, i < won, r, x + w * (2 * i + 1) / (2 * STARS), y + HIGH / 2)
    return layer.render()


def draw_star(ink: GlowCanvas, lit: bool, r: int, x: float, y: float) -> GlowCanvas:
    """Draw a star of radius `r` px, or its outline."""
    corners = star_points(r, x, y)
    if lit:
        return ink.fill(corners, FOCUS).line(corners, FOCUS, LINE, True)
    return ink.line(corners, STEEL, THIN, True)
