"""Things as games get them: outlines of masks, their file, removal by hand; marker blocks."""

from dataclasses import replace
from math import pi

import cv2
import numpy as np
import pytest

from pigaming_app.games.arenas import load, on_mat
from pigaming_app.hardware.scan.blocks import BLOCK_HEIGHT, TIMEOUT, BlockTracker
from pigaming_app.hardware.scan.convex import convex_parts
from pigaming_app.hardware.scan.things import (
    LayoutError,
    ProjectorPlace,
    Thing,
    ThingKind,
    ThingLayout,
    largest,
    moved_outwards,
    read,
    to_toml,
)
from pigaming_app.hardware.session.store import load_things, save_things
from pigaming_app.hardware.signals import CameraFrame
from pigaming_app.sim.things.convex import is_convex, signed_area
from pigaming_app.sim.things.spec import MOST, Use
from tests.hardware.mat import nominal
from tests.hardware.pictures import lids, speckled, square
from tests.hardware.sentences import refused

BOX = Thing(ThingKind.TALL, ((100.0, 100.0), (200.0, 110.0), (190.0, 180.0), (95.0, 170.0)), 82.5, 3.25)
TAPE = Thing(ThingKind.FLAT, ((500.0, 500.0), (700.0, 500.0), (700.0, 519.0), (500.0, 519.0)), 0.0, 3.0)
LAYOUT = ThingLayout((BOX, TAPE), ProjectorPlace((712.0, 23.0), 2700.0))


def test_a_square_grows_by_the_same_distance_on_every_side():
    square = np.array([(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)])
    grown = [(-2.0, -2.0), (12.0, -2.0), (12.0, 12.0), (-2.0, 12.0)]
    assert moved_outwards(square, 2.0) == pytest.approx(np.array(grown))
    assert moved_outwards(square[::-1], 2.0) == pytest.approx(np.array(grown[::-1]))


def test_a_thing_is_removed_by_pointing_at_it():
    pointed = [thing for thing in LAYOUT.things if thing.contains(150.0, 140.0)]
    assert LAYOUT.without(pointed[0]).things == (TAPE,)
    assert LAYOUT.without(pointed[0]).projector == LAYOUT.projector


def test_the_things_stay_on_the_mat_until_the_next_start(tmp_path):
    path = tmp_path / "things.toml"
    assert load_things(path) == ThingLayout()
    save_things(LAYOUT, path)
    assert load_things(path) == LAYOUT


def test_tape_is_mud_by_choice_and_everything_tall_a_wall():
    chosen = read(to_toml(LAYOUT.replaced(TAPE, TAPE.as_mud(True))))
    assert [thing.use for thing in chosen.things] == [Use.WALL, Use.MUD]
    assert BOX.as_mud(True).use is Use.WALL


def test_an_arena_gets_things_with_straight_sides_in_either_order_of_corners():
    noisy = Thing(ThingKind.TALL, ((0.0, 0.0), (50.0, 0.04), (100.0, 0.0), (100.0, 60.0), (0.0, 60.0)), 80.0, 3.0)
    spec = noisy.spec
    assert is_convex(spec.outline)
    assert len(spec.outline) == 4
    assert replace(noisy, outline=noisy.outline[::-1]).spec == spec
    arena = load("pitanks", "classic")
    assert on_mat("pitanks", arena, [spec]).things == (spec,)
    assert on_mat("pitanks", arena, []) is arena


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("version = 1", "version = 9"),
        ('"tall"', '"huge"'),
        ("82.5", "-1.0"),
        ("110.0", "300.0"),  # not convex
        ("2700.0", "nan"),
        ("version = 1", "version = "),
        ("margin_px", "margin"),
    ],
)
def test_a_damaged_file_asks_for_a_new_scan(old, new):
    with refused(LayoutError, "scan again"):
        read(to_toml(LAYOUT).replace(old, new))


def test_of_too_many_things_the_tall_and_large_ones_stay():
    kept = largest([TAPE] * MOST + [BOX] * 2)
    assert kept[:2] == (BOX, BOX)
    assert len(kept) == MOST


ORIGIN = (160, 140)  # canvas px of arena px 0, 0


def painted(*polygons):
    mask = np.zeros((300, 300), np.uint8)
    for polygon in polygons:
        cv2.fillConvexPoly(mask, np.array(polygon, np.int32), 1)
    return mask


def test_a_box_that_lost_its_corners_gets_them_back():
    box = [(50, 60), (150, 100), (120, 180), (20, 140)]
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (7, 7))
    (found,) = convex_parts(cv2.morphologyEx(painted(box), cv2.MORPH_OPEN, kernel).astype(np.uint8), ORIGIN)
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
