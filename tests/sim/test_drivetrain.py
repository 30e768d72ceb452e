"""Wheels, shares and twists, and a simulated robot that drives like a measured one."""

from math import pi

import pytest

from pigaming_app.sim.drivetrain import NOMINAL, Drivetrain, DrivetrainError, Wheel, parse, to_toml, twist, wheel_shares
from pigaming_app.sim.plant import SimPlant
from tests.floor import floor

UNEVEN = Drivetrain(Wheel(700.0, 0.05), Wheel(800.0, 0.10), 60.0, 0.05, 0.06)


def test_a_robot_that_goes_straight_turns_both_wheels_alike():
    left, right = wheel_shares(NOMINAL, NOMINAL.left.speed / 2, 0.0)
    assert left == right == pytest.approx(0.5)


def test_turning_right_on_the_spot_needs_the_left_wheel_ahead():
    left, right = wheel_shares(NOMINAL, 0.0, pi)
    assert left == pytest.approx(pi * NOMINAL.base / 2 / NOMINAL.left.speed)
    assert right == -left


@pytest.mark.parametrize("asked", [(260.0, 0.0), (-120.0, 1.5), (0.0, -3.0), (300.0, 2.0), (1.0, 0.0), (0.0, 0.0)])
def test_what_was_asked_is_what_comes_out_whatever_the_wheels_are_like(asked):
    assert twist(UNEVEN, *wheel_shares(UNEVEN, *asked)) == pytest.approx(asked)


def test_below_the_deadband_a_wheel_stands_still():
    assert twist(UNEVEN, 0.04, -0.09) == (0.0, 0.0)
    assert twist(UNEVEN, 0.06, 0.0)[0] > 0.0


def test_too_much_is_slowed_without_changing_the_bend():
    linear, angular = twist(UNEVEN, *wheel_shares(UNEVEN, 2000.0, 10.0))
    assert linear < 800.0
    assert linear / angular == pytest.approx(200.0)


def test_a_file_brings_back_what_was_written():
    (one, other) = parse(to_toml([UNEVEN, NOMINAL]), "robots.toml")
    assert one == UNEVEN
    assert other.left.speed == pytest.approx(NOMINAL.left.speed, abs=0.01)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "robots.toml: robot: 0 robots"),
        ("robot = 3", "robot: must be written as [[robot]]"),
        ("[[robot]]\nleft = [700, 0]\nright = [700, 0]\nbase = 60\nlag = 0.1", "robot[1].dead_time"),
        ("[[robot]]\nleft = [0, 0]\nright = [700, 0]\nbase = 60\nlag = 0.1\ndead_time = 0", "robot[1].left"),
        ("[[robot]]\nleft = [700, nan]\n", "robot[1].left"),
        ("[[robot]", "robots.toml: syntax"),
    ],
)
def test_a_file_that_cannot_be_used_is_refused_in_one_line(text, said):
    with pytest.raises(DrivetrainError, match=r"robots\.toml") as caught:
        parse(text, "robots.toml")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_simulated_robot_answers_as_late_and_as_lazily_as_the_measured_one():
    world = floor(poses=[(200.0, 300.0, 0.0), (200.0, 600.0, 0.0)])
    plant = SimPlant(world, [UNEVEN])
    late, own = world.robots[0], world.robots[1]
    for _ in range(3):  # 0.06 s
        plant.drive([(200.0, 0.0)] * 4, 0.02)
    assert late.x == 200.0
    assert own.x > 200.0
    for _ in range(100):
        plant.drive([(200.0, 0.0)] * 4, 0.02)
    assert late.linear == pytest.approx(200.0)
    assert own.x - late.x == pytest.approx(200.0 * (0.06 + 0.05 - 0.08), abs=4.0)


def test_a_robot_put_in_its_place_has_forgotten_what_it_was_told():
    world = floor(poses=[(200.0, 300.0, 0.0)])
    plant = SimPlant(world, [UNEVEN])
    for _ in range(3):
        plant.drive([(200.0, 0.0)] * 4, 0.02)
    plant.place([(400.0, 300.0, 0.0)] * 4)
    for _ in range(3):
        plant.drive([(0.0, 0.0)] * 4, 0.02)
    assert world.robots[0].x == 400.0
