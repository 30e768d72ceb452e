"""The marker sheet is to scale, as PDFium renders it."""

import numpy as np
import pytest

pytest.importorskip("cv2")
pytest.importorskip("pypdfium2")

from pigaming_app.hardware.scan.blocks import BLOCK_SIZES
from pigaming_app.hardware.vision.markers import ROBOT_IDS
from pigaming_app.scenes.mat.paper.marker_sheet import sheet
from pigaming_app.storage.messages import OperatorError
from tests.hardware.sentences import refused
from tests.scenes.mat.paper.rendered import found, pictures, sizes

PER_MM = 8.0


@pytest.mark.parametrize("edge", [50.0, 40.0])
def test_the_markers_are_as_large_as_they_should_be(edge):
    (picture,) = pictures(sheet(edge), PER_MM, [0])
    marks = found(picture, PER_MM)
    assert sorted(marks) == sorted(ROBOT_IDS)
    for mark in marks.values():
        assert np.hypot(*(mark - np.roll(mark, 1, axis=0)).T) == pytest.approx([edge] * 4, abs=0.25)
        assert mark[0, 1] < mark[2, 1]  # the top of each is up, where its triangle is


def test_the_blocks_follow_each_in_the_middle_of_its_print():
    numbers = []
    for picture in pictures(sheet(), PER_MM, range(1, 6)):
        for number, mark in sorted(found(picture, PER_MM).items()):
            (x, y), (wide, high) = mark.mean(axis=0), BLOCK_SIZES[number]
            for side in (-1, 1):  # the grey line on each side of the block, seen from its marker
                across = picture[round(y * PER_MM), :] < 240
                down = picture[:, round(x * PER_MM)] < 240
                edge, rim = round((x + side * wide / 2) * PER_MM), round((y + side * high / 2) * PER_MM)
                assert across[edge - 4 : edge + 4].any()
                assert down[rim - 4 : rim + 4].any()
                assert 5 * PER_MM < edge < 205 * PER_MM
                assert 5 * PER_MM < rim < 292 * PER_MM
            numbers.append(number)
    assert numbers == list(BLOCK_SIZES)


def test_the_ruler_is_a_hundred_millimetres():
    (picture,) = pictures(sheet(), PER_MM, [0])
    ticks = picture[round(256.5 * PER_MM)] < 160  # through the ticks of 1 mm above the line at 258 mm
    begins = np.flatnonzero(ticks[1:] & ~ticks[:-1]) / PER_MM
    assert len(begins) == 101
    assert begins[-1] - begins[0] == pytest.approx(100.0, abs=0.15)


def test_pages_are_A4():  # noqa: N802
    assert sizes(sheet()) == [pytest.approx((210.0, 297.0), abs=0.01)] * 6


@pytest.mark.parametrize("edge", [0.0, 500.0])
def test_what_does_not_fit_is_refused(edge):
    with refused(OperatorError, "20 to 60 mm"):
        sheet(edge)
