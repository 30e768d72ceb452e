"""Printable marker sheet, A4 pages as PDF, to scale: the robots' markers with a ruler to check the print, then blocks.

A marker is 50 mm wide with a quiet zone of one white cell, to cut out along the grey line; its triangle points ahead.
A block's print is as large as its top, with the marker in the middle: on a mat without a projector, blocks are walls.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from pigaming_app.hardware.calibration.ground_plane import MARKER
from pigaming_app.hardware.scan.blocks import BLOCK_SIZES
from pigaming_app.hardware.vision.markers import CELLS, ROBOT_IDS, cells
from pigaming_app.storage.messages import OperatorError, OperatorMessage
from pigaming_app.ui.pdf import PdfFile, op, path, written

PAGE = (210.0, 297.0)  # mm, A4
RULER = 100.0  # mm
BLOCK_PAGES = (range(20, 26), range(26, 32), range(32, 35), range(35, 38), range(38, 40))


def sheet(edge: float = MARKER, notes: Sequence[str] = (), block_notes: Sequence[str] = ()) -> bytes:
    """A PDF of the four robots' markers, each `edge` mm wide (20 to 60), with `notes` as lines below; then the blocks.

    Raises OpenCVMissing, OperatorError.
    """
    if not 20.0 <= edge <= 60.0:
        raise OperatorError(OperatorMessage("marker_edge", edge=f"{edge:g}"))
    blocks = [[*_blocks(numbers), *_words(block_notes, 14.0)] for numbers in BLOCK_PAGES]
    pdf = PdfFile()
    for page in ([*_markers(edge), *_ruler(), *_words(notes, 270.0)], *blocks):
        pdf.draw(PAGE, "\n".join(["0.1 w", *page]))
    return pdf.packed()


def _markers(edge: float) -> Iterator[str]:
    cell, pitch = edge / CELLS, (90.0, 105.0)
    whole = edge + 2.0 * cell
    for i, number in enumerate(ROBOT_IDS):
        middle = PAGE[0] / 2.0 + (i % 2 - 0.5) * pitch[0]
        left, top = middle - edge / 2.0, 45.0 + (i // 2) * pitch[1]
        yield f"0.6 G {op('re', left - cell, top - cell, whole, whole)} S 0 g"
        yield marker(number, left, top, edge)
        tip = top - cell - 6.0
        yield path([(middle, tip), (middle - 3, tip + 4.5), (middle + 3, tip + 4.5)], "f")
        yield _text(left + edge + cell + 3.0, top + 8.0, 22, str(i + 1))


def _blocks(numbers: range) -> Iterator[str]:
    """The tops of some blocks of one size, with their numbers."""
    wide, high = BLOCK_SIZES[numbers[0]]
    columns = 2 if wide < PAGE[0] / 2.0 else 1
    for i, number in enumerate(numbers):
        middle = PAGE[0] / 2.0 + (i % columns - 0.5 * (columns - 1)) * (wide + 10.0)
        left, top = middle - wide / 2.0, 26.0 + (i // columns) * (high + 8.0)
        yield f"0.6 G {op('re', left, top, wide, high)} S 0 g"
        yield marker(number, middle - MARKER / 2.0, top + (high - MARKER) / 2.0, MARKER)
        yield _text(left + 1.5, top + 4.5, 9, str(number))


def marker(number: int, left: float, top: float, edge: float) -> str:
    """Operators of the black cells of a marker with its upper left corner there. Raises OpenCVMissing."""
    cell, black = edge / CELLS, np.argwhere(cells(number)).tolist()
    boxes = (op("re", left + column * cell, top + row * cell, cell, cell) for row, column in black)
    return "\n".join([*boxes, "f"])  # one path, without seams


def _ruler() -> Iterator[str]:
    left, y = (PAGE[0] - RULER) / 2.0, 258.0
    yield f"0 G {path([(left, y), (left + RULER, y)], 'S')}"
    for mm in range(0, int(RULER) + 1):
        tick = 6.0 if mm % 10 == 0 else 4.0 if mm % 5 == 0 else 2.5
        yield path([(left + mm, y), (left + mm, y - tick)], "S")
    for mm in range(0, int(RULER) + 1, 10):
        yield _text(left + mm - 1.0, y + 4.5, 8, str(mm))


def _words(notes: Sequence[str], top: float) -> Iterator[str]:
    """Notes, one a line, from `top` mm on; under the program's name, if there is room."""
    if top > 30.0:
        yield _text(20.0, 22.0, 16, "PiGaming")
    for i, note in enumerate(notes):
        yield _text(20.0, top + 5.0 * i, 9, note)


def _text(x: float, y: float, points: float, text: str) -> str:
    return written(text, x, y, points * 25.4 / 72.0)
