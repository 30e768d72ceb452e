"""Pips: a row of rings, of which the first are filled, such as the rounds that somebody has won."""

from pigaming_app.ui.draw import LINE, THIN, Color, dim
from pigaming_app.ui.draw.layers import Layer

PITCH = 3.2  # from one pip to the next, in radii


def pips(layer: Layer, x: float, y: float, filled: int, count: int, color: Color, r: float) -> None:
    """Draw `count` pips of radius `r` px; (x, y) is the centre of the first."""
    for i in range(count):
        at, lit = x + i * r * PITCH, i < filled
        layer.glow.ring(at, y, r, color if lit else dim(color, 0.45), LINE if lit else THIN)
        if lit:
            layer.glow.disc(at, y, r - 4, color)
