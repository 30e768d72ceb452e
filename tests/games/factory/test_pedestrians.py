"""Pedestrians walk around walls and robots, never into either, and arrive within the time that their speed permits."""

from math import cos, hypot, pi, sin
from random import Random

import pytest

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.factory.pedestrians import (
    ARRIVED,
    ARRIVED_NEAR_ROBOT,
    RESTING_CLEARANCE,
    TURN_RATE,
    send,
    track_motion,
    walk,
)
from pigaming_app.games.factory.state import Factory, Worker
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.arena import build
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import DT, HEIGHT, HZ, RADIUS, WIDTH
from tests.floor import arena

PACE, GIRTH = 130.0, 20.0  # px/s, px
U = [(600.0, 250.0, 1000.0, 250.0), (1000.0, 250.0, 1000.0, 650.0), (1000.0, 650.0, 600.0, 650.0)]  # open to the left
BOX = [*U, (600.0, 650.0, 600.0, 250.0)]


def floor(walls=(), poses=()):
    """A world with robots at rest at `poses`."""
    world = Factory()
    build(world, arena(walls, poses))
    for robot, motion in zip(world.robots, world.motions, strict=True):
        robot.present = int(robot in world.robots[: len(poses)])
        motion.x, motion.y = robot.x, robot.y
    return world


def drive_on(world, ticks=1):
    """The first robot drives straight on at its motors' speed, through any obstacle; its motion is tracked."""
    robot = world.robots[0]
    for _ in range(ticks):
        robot.x += DT * robot.linear * cos(robot.heading)
        robot.y += DT * robot.linear * sin(robot.heading)
        track_motion(world.motions[0], robot)


def at_speed(world, speed):
    """Let the first robot arrive at its pose after a second of driving at a speed."""
    robot = world.robots[0]
    robot.linear = speed
    robot.x -= speed * cos(robot.heading)
    robot.y -= speed * sin(robot.heading)
    drive_on(world, HZ)


def walker(x, y, to):
    made = Worker()
    made.x, made.y = x, y
    send(made, *to)
    return made


def go(world, who, seconds):
    """Walk for at most `seconds`, with checks; returns the time in s, or None if the goal was not reached."""
    for tick in range(round(seconds * HZ)):
        x, y = who.x, who.y
        there = walk(world, who, PACE, GIRTH)
        assert hypot(who.x - x, who.y - y) <= PACE * DT + 1e-9, "it walks no faster than it can"
        assert who.walking == ((who.x, who.y) != (x, y))
        assert not in_wall(world, who.x, who.y)
        if there:
            return tick * DT
    return None


def far_off(who):
    return hypot(who.route.goal_x - who.x, who.route.goal_y - who.y)


# ----------------------------------------------------------------------------------------------------------- the floor


def test_it_walks_straight_where_nothing_is_in_the_way_and_stays_there():
    """300 px, less the 6 px within which it has arrived, at 130 px/s."""
    who = walker(200.0, 450.0, (500.0, 450.0))
    assert go(floor(), who, 5.0) == pytest.approx((300.0 - ARRIVED) / PACE, abs=2 * DT)
    assert who.y == 450.0
    place = who.x, who.y
    assert go(floor(), who, 1.0) == 0.0
    assert (who.x, who.y, who.walking) == (*place, 0)


def test_sent_elsewhere_on_the_way_it_turns_back():
    world, who = floor(), walker(200.0, 450.0, (900.0, 450.0))
    assert go(world, who, 2.0) is None
    assert who.x == pytest.approx(200.0 + 2.0 * PACE, abs=PACE * DT)
    send(who, 200.0, 450.0)
    assert go(world, who, 3.0) is not None
    assert far_off(who) < ARRIVED


