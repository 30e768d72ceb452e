"""PDF files of pictures, with the text on them, so that they can be searched and read aloud."""

from collections.abc import Iterable
from io import BytesIO

WrittenLine = tuple[str, float, float, int]
"""A line of text, the left end of its base line and the size of its type, px."""


class PdfFile:
    """A PDF (ISO 32000-1) whose pages are pictures; `dpi`: px of an inch."""

    def __init__(self, dpi: float) -> None:
        self.points = 72 / dpi  # of a px
        self.objects: list[bytes] = [
            b"",
            b"",
            b"<</Type/Font/Subtype/Type1/BaseFont/Helvetica/Encoding/WinAnsiEncoding>>",
        ]
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
        drawn = [f"q {w * points:.2f} 0 0 {h * points:.2f} 0 0 cm /Im Do Q BT 3 Tr".encode()]
        for line, x, y, high in lines:
            drawn.append(f"/F {high * points:.2f} Tf 1 0 0 1 {x * points:.2f} {(h - y) * points:.2f} Tm".encode())
            drawn.append(b"<" + line.encode("cp1252", "replace").hex().encode() + b"> Tj")
        content = self._object(_stream(b"\n".join([*drawn, b"ET"])))
        used = f"<</Font<</F 3 0 R>>/XObject<</Im {picture} 0 R>>>>"
        box = f"/MediaBox[0 0 {w * points:.2f} {h * points:.2f}]"
        page = f"<</Type/Page/Parent 2 0 R{box}/Resources{used}/Contents {content} 0 R>>"
        self.pages.append(self._object(page.encode()))

    def packed(self) -> bytes:
        """The file."""
        kids = " ".join(f"{page} 0 R" for page in self.pages)
        self.objects[0] = b"<</Type/Catalog/Pages 2 0 R>>"
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

    def _object(self, body: bytes) -> int:
        self.objects.append(body)
        return len(self.objects)


def _stream(raw: bytes, head: str = "") -> bytes:
    return f"<<{head}/Length {len(raw)}>>\nstream\n".encode() + raw + b"\nendstream"
