"""Printable marker sheet, A4 pages as PDF, to scale: the robots' markers with a ruler to check the print, then blocks.

A marker is 50 mm wide with a quiet zone of one white cell, to cut out along the grey line; its triangle points ahead.
A block's print is as large as its top, with the marker in the middle: on a mat without a projector, blocks are walls.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from pigaming_app.hardware.calibration.ground_plane import MARKER
from pigaming_app.hardware.vision.markers import ROBOT_IDS, dictionary, opencv
from pigaming_app.storage.messages import OperatorError, OperatorMessage

PAGE = (210.0, 297.0)  # mm, A4
POINT = 72.0 / 25.4  # PDF points per mm
CELLS = 6  # of a marker with its black border, without the quiet zone
RULER = 100.0  # mm
SQUARE, LONG = (80.0, 80.0), (160.0, 70.0)  # mm: tops of blocks, along and across the upper edge of the marker
BLOCK_SIZES = {number: SQUARE if number < 32 else LONG for number in range(20, 40)}  # mm, by marker
BLOCK_PAGES = (range(20, 26), range(26, 32), range(32, 35), range(35, 38), range(38, 40))


def sheet(edge: float = MARKER, notes: Sequence[str] = (), block_notes: Sequence[str] = ()) -> bytes:
    """A PDF of the four robots' markers, each `edge` mm wide (20 to 60), with `notes` as lines below; then the blocks.

    Raises OpenCVMissing, OperatorError.
    """
    if not 20.0 <= edge <= 60.0:
        raise OperatorError(OperatorMessage("marker_edge", edge=f"{edge:g}"))
    blocks = [[*_blocks(numbers), *_words(block_notes, 14.0)] for numbers in BLOCK_PAGES]
    return _pdf(["\n".join(page) for page in ([*_markers(edge), *_ruler(), *_words(notes, 270.0)], *blocks)])


def cells(number: int) -> "np.ndarray[tuple[int, int], np.dtype[np.bool_]]":
    """The black cells of a marker, (6, 6) bool. Raises OpenCVMissing."""
    cv = opencv()
    return np.asarray(cv.aruco.generateImageMarker(dictionary(cv), number, CELLS) < 128)


def _markers(edge: float) -> Iterator[str]:
    cell, pitch = edge / CELLS, (90.0, 105.0)
    whole = edge + 2.0 * cell
    for i, number in enumerate(ROBOT_IDS):
        middle = PAGE[0] / 2.0 + (i % 2 - 0.5) * pitch[0]
        left, top = middle - edge / 2.0, 45.0 + (i // 2) * pitch[1]
        yield f"0.6 G {_box(left - cell, top - cell, whole, whole)} S 0 g"
        yield from _cells(number, left, top, cell)
        tip = top - cell - 6.0
        yield f"{_at(middle, tip)} m {_at(middle - 3, tip + 4.5)} l {_at(middle + 3, tip + 4.5)} l f"
        yield _text(left + edge + cell + 3.0, top + 8.0, 22, str(i + 1))


def _blocks(numbers: range) -> Iterator[str]:
    """The tops of some blocks of one size, with their numbers."""
    wide, high = BLOCK_SIZES[numbers[0]]
    columns = 2 if wide < PAGE[0] / 2.0 else 1
    for i, number in enumerate(numbers):
        middle = PAGE[0] / 2.0 + (i % columns - 0.5 * (columns - 1)) * (wide + 10.0)
        left, top = middle - wide / 2.0, 26.0 + (i // columns) * (high + 8.0)
        yield f"0.6 G {_box(left, top, wide, high)} S 0 g"
        yield from _cells(number, middle - MARKER / 2.0, top + (high - MARKER) / 2.0, MARKER / CELLS)
        yield _text(left + 1.5, top + 4.5, 9, str(number))


def _cells(number: int, left: float, top: float, cell: float) -> Iterator[str]:
    """The black cells of a marker."""
    for row, column in np.argwhere(cells(number)).tolist():
        yield f"{_box(left + column * cell, top + row * cell, cell, cell)} f"


def _ruler() -> Iterator[str]:
    left, y = (PAGE[0] - RULER) / 2.0, 258.0
    yield f"0 G {_at(left, y)} m {_at(left + RULER, y)} l S"
    for mm in range(0, int(RULER) + 1):
        tick = 6.0 if mm % 10 == 0 else 4.0 if mm % 5 == 0 else 2.5
        yield f"{_at(left + mm, y)} m {_at(left + mm, y - tick)} l S"
    for mm in range(0, int(RULER) + 1, 10):
        yield _text(left + mm - 1.0, y + 4.5, 8, str(mm))


def _words(notes: Sequence[str], top: float) -> Iterator[str]:
    """Notes, one a line, from `top` mm on; under the program's name, if there is room."""
    if top > 30.0:
        yield _text(20.0, 22.0, 16, "PiGaming")
    for i, note in enumerate(notes):
        yield _text(20.0, top + 5.0 * i, 9, note)


def _at(x: float, y: float) -> str:
    """A point in mm from the top left, in PDF points from the bottom left."""
    return f"{x * POINT:.3f} {(PAGE[1] - y) * POINT:.3f}"


def _box(x: float, y: float, wide: float, high: float) -> str:
    return f"{_at(x, y + high)} {wide * POINT:.3f} {high * POINT:.3f} re"


def _text(x: float, y: float, size: int, text: str) -> str:
    escaped = text.replace("\\", r"\\").replace("(", r"\(").replace(")", r"\)")
    return f"BT /F1 {size} Tf {_at(x, y)} Td ({escaped}) Tj ET"


def _pdf(pages: Sequence[str]) -> bytes:
    """A PDF 1.4 file of these drawings, one a page: objects and their cross-reference table."""
    size = f"[0 0 {PAGE[0] * POINT:.3f} {PAGE[1] * POINT:.3f}]".encode()
    numbers = range(4, 4 + 2 * len(pages), 2)
    kids = b" ".join(b"%d 0 R" % number for number in numbers)
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>",
        b"<< /Type /Pages /Kids [%s] /Count %d >>" % (kids, len(pages)),
        b"<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>",
    ]
    for number, drawing in zip(numbers, pages, strict=True):
        stream = b"0.3 w\n" + drawing.encode("cp1252")
        objects += [
            b"<< /Type /Page /Parent 2 0 R /MediaBox %s /Contents %d 0 R " % (size, number + 1)
            + b"/Resources << /Font << /F1 3 0 R >> >> >>",
            b"<< /Length %d >>\nstream\n%s\nendstream" % (len(stream), stream),
        ]
    out, begins = bytearray(b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n"), []
    for number, body in enumerate(objects, 1):
        begins.append(len(out))
        out += b"%d 0 obj\n%s\nendobj\n" % (number, body)
    count, table = len(objects) + 1, b"".join(b"%010d 00000 n \n" % begin for begin in begins)
    end = b"trailer << /Size %d /Root 1 0 R >>\nstartxref\n%d\n%%%%EOF\n" % (count, len(out))
    return bytes(out + b"xref\n0 %d\n0000000000 65535 f \n%s" % (count, table) + end)
