"""Drivetrain kinematics, its file format, and a simulated robot with measured parameters."""

from math import pi

import pytest

from pigaming_app.sim.drivetrain import NOMINAL, Drivetrain, DrivetrainError, Wheel, parse, to_toml, twist, wheel_shares
from pigaming_app.sim.plant import SimPlant
from tests.floor import floor

UNEVEN = Drivetrain(Wheel(700.0, 0.05), Wheel(800.0, 0.10), 60.0, 0.05, 0.06)


def test_driving_straight_gives_both_wheels_equal_shares():
    left, right = wheel_shares(NOMINAL, NOMINAL.left.speed / 2, 0.0)
    assert left == right == pytest.approx(0.5)


def test_turning_right_on_the_spot_needs_the_left_wheel_ahead():
    left, right = wheel_shares(NOMINAL, 0.0, pi)
    assert left == pytest.approx(pi * NOMINAL.base / 2 / NOMINAL.left.speed)
    assert right == -left


@pytest.mark.parametrize("requested", [(260.0, 0.0), (-120.0, 1.5), (0.0, -3.0), (300.0, 2.0), (1.0, 0.0), (0.0, 0.0)])
def test_twist_inverts_wheel_shares_for_any_wheels(requested):
    assert twist(UNEVEN, *wheel_shares(UNEVEN, *requested)) == pytest.approx(requested)


def test_below_the_deadband_a_wheel_stands_still():
    assert twist(UNEVEN, 0.04, -0.09) == (0.0, 0.0)
    assert twist(UNEVEN, 0.06, 0.0)[0] > 0.0


def test_excess_speed_is_scaled_down_without_changing_the_curvature():
    linear, angular = twist(UNEVEN, *wheel_shares(UNEVEN, 2000.0, 10.0))
    assert linear < 800.0
    assert linear / angular == pytest.approx(200.0)


def test_a_written_file_is_parsed_to_the_same_robots():
    (one, other) = parse(to_toml([UNEVEN, NOMINAL]), "robots.toml")
    assert one == UNEVEN
    assert other.left.speed == pytest.approx(NOMINAL.left.speed, abs=0.01)


def test_a_robot_measured_on_one_mat_is_the_same_in_mm_on_another():
    """0.66 mm are half a px of the nominal mat: twice as many px."""
    (small,) = parse(to_toml([UNEVEN]), "robots.toml", 0.66)
    assert small == Drivetrain(Wheel(1400.0, 0.05), Wheel(1600.0, 0.10), 120.0, 0.05, 0.06)
    assert parse(to_toml([small], 0.66), "robots.toml") == (UNEVEN,)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "robots.toml: robot: 0 robots"),
        ("robot = 3", "robot: must be written as [[robot]]"),
        ("[[robot]]\nleft = [700, 0]\nright = [700, 0]\nbase = 60\nlag = 0.1", "robot[1].dead_time"),
        ("[[robot]]\nleft = [0, 0]\nright = [700, 0]\nbase = 60\nlag = 0.1\ndead_time = 0", "robot[1].left"),
        ("[[robot]]\nleft = [700, nan]\n", "robot[1].left"),
        ("[[robot]", "robots.toml: syntax"),
    ],
)
def test_an_invalid_file_is_refused_in_one_line(text, reason):
    with pytest.raises(DrivetrainError, match=r"robots\.toml") as caught:
        parse(text, "robots.toml")
    assert reason in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_simulated_robot_has_the_measured_dead_time_and_lag():
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


def test_placing_a_robot_discards_its_pending_commands():
    world = floor(poses=[(200.0, 300.0, 0.0)])
    plant = SimPlant(world, [UNEVEN])
    for _ in range(3):
        plant.drive([(200.0, 0.0)] * 4, 0.02)
    plant.place([(400.0, 300.0, 0.0)] * 4)
    for _ in range(3):
        plant.drive([(0.0, 0.0)] * 4, 0.02)
    assert world.robots[0].x == 400.0