def test_it_turns_the_way_it_walks_but_not_at_once():
    world, who = floor(), walker(800.0, 450.0, (200.0, 460.0))
    who.heading = 0.1
    before, turned = who.heading, 0
    while abs(turn_to(who.heading - pi)) > 0.05:
        walk(world, who, PACE, GIRTH)
        assert abs(turn_to(who.heading - before)) <= TURN_RATE * DT + 1e-9
        before, turned = who.heading, turned + 1
    assert turned * DT == pytest.approx((pi - 0.15) / TURN_RATE, abs=0.03)


def test_it_finds_the_way_out_of_a_u_and_round_it():
    """Out 300 px, over 240 and back 600 is 1140 px, 8.8 s; corners are cut a little."""
    who = walker(900.0, 450.0, (1200.0, 450.0))
    took = go(floor(walls=U), who, 15.0)
    assert took is not None
    assert 7.0 < took < 12.0
    assert far_off(who) < ARRIVED


@pytest.mark.parametrize("place", [("factory", name) for name in arenas("factory")] + [("pitanks", "classic")])
def test_it_gets_from_anywhere_to_anywhere(place):
    world, chance = Factory(), Random(3)
    build(world, load(*place))

    def free() -> tuple[float, float]:
        while True:
            x, y = chance.uniform(50, WIDTH - 50), chance.uniform(50, HEIGHT - 50)
            if not any(in_wall(world, x + dx, y + dy) for dx in (-3, 3) for dy in (-3, 3)):
                return x, y

    for _ in range(12):
        start, goal = free(), free()
        who = walker(*start, goal)
        crow = hypot(start[0] - goal[0], start[1] - goal[1])
        took = go(world, who, 30.0)
        assert took is not None, f"from {start} to {goal}"
        assert took < (crow + 900.0) / PACE, f"a long way round from {start} to {goal}"
        assert far_off(who) < ARRIVED


def test_an_unreachable_goal_is_never_reported_as_reached():
    who = walker(200.0, 450.0, (800.0, 450.0))
    assert go(floor(walls=BOX), who, 20.0) is None
    assert far_off(who) > 200.0 - 15.0
    assert 0.0 < who.x < WIDTH
    assert 0.0 < who.y < HEIGHT


# -------------------------------------------------------------------------------------------------------------- robots


@pytest.mark.parametrize("aside", [-60.0, -30.0, -5.0, 0.0, 5.0, 30.0, 60.0])
@pytest.mark.parametrize("way", [0.0, 0.5 * pi, pi, 4.0])
def test_it_walks_round_a_robot_that_stands_in_the_way_without_touching_it(way, aside):
    """600 px with a detour of less than a third."""
    ux, uy = cos(way), sin(way)
    world = floor(poses=[(800.0 - aside * uy, 450.0 + aside * ux, 0.0)])
    who = walker(800.0 - 300.0 * ux, 450.0 - 300.0 * uy, (800.0 + 300.0 * ux, 450.0 + 300.0 * uy))
    robot = world.robots[0]
    for _ in range(round(600.0 / PACE * 1.33 * HZ)):
        if walk(world, who, PACE, GIRTH):
            break
        assert hypot(who.x - robot.x, who.y - robot.y) >= RADIUS + GIRTH + RESTING_CLEARANCE - 1e-9
    assert far_off(who) < ARRIVED


def test_robots_that_are_not_there_are_in_nobodys_way():
    world = floor(poses=[(800.0, 450.0, 0.0)])
    world.robots[0].present = 0
    who = walker(600.0, 450.0, (1000.0, 450.0))
    assert go(world, who, 5.0) == pytest.approx((400.0 - ARRIVED) / PACE, abs=2 * DT)
    assert who.y == 450.0


def crossing(world, who, seconds):
    """The first robot drives straight on while a person walks; (s to the goal or None, least distance in px)."""
    robot, least = world.robots[0], 1e9
    for tick in range(round(seconds * HZ)):
        if walk(world, who, PACE, GIRTH):
            return tick * DT, least
        drive_on(world)
        least = min(least, hypot(who.x - robot.x, who.y - robot.y))
    return None, least


