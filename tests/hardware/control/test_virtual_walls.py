"""Virtual walls clip the speed of real robots, which never enter a wall."""

from math import cos, exp, inf, pi, radians, sin
from random import Random

import pytest

from pigaming_app.hardware.control.virtual_walls import GAMMA, SHARED, SPARE, clip_twist, speed_limits, stopping_pose
from pigaming_app.sim.drivetrain import MM
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import HEIGHT, RADIUS, WIDTH
from tests.floor import floor

ACROSS = (800.0, 0.0, 800.0, 900.0)  # a vertical wall at the centre, 30 px thick


def driven(world, pose, desired, others=()):
    """The clipped speed, px/s."""
    return clip_twist(pose, desired, speed_limits(world, pose[0], pose[1], others))[0]


def test_straight_at_a_wall_the_speed_is_the_gap_times_gamma():
    world = floor([ACROSS])
    gap = 50.0
    x = 800.0 - 15.0 - RADIUS - gap
    assert driven(world, (x, 450.0, 0.0), (260.0, 0.0)) == pytest.approx(GAMMA * (gap - SPARE))


def test_aslant_only_the_part_towards_the_wall_counts():
    world = floor([ACROSS])
    x = 800.0 - 15.0 - RADIUS - 20.0
    assert driven(world, (x, 450.0, radians(60.0)), (260.0, 0.0)) == pytest.approx(GAMMA * (20.0 - SPARE) / 0.5)
    assert driven(world, (x, 450.0, pi / 2), (260.0, 0.0)) == 260.0  # along it


def test_far_from_everything_nothing_is_clipped():
    assert driven(floor([ACROSS]), (400.0, 450.0, 0.0), (260.0, 1.0)) == 260.0


def test_backwards_counts_what_is_behind():
    world = floor()
    assert driven(world, (RADIUS + 10.0, 450.0, 0.0), (-260.0, 0.0)) == pytest.approx(-GAMMA * (10.0 - SPARE))
    assert driven(world, (RADIUS + 10.0, 450.0, 0.0), (260.0, 0.0)) == 260.0


def test_in_a_wall_only_the_way_out_is_open_and_turning_is_free():
    world = floor([ACROSS])
    pose = (800.0 - 20.0, 450.0, 0.0)
    assert clip_twist(pose, (260.0, 2.0), speed_limits(world, *pose[:2])) == (0.0, 2.0)
    assert clip_twist(pose, (-260.0, 0.0), speed_limits(world, *pose[:2])) == (-260.0, 0.0)


@pytest.mark.parametrize(("x", "y", "inward"), [(-50.0, 450.0, 0.0), (1700.0, 450.0, pi), (800.0, -40.0, pi / 2)])
def test_outside_the_arena_only_inward(x, y, inward):
    world = floor()
    assert driven(world, (x, y, inward), (200.0, 0.0)) == 200.0
    assert driven(world, (x, y, inward + pi), (200.0, 0.0)) == 0.0
    assert driven(world, (x, y, inward + pi), (-200.0, 0.0)) == -200.0


def test_a_destroyed_wall_holds_nobody():
    world = floor([ACROSS])
    pose = (800.0 - 15.0 - RADIUS - 5.0, 450.0, 0.0)
    assert driven(world, pose, (260.0, 0.0)) < 10.0
    world.walls[0].health = 0
    assert driven(world, pose, (260.0, 0.0)) == 260.0


def test_two_robots_share_the_gap_between_them():
    world = floor()
    pose = (600.0, 450.0, 0.0)
    other = (600.0 + 2.0 * RADIUS + 30.0, 450.0, 0.0)
    assert driven(world, pose, (260.0, 0.0), [other]) == pytest.approx(SHARED * (30.0 - SPARE))


def test_a_wider_body_is_held_off_by_its_own_radius():
    """10 px wider to each side, in front of a wall, the arena's edge, and another robot that is 5 px wider."""
    world, other = floor([ACROSS]), (600.0 + 2.0 * RADIUS + 45.0, 450.0, 5.0)
    at_wall = speed_limits(world, 800.0 - 15.0 - RADIUS - 30.0, 450.0, margin=10.0)[4]
    assert at_wall.speed == pytest.approx(GAMMA * (20.0 - SPARE))
    at_edge = speed_limits(world, RADIUS + 30.0, 450.0, margin=10.0)[0]
    assert at_edge.speed == pytest.approx(GAMMA * (20.0 - SPARE))
    at_other = speed_limits(floor(), 600.0, 450.0, [other], margin=10.0)[4]
    assert at_other.speed == pytest.approx(SHARED * (30.0 - SPARE))


def test_swinging_the_nose_into_a_wall_slows_down_in_time():
    world = floor([ACROSS])
    pose = (800.0 - 15.0 - RADIUS - SPARE, 450.0, pi / 2)  # along the wall, touching it; a left turn leads into it
    assert driven(world, pose, (260.0, 0.0)) == 260.0
    assert driven(world, pose, (260.0, -3.0)) == 0.0
    assert driven(world, pose, (260.0, 3.0)) == 260.0


def test_coasting_goes_on_by_speed_times_lag():
    x, y, heading = stopping_pose((100.0, 200.0, 0.5), (250.0, 0.0), 0.08)
    assert (x, y, heading) == pytest.approx((100.0 + 20.0 * cos(0.5), 200.0 + 20.0 * sin(0.5), 0.5))
    assert stopping_pose((0.0, 0.0, 0.0), (0.0, 3.0), 0.1) == pytest.approx((0.0, 0.0, 0.3))


@pytest.mark.parametrize(("lag", "radius"), [(0.03, RADIUS), (0.08, RADIUS), (0.15, RADIUS), (0.08, 63.4)])
def test_a_minute_of_mashing_enters_no_wall_however_lazy_the_motors_and_wide_the_robots(lag, radius):
    """The closed loop with a perfect pose: random sticks, held for random times, against walls of every direction."""
    world = floor(
        [ACROSS, (300.0, 300.0, 500.0, 500.0), (1200.0, 700.0, 1400.0, 650.0), (1100.0, 200.0, 1100.0, 200.0)],
        radius=radius,
    )
    chance = Random(round(1000 * lag))
    x, y, heading, linear, angular = 200.0, 200.0, 0.0, 0.0, 0.0
    desired, until, deepest, follow = (0.0, 0.0), 0, inf, 1.0 - exp(-0.02 / lag)
    travelled = 0.0
    for tick in range(3000):
        if tick >= until:
            desired, until = (chance.choice((-420.0, 0.0, 420.0, 420.0)), chance.choice((-3.0, 0.0, 3.0))), tick + 20
        rest = stopping_pose((x, y, heading), (linear, angular), lag)
        twist = clip_twist(rest, desired, speed_limits(world, rest[0], rest[1]), lag)
        linear += (twist[0] - linear) * follow
        angular += (twist[1] - angular) * follow
        heading += 0.02 * angular
        x, y = x + 0.02 * linear * cos(heading), y + 0.02 * linear * sin(heading)
        travelled += 0.02 * abs(linear)
        gaps = [x, WIDTH - x, y, HEIGHT - y]
        for i in range(world.wall_count):
            dx, dy = offset_from_wall(world.walls[i], x, y)
            gaps.append((dx * dx + dy * dy) ** 0.5 - world.walls[i].half)
        deepest = min(deepest, *(gap - radius for gap in gaps))
    assert deepest * MM > -1.0
    assert travelled > 1500.0
