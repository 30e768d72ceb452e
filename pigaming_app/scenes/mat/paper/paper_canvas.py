"""A canvas of paper: takes what is drawn for the projector, and keeps it as operators of a PDF, in ink on white.

Light becomes ink: a colour keeps its hue; grey gets the opposite lightness, so that black costs no ink and white is
black.
"""

from colorsys import hls_to_rgb, rgb_to_hls
from functools import lru_cache
from typing import Self

from pigaming_app.ui.draw import BLACK, CAPITALS, ICE, LINE, Color, GlowCanvas, Points
from pigaming_app.ui.draw.glow import Supersampled
from pigaming_app.ui.pdf import op, path, written

FULL = 0.44  # lightness of a full colour on paper
WIDE, USUAL = 0.72, 0.56  # em, widths of Helvetica's bold capitals and digits


class PaperCanvas(GlowCanvas):
    """Operators in `drawn`, for `PdfFile.draw`; their unit is that of the drawing calls."""

    def __init__(self) -> None:
        super().__init__(1, 1, 1)
        self.drawn: list[str] = ["1 J 1 j"]

    def fill(self, points: Points, color: Color) -> Self:
        self.drawn.append(f"{_ink(color)} rg {path(map(self._at, points), 'f')}")
        return self

    def solid(self, points: Points) -> Self:
        return self.fill(points, BLACK)

    def neon(self, points: Points, color: Color, width: float = LINE, closed: bool = False) -> Self:
        return self.line(points, color, width, closed)

    def _line(self, sheet: Supersampled, points: Points, color: Color, width: float, closed: bool = False) -> Self:
        if sheet is self.sheet:  # the others hold back glow
            line = path(map(self._at, points), "s" if closed else "S")
            self.drawn.append(f"{_ink(color)} RG {op('w', width * self.k)} {line}")
        return self

    def disc(self, x: float, y: float, r: float, color: Color) -> Self:
        return self.line([(x, y), (x, y)], color, 2.0 * r)

    def text(
        self, text: str, size: int, x: float, y: float, color: Color = ICE, face: str = "head", align: str = "l"
    ) -> Self:
        """One upright line of text in Helvetica; see `GlowCanvas.text`."""
        (px, py), high = self._at((x, y)), size * self.k
        wide = high * sum(WIDE if letter.isupper() else USUAL for letter in text)
        px -= {"l": 0.0, "c": 0.5, "r": 1.0}[align] * wide
        self.drawn.append(f"{_ink(color)} rg {written(text, px, py + CAPITALS / 2 * high, high, True)}")
        return self


@lru_cache(maxsize=256)
def _ink(color: Color) -> str:
    """A colour of light as ink on white: the numbers of `rg` and `RG`."""
    hue, light, saturation = rgb_to_hls(*(part / 255.0 for part in color))
    brightest = max(color) / 255.0
    if not brightest:
        return "1 1 1"
    chroma = 1.0 - min(color) / max(color)
    ink = (1.0 - chroma) * (1.0 - light / brightest) + chroma * FULL  # of this colour at its brightest
    return op("", *hls_to_rgb(hue, 1.0 - brightest * (1.0 - ink), saturation))