@pytest.mark.parametrize("speed", [260.0, -260.0, 120.0])
@pytest.mark.parametrize("late", [-0.3, -0.1, 0.1])
def test_it_lets_a_robot_drive_past_before_it_goes_on(late, speed):
    """Both would be at (800, 450) after 1.5 s; the robot comes from the side, ahead or backwards."""
    come = abs(speed) * (1.5 + late)
    world = floor(poses=[(800.0, 450.0 - come, 0.5 * pi if speed > 0.0 else 1.5 * pi)])
    at_speed(world, speed)
    who = walker(800.0 - 1.5 * PACE, 450.0, (1000.0, 450.0))
    took, least = crossing(world, who, 8.0)
    assert least > RADIUS + GIRTH, "they touched"
    assert took is not None
    assert took > (1.5 * PACE + 200.0 - ARRIVED) / PACE + 0.1, "it did not wait"


def test_it_does_not_wait_for_a_robot_that_drives_away():
    world = floor(poses=[(800.0, 450.0, 0.0)])
    at_speed(world, 260.0)
    who = walker(600.0, 450.0, (1000.0, 450.0))
    took, _ = crossing(world, who, 6.0)
    assert took == pytest.approx((400.0 - ARRIVED) / PACE, abs=2 * DT)


def test_it_steps_out_of_the_way_of_what_has_come_too_near():
    """A robot has been pushed against it: steps away from the robot are free."""
    world = floor(poses=[(800.0, 450.0, 0.0)])
    who = walker(850.0, 450.0, (1100.0, 450.0))
    assert go(world, who, 4.0) is not None
    assert far_off(who) < ARRIVED


def test_it_never_walks_into_a_robot_wherever_robots_stand():
    """Four robots at a time, on floors with and without walls: no moving walker violates the clearance."""
    chance, arrived = Random(7), 0
    for trial in range(20):
        walls = U if trial % 2 else ()
        poses = [(chance.uniform(100, 1500), chance.uniform(100, 800), 0.0) for _ in range(4)]
        world = floor(walls=walls, poses=poses)
        while True:
            x, y = chance.uniform(50, 1550), chance.uniform(50, 850)
            if not in_wall(world, x, y) and all(hypot(x - a, y - b) > 70.0 for a, b, _ in poses):
                break
        who = walker(x, y, (chance.uniform(50, 1550), chance.uniform(50, 850)))
        for _ in range(15 * HZ):
            if walk(world, who, PACE, GIRTH):
                arrived += 1
                break
            assert all(hypot(who.x - a, who.y - b) >= RADIUS + GIRTH + RESTING_CLEARANCE - 1e-9 for a, b, _ in poses)
    assert arrived >= 10, "most get there"


@pytest.mark.parametrize("off", [0.0, 40.0])
def test_with_a_robot_on_the_goal_it_arrives_as_near_as_it_can(off):
    """Otherwise a robot parked on a worker's spot would block the work forever."""
    world = floor(poses=[(1000.0 + off, 450.0, 0.0)])
    who = walker(600.0, 450.0, (1000.0, 450.0))
    assert go(world, who, 10.0) is not None
    assert far_off(who) < ARRIVED_NEAR_ROBOT


# ----------------------------------------------------------------------------------------------- what really moves


@pytest.mark.parametrize("heading", [0.0, 1.0, pi])
def test_a_robot_whose_motors_turn_but_that_stays_where_it_is_is_passed_like_one_that_stands(heading):
    took = []
    for speed in (0.0, 260.0, -338.0):
        world = floor(poses=[(800.0, 440.0, heading)])
        who = walker(500.0, 450.0, (1100.0, 450.0))
        world.robots[0].linear = speed
        for tick in range(8 * HZ):
            track_motion(world.motions[0], world.robots[0])
            if walk(world, who, PACE, GIRTH):
                took.append(tick)
                break
    assert len(took) == 3
    assert took[0] == took[1] == took[2]


