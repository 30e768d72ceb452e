"""The marker sheet is to scale, by the coordinates in the file."""

import re

import numpy as np
import pytest

from pigaming_app.hardware.calibration.marker_sheet import BLOCK_SIZES, sheet
from pigaming_app.hardware.vision.markers import ROBOT_IDS, MarkerDetector
from pigaming_app.storage.messages import OperatorError
from tests.hardware.sentences import refused

MM = 72.0 / 25.4  # PDF points


def filled(file, number=0):
    """The black boxes of a page in points: (left, bottom, width, height)."""
    page = file.split(b"\nstream\n")[number + 1]
    return [tuple(map(float, found)) for found in re.findall(rb"([\d.]+) ([\d.]+) ([\d.]+) ([\d.]+) re f", page)]


def painted(boxes, scale=2.0):
    """The boxes rasterized on an A4 page, `scale` px per point."""
    picture = np.full((round(842 * scale), round(595 * scale)), 255, np.uint8)
    for left, bottom, wide, high in boxes:
        top = 841.89 - bottom - high
        picture[
            round(top * scale) : round((top + high) * scale), round(left * scale) : round((left + wide) * scale)
        ] = 0
    return picture


@pytest.mark.parametrize("edge", [50.0, 40.0])
def test_the_markers_are_as_large_as_they_should_be(edge):
    found = sorted(MarkerDetector(range(50)).detect(painted(filled(sheet(edge)))), key=lambda mark: mark.number)
    assert [mark.number for mark in found] == list(ROBOT_IDS)
    for mark in found:
        sides = np.sqrt(((mark.corners - np.roll(mark.corners, 1, axis=0)) ** 2).sum(axis=1))
        assert sides / 2.0 / MM == pytest.approx([edge] * 4, abs=0.5)
        assert mark.corners[0, 1] < mark.corners[2, 1]  # the top of each is up, where its triangle is


def test_the_blocks_follow_each_in_the_middle_of_its_print():
    file, numbers = sheet(), []
    for page in range(1, 6):
        text = file.split(b"\nstream\n")[page + 1]
        prints = [tuple(map(float, found)) for found in re.findall(rb"0.6 G (\S+) (\S+) (\S+) (\S+) re S", text)]
        marks = MarkerDetector(range(50)).detect(painted(filled(file, page)))
        for mark in sorted(marks, key=lambda mark: mark.number):
            x, y = mark.corners.mean(axis=0) / 2.0
            left, bottom, wide, high = min(
                prints, key=lambda box: abs(box[0] + box[2] / 2 - x) + abs(841.89 - box[1] - box[3] / 2 - y)
            )
            assert (x, 841.89 - y) == pytest.approx((left + wide / 2, bottom + high / 2), abs=1.0)
            assert (wide / MM, high / MM) == pytest.approx(BLOCK_SIZES[mark.number], abs=0.01)
            assert 5 * MM < left < left + wide < 205 * MM
            assert bottom > 5 * MM
            numbers.append(mark.number)
    assert numbers == list(BLOCK_SIZES)


def test_the_ruler_is_a_hundred_millimetres():
    ticks = re.findall(rb"([\d.]+) ([\d.]+) m ([\d.]+) ([\d.]+) l S", sheet())
    upright = sorted({float(x) for x, _, to, _ in ticks if x == to})
    assert len(upright) == 101
    assert (upright[-1] - upright[0]) / MM == pytest.approx(100.0, abs=0.01)


def test_the_table_of_the_file_points_at_its_objects():
    page = sheet()
    begins = [int(found) for found in re.findall(rb"(\d{10}) 00000 n", page)]
    assert [page[begin:].split(b" ", 1)[0] for begin in begins] == [b"%d" % number for number in range(1, 16)]
    assert page[int(page.rsplit(b"startxref\n", 1)[1].split()[0]) :].startswith(b"xref")
    for stream in page.split(b"/Length ")[1:]:
        length, content = stream.split(b" >>\nstream\n", 1)
        assert content[int(length) :].startswith(b"\nendstream")


@pytest.mark.parametrize("edge", [0.0, 500.0])
def test_what_does_not_fit_is_refused(edge):
    with refused(OperatorError, "20 to 60 mm"):
        sheet(edge)
