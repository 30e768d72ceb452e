"""Real things on the emulated mat: they hide and shade, are lit as on a mat, and stop robots."""

from math import hypot
from random import Random

import numpy as np
import pytest

from pigaming_app.hardware.emulator.arena import STARTS, EmulatedArena
from pigaming_app.hardware.emulator.optics import LAMP, Optics
from pigaming_app.hardware.emulator.robots import RADIUS, STEP, EmulatedRobot, random_parameters
from pigaming_app.hardware.emulator.things.overlay import patches, shaded
from pigaming_app.hardware.emulator.things.prism import TAPE, box, cylinder, distance, obstacles, push_off
from pigaming_app.hardware.emulator.things.random_scene import AWAY, some_things
from tests.hardware.emulator.test_emulator import found, newest

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
    x, y = np.array([robot.x, robot.y]) + 0.12 * (eye - (robot.x, robot.y))
    arena.furnish([box(x, y, 130.0, 130.0, 400.0)])
    arena.project(WHITE)
    assert sorted(number for number, _ in found(newest(arena).image)) == [0, 1, 3]
    arena.furnish([])
    assert sorted(number for number, _ in found(newest(arena).image)) == [0, 1, 2, 3]


def driven_at(thing, heading, seconds=1.5):
    """A robot that drives ahead from x = -300 mm, and its least distance from the thing, mm."""
    robot = EmulatedRobot(random_parameters(Random(1)), -300.0, 0.0, heading, Random(2))
    robot.left = robot.right = 1.0
    tall, nearest = obstacles([thing]), 1e9
    for _ in range(round(seconds / STEP)):
        robot.roll()
        push_off([robot], tall)
        nearest = min([nearest, *(distance(one, robot.x, robot.y)[0] for one in tall)])
    return robot, nearest


@pytest.mark.parametrize("thing", [box(0, 0, 150, 400, 60, 0.1), cylinder(0, 0, 45, 100), box(0, 0, 150, 400, 20)])
@pytest.mark.parametrize("heading", [-0.1, 0.0, 0.15])
def test_a_robot_that_runs_into_a_thing_never_enters_it(thing, heading):
    robot, nearest = driven_at(thing, heading)
    assert nearest == pytest.approx(RADIUS, abs=1e-6)
    assert robot.left_speed > 500.0  # its wheels slip


def test_a_robot_drives_over_tape_and_is_carried_over_anything():
    assert obstacles([box(0, 0, 25, 300, TAPE)]) == []
    robot, _ = driven_at(box(0, 0, 25, 300, TAPE), 0.0)
    assert robot.x > 200.0
    robot.x, robot.y, robot.height = 0.0, 0.0, 100.0
    push_off([robot], obstacles([box(0, 0, 100, 100, 80)]))
    assert (robot.x, robot.y) == (0.0, 0.0)


def test_a_robot_set_down_on_a_thing_is_pushed_off_by_the_shortest_way():
    robot = EmulatedRobot(random_parameters(Random(1)), 10.0, 3.0, 0.0, Random(2))
    push_off([robot], obstacles([box(0, 0, 100, 300, 80)]))
    assert robot.x == pytest.approx(50.0 + RADIUS)
    assert robot.y == pytest.approx(3.0)


@pytest.mark.parametrize("count", [0, 3, 8])
def test_things_of_a_seed_are_the_same_and_away_from_the_robots(count):
    optics = Optics()
    things, again = (some_things(4, count, optics, STARTS) for _ in range(2))
    assert things == again
    assert len(things) == count
    robots = optics.mat(np.array([(x + 160.0, y + 140.0) for x, y, _ in STARTS]))
    assert all(hypot(*(at - thing.middle)) > thing.reach + AWAY for thing in things for at in robots)
