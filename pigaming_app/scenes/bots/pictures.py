"""The picture of programs: beside the row of the options, and on their page."""

from pigaming_app.ui.draw import FOCUS, ICE, LINE, GlowCanvas
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached


def sketch(ink: GlowCanvas, beat: int) -> None:
    """Draw a program: two brackets, and a line of text between them that grows."""
    for side in (-1, 1):
        ink.line([(side * 80, -90), (side * 150, 0), (side * 80, 90)], FOCUS, LINE)
    for row, width in enumerate((60, 90 if beat else 30)):
        y = -24 + 48 * row
        ink.line([(-45, y), (-45 + width, y)], ICE, LINE)


@cached
def picture(chosen: int) -> LitImage:
    """A program, centred on (0, 0)."""
    ink = GlowCanvas(480, 340).set_transform(240, 170)
    sketch(ink, chosen)
    return LitImage(ink.lit(), (-240, -170))
