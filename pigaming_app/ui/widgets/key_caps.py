"""Keys and sticks as pictures: what a device steers with."""

from pigaming_app.ui.draw import ARROWS, HAIR, THIN, Color, cut_box, icon
from pigaming_app.ui.draw.layers import Layer

CAP, PITCH = 44, 50  # px: a steering key, and from one to the next
RADIUS = 44  # px of a stick
PLACES = ((0, 0), (-1, 1), (0, 1), (1, 1))  # column and row of the steering keys: up, left, down, right


def steering_signs(moves: str) -> list[str]:
    """The signs on the four steering keys: up, left, down, right; arrows if they are no single letters."""
    return list(moves) if len(moves) == len(ARROWS) else ["↑", "←", "↓", "→"]


def draw_steering_key(layer: Layer, sign: str, x: float, y: float, color: Color) -> None:
    """Draw a steering key round (x, y)."""
    layer.glow.line(cut_box(x - CAP / 2, y - CAP / 2, CAP, CAP, 8), color, THIN, True)
    if sign in ARROWS:
        icon(layer.canvas.crisp, ARROWS[sign], x, y, 12, color, 5)
    else:
        layer.canvas.text(sign, 28, x, y, color, "head", "c")


def draw_stick(layer: Layer, x: float, y: float, color: Color) -> None:
    """Draw the socket of a stick round (x, y)."""
    layer.glow.ring(x, y, RADIUS, color, THIN).ring(x, y, 6, color, HAIR)
