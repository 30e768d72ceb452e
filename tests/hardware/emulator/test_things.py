"""Real things on the emulated mat: they hide, they shade, and light lands on them where it does on a mat."""

import numpy as np
import pytest

cv2 = pytest.importorskip("cv2")

from pigaming_app.hardware.emulator.arena import EmulatedArena  # noqa: E402
from pigaming_app.hardware.emulator.optics import LAMP, Optics  # noqa: E402
from pigaming_app.hardware.emulator.things.overlay import patches, shaded  # noqa: E402
from pigaming_app.hardware.emulator.things.prism import box, cylinder  # noqa: E402
from tests.hardware.emulator.test_emulator import found, newest  # noqa: E402

MAT = np.full((1080, 1920), 0.85, np.float32)
WHITE = np.full((1080, 1920), 255, np.uint8)


def light(things, image=WHITE):
    """Projected light that the camera sees, as a share; nan away from the things."""
    optics, whole = Optics(), np.full((1080, 1920), np.nan, np.float32)
    for patch in patches(things, optics, MAT):
        whole[patch.rows, patch.columns] = patch.projected(image, 0.7)
    return optics, whole


def at(optics, whole, x, y, height=0.0):
    u, v = np.rint(optics.sensor(np.array([(x, y)]), height)[0]).astype(int)
    return float(whole[v, u])


def test_a_box_is_seen_above_its_place_and_shades_the_mat_away_from_the_projector():
    optics, whole = light([box(600.0, 200.0, 120.0, 80.0, 100.0, grey=0.4)])
    grown = (LAMP[2] / (LAMP[2] - 100.0)) ** 2
    assert at(optics, whole, 600.0, 200.0, 100.0) == pytest.approx(0.4 * grown, abs=0.03)
    away = np.array([600.0, 200.0]) - LAMP[:2]
    shadow = LAMP[:2] + away * LAMP[2] / (LAMP[2] - 95.0) + (55.0, 35.0)  # of a corner of the top
    assert at(optics, whole, *shadow) < 0.1
    assert at(optics, whole, *(shadow + np.array((15.0, 14.0)))) == pytest.approx(0.85, abs=0.03)
    assert at(optics, whole, 600.0, 150.0) == pytest.approx(0.85, abs=0.03)  # the side of the projector


def test_light_on_a_top_comes_from_the_canvas_px_that_geometry_gives():
    optics = Optics()
    u, v = np.rint(optics.canvas(np.array([(-400.0, 100.0)]), 150.0)[0]).astype(int)
    image = np.zeros((1080, 1920), np.uint8)
    image[v - 6 : v + 7, u - 6 : u + 7] = 255
    optics, whole = light([cylinder(-400.0, 100.0, 60.0, 150.0, grey=0.9)], image)
    spot = np.nan_to_num(whole)
    rows, columns = np.mgrid[0:1080, 0:1920]
    centre = (spot * columns).sum() / spot.sum(), (spot * rows).sum() / spot.sum()
    assert centre == pytest.approx(optics.sensor(np.array([(-400.0, 100.0)]), 150.0)[0], abs=0.7)


def test_a_robot_in_the_shadow_of_a_tower_is_not_lit():
    tower = box(0.0, 0.0, 100.0, 100.0, 300.0)
    behind = LAMP[:2] + (np.array([0.0, 0.0]) - LAMP[:2]) * (LAMP[2] - 70.0) / (LAMP[2] - 200.0)
    x, y = (np.array([value], np.float32) for value in behind)
    assert shaded([tower], x, y, 70.0).all()
    assert not shaded([tower], x, y, 300.0).any()
    assert not shaded([tower], -x - 200.0, y - 200.0, 70.0).any()


def test_a_tower_hides_the_robot_behind_it_from_the_camera():
    arena = EmulatedArena(1)
    eye, robot = np.array(arena.optics.lens.eye[:2]), arena.robots[2]
    between = np.array([robot.x, robot.y]) + 0.12 * (eye - (robot.x, robot.y))
    arena.furnish([box(*between, 130.0, 130.0, 400.0)])
    arena.project(WHITE)
    assert sorted(number for number, _ in found(newest(arena).image)) == [0, 1, 3]
    arena.furnish([])
    assert sorted(number for number, _ in found(newest(arena).image)) == [0, 1, 2, 3]
