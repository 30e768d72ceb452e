"""Sentences as lines on a screen."""

from pigaming_app.ui.draw.ink import BODY, ICE, Color
from pigaming_app.ui.draw.layers import Lit, lines_of
from pigaming_app.ui.widgets.labels import text

SMALLEST = 28  # px


def paragraph(said: str, room: int, most: int = 4, color: Color = ICE, align: str = "l") -> list[Lit]:
    """A sentence as lines of at most `room` px, not more than so many: a longer one is written smaller."""
    size = next((size for size in range(BODY, SMALLEST, -2) if len(lines_of(said, size, room)) <= most), SMALLEST)
    return [text(line, size, color, "body", align, room) for line in lines_of(said, size, room)]
