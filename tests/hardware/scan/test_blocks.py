"""Marker blocks: walls of their printed size, followed by the camera, gone when they are taken away."""

from math import pi

import numpy as np
import pytest

cv2 = pytest.importorskip("cv2")

from pigaming_app.hardware.scan.blocks import BLOCK_HEIGHT, TIMEOUT, BlockTracker  # noqa: E402
from pigaming_app.hardware.signals import CameraFrame  # noqa: E402
from tests.hardware.grounds import nominal  # noqa: E402
from tests.hardware.pictures import lids, speckled, square  # noqa: E402

GROUND = nominal((1280, 720))
EDGE = 50.0 / GROUND.mm


def photo(blocks, number, time):
    """A picture of blocks, given as (marker, x, y, heading of the marker's upper edge in rad)."""
    marks = [(n, GROUND.to_camera(square((x, y, turn - pi / 2), EDGE), BLOCK_HEIGHT)) for n, x, y, turn in blocks]
    return CameraFrame(speckled(lids(marks), seed=number), time, number)


def test_a_block_is_a_wall_of_its_printed_size_under_its_marker():
    tracker = BlockTracker(GROUND)
    tracker.process(photo([(33, 400.0, 300.0, 0.4), (21, 1200.0, 600.0, 2.0)], 1, 0.0))
    small, long = tracker.things
    assert long.middle == pytest.approx((400.0, 300.0), abs=1.0)
    assert small.middle == pytest.approx((1200.0, 600.0), abs=1.0)
    sides = np.roll(long.points, -1, axis=0) - long.points
    assert np.hypot(*sides.T) * GROUND.mm == pytest.approx([160.0, 70.0, 160.0, 70.0])
    assert np.arctan2(sides[0, 1], sides[0, 0]) == pytest.approx(0.4, abs=0.03)
    assert long.height_mm == BLOCK_HEIGHT


def test_a_block_follows_the_hand_rests_without_jitter_and_goes_when_taken_away():
    tracker, middles = BlockTracker(GROUND), []
    for number in range(12):
        tracker.process(photo([(25, 400.0 + 20.0 * min(number, 3), 300.0, 0.0)], number, number / 30))
        middles.append(tracker.things[0].middle[0])
    assert middles[3] == pytest.approx(460.0, abs=4.0)
    assert np.std(middles[-6:]) < 0.2
    tracker.process(photo([], 30, 0.5))
    assert len(tracker.things) == 1
    tracker.process(photo([], 31, 0.5 + TIMEOUT))
    assert tracker.things == []


def test_two_blocks_with_one_number_are_two_walls_that_stay():
    tracker = BlockTracker(GROUND)
    for number in range(12):
        tracker.process(photo([(25, 400.0, 300.0, 0.0), (25, 1100.0 + 5.0 * number, 600.0, 1.0)], number, number / 30))
    assert sorted(thing.middle[0] for thing in tracker.things) == pytest.approx([400.0, 1155.0], abs=4.0)
    tracker.process(photo([(25, 1155.0, 600.0, 1.0)], 20, 0.5))
    tracker.process(photo([(25, 1155.0, 600.0, 1.0)], 21, 0.4 + TIMEOUT))
    assert [thing.middle[0] for thing in tracker.things] == [pytest.approx(1155.0, abs=2.0)]


def test_a_print_held_in_a_hand_is_no_wall():
    tracker = BlockTracker(GROUND)
    marks = [(22, GROUND.to_camera(square((700.0, 400.0, 0.0), EDGE), 500.0))]
    tracker.process(CameraFrame(speckled(lids(marks)), 0.0, 1))
    assert tracker.things == []
