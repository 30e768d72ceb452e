"""Printable marker sheet: the robots' markers on an A4 page as PDF, to scale, with a ruler to check the print.

A marker is 50 mm wide with a quiet zone of one white cell, to cut out along the grey line; its triangle points ahead.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from pigaming_app.hardware.calibration.ground_plane import MARKER
from pigaming_app.hardware.messages import OperatorError, OperatorMessage
from pigaming_app.hardware.vision.markers import ROBOT_IDS, opencv

PAGE = (210.0, 297.0)  # mm, A4
POINT = 72.0 / 25.4  # PDF points per mm
CELLS = 6  # of a marker with its black border, without the quiet zone
RULER = 100.0  # mm


class MarkerSheetError(OperatorError):
    """A marker size that fits neither the page nor a robot."""


def sheet(edge: float = MARKER, notes: Sequence[str] = ()) -> bytes:
    """A PDF of the four robots' markers, each `edge` mm wide (20 to 60), with `notes` as lines below.

    Raises OpenCVMissing, MarkerSheetError.
    """
    if not 20.0 <= edge <= 60.0:
        raise MarkerSheetError(OperatorMessage("marker_edge", edge=f"{edge:g}"))
    return _pdf("\n".join([*_markers(edge), *_ruler(), *_words(notes)]))


def cells(number: int) -> "np.ndarray[tuple[int, int], np.dtype[np.bool_]]":
    """The black cells of a marker, (6, 6) bool. Raises OpenCVMissing."""
    cv = opencv()
    dictionary = cv.aruco.getPredefinedDictionary(cv.aruco.DICT_4X4_50)
    return np.asarray(cv.aruco.generateImageMarker(dictionary, number, CELLS) < 128)


def _markers(edge: float) -> Iterator[str]:
    cell, pitch = edge / CELLS, (90.0, 105.0)
    whole = edge + 2.0 * cell
    for i, number in enumerate(ROBOT_IDS):
        middle = PAGE[0] / 2.0 + (i % 2 - 0.5) * pitch[0]
        left, top = middle - edge / 2.0, 45.0 + (i // 2) * pitch[1]
        yield f"0.6 G {_box(left - cell, top - cell, whole, whole)} S 0 g"
        for row, column in np.argwhere(cells(number)).tolist():
            yield f"{_box(left + column * cell, top + row * cell, cell, cell)} f"
        tip = top - cell - 6.0
        yield f"{_at(middle, tip)} m {_at(middle - 3, tip + 4.5)} l {_at(middle + 3, tip + 4.5)} l f"
        yield _text(left + edge + cell + 3.0, top + 8.0, 22, str(i + 1))


def _ruler() -> Iterator[str]:
    left, y = (PAGE[0] - RULER) / 2.0, 258.0
    yield f"0 G {_at(left, y)} m {_at(left + RULER, y)} l S"
    for mm in range(0, int(RULER) + 1):
        tick = 6.0 if mm % 10 == 0 else 4.0 if mm % 5 == 0 else 2.5
        yield f"{_at(left + mm, y)} m {_at(left + mm, y - tick)} l S"
    for mm in range(0, int(RULER) + 1, 10):
        yield _text(left + mm - 1.0, y + 4.5, 8, str(mm))


def _words(notes: Sequence[str]) -> Iterator[str]:
    yield _text(20.0, 22.0, 16, "PiGaming")
    for i, note in enumerate(notes):
        yield _text(20.0, 270.0 + 5.0 * i, 9, note)


def _at(x: float, y: float) -> str:
    """A point in mm from the top left, in PDF points from the bottom left."""
    return f"{x * POINT:.3f} {(PAGE[1] - y) * POINT:.3f}"


def _box(x: float, y: float, wide: float, high: float) -> str:
    return f"{_at(x, y + high)} {wide * POINT:.3f} {high * POINT:.3f} re"


def _text(x: float, y: float, size: int, text: str) -> str:
    escaped = text.replace("\\", r"\\").replace("(", r"\(").replace(")", r"\)")
    return f"BT /F1 {size} Tf {_at(x, y)} Td ({escaped}) Tj ET"


def _pdf(drawing: str) -> bytes:
    """A PDF 1.4 file of one page: objects and their cross-reference table."""
    stream = b"0.3 w\n" + drawing.encode("cp1252")
    size = f"[0 0 {PAGE[0] * POINT:.3f} {PAGE[1] * POINT:.3f}]".encode()
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        b"<< /Type /Page /Parent 2 0 R /MediaBox " + size + b" /Contents 4 0 R "
        b"/Resources << /Font << /F1 5 0 R >> >> >>",
        b"<< /Length %d >>\nstream\n%s\nendstream" % (len(stream), stream),
        b"<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>",
    ]
    out, begins = bytearray(b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n"), []
    for number, body in enumerate(objects, 1):
        begins.append(len(out))
        out += b"%d 0 obj\n%s\nendobj\n" % (number, body)
    count, table = len(objects) + 1, b"".join(b"%010d 00000 n \n" % begin for begin in begins)
    end = b"trailer << /Size %d /Root 1 0 R >>\nstartxref\n%d\n%%%%EOF\n" % (count, len(out))
    return bytes(out + b"xref\n0 %d\n0000000000 65535 f \n%s" % (count, table) + end)
