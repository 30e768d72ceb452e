"""PDF files (ISO 32000-1): pages that are pictures, with the text on them, so that they can be searched and read aloud;
and pages that are drawn in mm, to scale.
"""

import zlib
from collections.abc import Iterable, Mapping
from io import BytesIO

WrittenLine = tuple[str, float, float, int]
"""A line of text, the left end of its base line and the size of its type, px."""

MM = 72.0 / 25.4  # points
LARGEST = 5080.0  # mm, of a page
FONTS = ("Helvetica", "Helvetica-Bold")  # /F and /B of every page, which every reader has
HEAD = 2  # objects before those of the fonts


class PdfFile:
    """A PDF of pages; readers are asked to print it at 100 %. `dpi`: px of an inch of a picture."""

    def __init__(self, dpi: float = 72.0) -> None:
        self.points = 72 / dpi  # of a px
        kinds = (f"<</Type/Font/Subtype/Type1/BaseFont/{name}/Encoding/WinAnsiEncoding>>" for name in FONTS)
        self.objects: list[bytes] = [b""] * HEAD + [kind.encode() for kind in kinds]
        self.pages: list[int] = []

    def add(self, jpeg: bytes, size: tuple[int, int], lines: Iterable[WrittenLine]) -> None:
        """Add a page: a JPEG in RGB of this size, px, and what is written on it, invisible. Letters beyond Western
        Europe are question marks there.
        """
        w, h, points = *size, self.points
        head = (
            f"/Type/XObject/Subtype/Image/Width {w}/Height {h}/ColorSpace/DeviceRGB/BitsPerComponent 8/Filter/DCTDecode"
        )
        picture = self._object(_stream(jpeg, head))
        drawn = [f"q {w * points:.2f} 0 0 {h * points:.2f} 0 0 cm /Im Do Q BT 3 Tr"]
        for line, x, y, high in lines:
            drawn.append(f"/F {high * points:.2f} Tf 1 0 0 1 {x * points:.2f} {(h - y) * points:.2f} Tm {_coded(line)}")
        self._page((w * points, h * points), _stream("\n".join([*drawn, "ET"]).encode()), {"Im": picture})

    def draw(self, size: tuple[float, float], drawing: str, parts: Mapping[str, int] | None = None) -> None:
        """Add a page of this size, drawn by operators in mm, x right and y down from its top left; `parts`: of `part`,
        by the names under which the drawing calls them.
        """
        w, h = size[0] * MM, size[1] * MM
        self._page((w, h), _packed(f"{MM:.6f} 0 0 {-MM:.6f} 0 {h:.4f} cm\n{drawing}"), parts or {})

    def part(self, box: tuple[float, float, float, float], drawing: str) -> int:
        """A drawing within left, top, right and bottom that several pages call: `/NAME Do`. Its number for `draw`."""
        bounds = " ".join(f"{edge:.3f}" for edge in box)
        head = f"/Type/XObject/Subtype/Form/BBox[{bounds}]/Resources<<{self._fonts}>>"
        return self._object(_packed(drawing, head))

    def packed(self) -> bytes:
        """The file."""
        kids = " ".join(f"{page} 0 R" for page in self.pages)
        self.objects[0] = b"<</Type/Catalog/Pages 2 0 R/ViewerPreferences<</PrintScaling/None>>>>"
        self.objects[1] = f"<</Type/Pages/Count {len(self.pages)}/Kids[{kids}]>>".encode()
        out, places = BytesIO(), []
        out.write(b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n")
        for number, body in enumerate(self.objects, 1):
            places.append(out.tell())
            out.write(b"%d 0 obj\n%s\nendobj\n" % (number, body))
        start = out.tell()
        out.write(b"xref\n0 %d\n0000000000 65535 f \n" % (len(places) + 1))
        out.write(b"".join(b"%010d 00000 n \n" % place for place in places))
        out.write(b"trailer\n<</Size %d/Root 1 0 R>>\nstartxref\n%d\n%%%%EOF\n" % (len(places) + 1, start))
        return out.getvalue()

    @property
    def _fonts(self) -> str:
        return f"/Font<</F {HEAD + 1} 0 R/B {HEAD + 2} 0 R>>"

    def _page(self, points: tuple[float, float], content: bytes, parts: Mapping[str, int]) -> None:
        used = "".join(f"/{name} {number} 0 R" for name, number in parts.items())
        kept = self._object(content)
        page = (
            f"<</Type/Page/Parent 2 0 R/MediaBox[0 0 {points[0]:.3f} {points[1]:.3f}]"
            f"/Resources<<{self._fonts}/XObject<<{used}>>>>/Contents {kept} 0 R>>"
        )
        self.pages.append(self._object(page.encode()))

    def _object(self, body: bytes) -> int:
        self.objects.append(body)
        return len(self.objects)


def op(name: str, *numbers: float) -> str:
    """An operator of a drawing with its numbers."""
    return " ".join([*(f"{number:.3f}" for number in numbers), name])


def path(points: Iterable[tuple[float, float]], paint: str) -> str:
    """Operators of a line through these points, painted by the operator `paint`."""
    return " ".join([*(op("l" if i else "m", *point) for i, point in enumerate(points)), paint])


def placed(scale: float, x: float, y: float) -> str:
    """The operator that scales what follows and moves its origin to (x, y)."""
    return f"{scale:.6f} 0 0 {scale:.6f} {x:.3f} {y:.3f} cm"


def written(line: str, x: float, y: float, size: float, bold: bool = False) -> str:
    """Operators of a drawing: a line of text from the left end of its base line, in the present colour; `size`: of its
    type, in the units of the drawing.
    """
    return f"BT /{'B' if bold else 'F'} {size:.3f} Tf 1 0 0 -1 {x:.3f} {y:.3f} Tm {_coded(line)} ET"


def _coded(line: str) -> str:
    return f"<{line.encode('cp1252', 'replace').hex()}> Tj"


def _packed(drawing: str, head: str = "") -> bytes:
    return _stream(zlib.compress(drawing.encode()), f"{head}/Filter/FlateDecode")


def _stream(raw: bytes, head: str = "") -> bytes:
    return f"<<{head}/Length {len(raw)}>>\nstream\n".encode() + raw + b"\nendstream"
