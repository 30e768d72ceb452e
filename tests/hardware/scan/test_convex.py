"""Outlines of masks: convex, few corners, and more than one where a hull would cover the free mat."""

import numpy as np
import pytest

cv2 = pytest.importorskip("cv2")

from pigaming_app.hardware.scan.convex import convex_parts  # noqa: E402
from pigaming_app.sim.things.convex import signed_area  # noqa: E402

ORIGIN = (160, 140)  # canvas px of arena px 0, 0


def painted(*polygons):
    mask = np.zeros((300, 300), np.uint8)
    for polygon in polygons:
        cv2.fillConvexPoly(mask, np.array(polygon, np.int32), 1)
    return mask


def test_a_box_that_lost_its_corners_gets_them_back():
    box = [(50, 60), (150, 100), (120, 180), (20, 140)]
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (7, 7))
    (found,) = convex_parts(cv2.morphologyEx(painted(box), cv2.MORPH_OPEN, kernel), ORIGIN)
    assert len(found) == 4
    assert all(np.hypot(*(found - corner).T).min() < 3.0 for corner in box)


def test_boxes_side_by_side_whose_fronts_are_not_in_line_are_two_outlines():
    parts = convex_parts(
        painted([(20, 20), (95, 20), (95, 80), (20, 80)], [(95, 28), (170, 28), (170, 72), (95, 72)]), ORIGIN
    )
    assert len(parts) == 2


def test_a_rough_side_is_not_cut():
    """As of a far box in a tilted picture of 720p."""
    dented = [[(20, 20), (95, 20), (95, 60), (20, 60)], [(20, 60), (57, 60), (20, 66)], [(57, 60), (95, 60), (95, 66)]]
    assert len(convex_parts(painted(*dented), ORIGIN)) == 1


def test_a_round_cup_stays_round():
    turns = np.arange(60) * np.pi / 30
    (found,) = convex_parts(painted(100 + 40 * np.column_stack([np.cos(turns), np.sin(turns)])), ORIGIN)
    assert np.hypot(*(found - 100).T) == pytest.approx([40.0] * len(found), abs=1.5)


@pytest.mark.parametrize("turn", [0.0, 0.1, 0.5, 0.7, 1.3])
def test_an_angle_of_two_boxes_is_two_outlines(turn):
    c, s = np.cos(turn), np.sin(turn)
    bars = [(20, 20), (220, 20), (220, 60), (20, 60)], [(20, 20), (60, 20), (60, 200), (20, 200)]
    mask = painted(*((np.array(bar) - 110) @ np.array([[c, s], [-s, c]]) + 150 for bar in bars))
    parts = convex_parts(mask, ORIGIN)
    assert len(parts) == 2
    assert sum(abs(signed_area(part.tolist())) for part in parts) == pytest.approx(float(mask.sum()), rel=0.08)
