"""Emulated robots stop at tall things and drive over flat ones."""

from math import hypot
from random import Random

import numpy as np
import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.emulator.arena import STARTS
from pigaming_app.hardware.emulator.optics import Optics
from pigaming_app.hardware.emulator.robots import RADIUS, STEP, EmulatedRobot, random_parameters
from pigaming_app.hardware.emulator.things.contact import distance, obstacles, push_off
from pigaming_app.hardware.emulator.things.prism import TAPE, box, cylinder
from pigaming_app.hardware.emulator.things.random_scene import AWAY, some_things


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