def test_a_stick_to_and_fro_twelve_times_a_second_is_no_driving():
    """The robot oscillates by 3 px."""
    world = floor(poses=[(800.0, 450.0, 0.0)])
    who = walker(500.0, 450.0, (800.0, 450.0))
    robot = world.robots[0]
    for tick in range(8 * HZ):
        robot.linear = 75.0 if tick // 2 % 2 else -75.0
        drive_on(world)
        if walk(world, who, PACE, GIRTH):
            break
    assert far_off(who) < ARRIVED_NEAR_ROBOT


def test_a_robot_that_is_pushed_sideways_is_waited_for():
    """It moves although its motors are at rest."""
    world = floor(poses=[(800.0, 450.0, 0.0)])
    robot, motion = world.robots[0], world.motions[0]
    for _ in range(HZ):
        robot.y -= 200.0 * DT
        track_motion(motion, robot)
    assert (motion.vx, motion.vy) == pytest.approx((0.0, -200.0), abs=1e-2)
    who = walker(robot.x, robot.y - 150.0, (robot.x, robot.y + 300.0))
    y = who.y
    walk(world, who, PACE, GIRTH)
    assert who.y <= y, "not towards what comes"


def test_a_robot_that_drives_at_a_wall_is_not_expected_behind_it():
    """The wall is 40 px ahead; half a second on, at that speed, the robot would be 90 px beyond it."""
    walls = [(891.0, 100.0, 891.0, 800.0)]
    world = floor(walls, [(800.0, 450.0, 0.0)])
    at_speed(world, 260.0)
    who = walker(980.0, 200.0, (980.0, 700.0))
    assert go(world, who, 5.0) == pytest.approx((500.0 - ARRIVED) / PACE, abs=2 * DT)


def test_what_is_carried_off_has_not_driven():
    world = floor(poses=[(800.0, 450.0, 0.0)])
    at_speed(world, 100.0)
    robot, motion = world.robots[0], world.motions[0]
    before = motion.vx
    robot.x += 300.0
    track_motion(motion, robot)
    assert 0.0 < motion.vx < before


@pytest.mark.parametrize("walls", [(), U])
def test_a_walker_on_a_detour_is_not_held_up_and_an_enclosed_one_is(walls):
    """Progress is measured by path length, not distance: in a U it first moves away from its goal."""
    world = floor(walls)
    who = walker(900.0, 450.0, (1200.0, 450.0))
    longest = 0
    for _ in range(15 * HZ):
        if walk(world, who, PACE, GIRTH):
            break
        longest = max(longest, who.stuck_ticks)
    assert longest < HZ
    ring = [(500.0 + 70.0 * cos(k * pi / 2), 450.0 + 70.0 * sin(k * pi / 2), 0.0) for k in range(4)]
    world, who = floor((), ring), walker(500.0, 450.0, (1200.0, 450.0))
    for _ in range(4 * HZ):
        walk(world, who, PACE, GIRTH)
    assert who.stuck_ticks > 3 * HZ
    send(who, 520.0, 450.0)
    assert who.stuck_ticks == 0


@pytest.mark.parametrize("y", [70.0, 830.0])
@pytest.mark.parametrize("x", [600.0, 1000.0])
def test_with_one_side_blocked_by_a_wall_it_uses_the_other(x, y):
    world = floor(poses=[(800.0, y, 0.0)])
    assert go(world, walker(x, y, (1600.0 - x, y)), 15.0) is not None


def test_the_same_walk_is_the_same_to_the_last_bit():
    def wander():
        chance = Random(11)
        world = floor(walls=U, poses=[(300.0, 300.0, 0.0), (900.0, 450.0, 1.0), (1300.0, 600.0, 2.0)])
        who = walker(700.0, 450.0, (1300.0, 200.0))
        for tick in range(12 * HZ):
            if tick % 25 == 0:
                for motion in world.motions[:3]:
                    motion.vx, motion.vy = chance.choice((0.0, 260.0, -260.0)), chance.uniform(-200.0, 200.0)
            walk(world, who, PACE, GIRTH)
        return digest(who), who.x, who.y

    first = wander()
    assert first == wander()
    assert first[1:] != (700.0, 450.0)
