"""Contact of robots with walls and each other: they slide, stop and push, and never end up inside anything."""

from math import atan2, cos, hypot, pi, radians, sin
from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.registry import games
from pigaming_app.sim.contact import SHOVE, drive, in_wall
from pigaming_app.sim.world import DT, HEIGHT, HZ, RADIUS, WIDTH
from tests.floor import floor, from_wall

FASTEST = 325.0 * 1.3  # px/s, with turbo on a track; with turbo and the pick-up it is the same
DEEPEST = 2.0  # px by which two robots may overlap


def ask(robot, linear, angular=0.0):
    robot.requested_linear, robot.requested_angular = linear, angular


def driven(world, seconds):
    for _ in range(round(seconds * HZ)):
        drive(world)
    return world


def depth(world):
    """Largest overlap of a present robot with a wall, px, computed without the grid."""
    deepest = 0.0
    for robot in world.robots:
        if robot.present:
            bounds = min(robot.x, WIDTH - robot.x, robot.y, HEIGHT - robot.y)
            deepest = max(deepest, RADIUS - bounds)
            for wall in world.walls[: world.wall_count]:
                if wall.health:
                    deepest = max(deepest, wall.half + RADIUS - from_wall(wall, robot.x, robot.y))
    return deepest


@pytest.mark.parametrize("degrees", [30, 60, 80])
def test_a_robot_slides_along_a_wall_at_the_cosine_of_its_speed(degrees):
    world = floor(walls=[(700.0, 100.0, 700.0, 850.0)], poses=[(700.0 - 51.0, 300.0, radians(90 - degrees))])
    robot = world.robots[0]
    ask(robot, 200.0)
    driven(world, 0.5)
    y = robot.y
    driven(world, 1.0)
    assert robot.y - y == pytest.approx(200.0 * sin(radians(90 - degrees)), rel=0.01)
    assert robot.x == pytest.approx(700.0 - 15.0 - RADIUS, abs=1e-3)


def test_along_the_outer_wall_too():
    world = floor(poses=[(800.0, RADIUS, radians(-60))])
    ask(world.robots[0], 200.0)
    driven(world, 0.5)
    x = world.robots[0].x
    driven(world, 1.0)
    assert world.robots[0].x - x == pytest.approx(200.0 * cos(radians(60)), rel=0.01)
    assert world.robots[0].y == RADIUS


def test_head_on_stops_at_the_wall():
    world = floor(walls=[(700.0, 100.0, 700.0, 800.0)], poses=[(500.0, 450.0, 0.0)])
    ask(world.robots[0], FASTEST)
    driven(world, 3.0)
    assert world.robots[0].x == pytest.approx(700.0 - 15.0 - RADIUS, abs=1e-3)
    assert world.robots[0].y == pytest.approx(450.0)


def test_two_head_on_stop_each_other_in_the_middle():
    world = floor(poses=[(400.0, 450.0, 0.0), (800.0, 450.0, pi)])
    for robot in world.robots[:2]:
        ask(robot, 260.0)
    driven(world, 4.0)
    one, other = world.robots[:2]
    assert one.x == pytest.approx(600.0 - RADIUS, abs=0.01)
    assert other.x == pytest.approx(600.0 + RADIUS, abs=0.01)


def test_a_robot_that_stands_still_is_pushed():
    world = floor(poses=[(300.0, 450.0, 0.0), (400.0, 450.0, 0.0)])
    ask(world.robots[0], 260.0)
    driven(world, 2.0)
    assert world.robots[1].x > 600.0
    assert world.robots[1].y == pytest.approx(450.0)
    assert world.robots[1].x - world.robots[0].x == pytest.approx(2 * RADIUS, abs=0.01)


def test_an_absent_robot_is_no_obstacle():
    world = floor(poses=[(300.0, 110.0, 0.0)])
    world.robots[1].x, world.robots[1].y = 500.0, 110.0
    ask(world.robots[0], 260.0)
    driven(world, 2.0)
    assert world.robots[0].x == pytest.approx(300.0 + 260.0 * (2.0 - 0.08), abs=6.0)


PLACES = st.tuples(st.floats(40.0, WIDTH - 40.0), st.floats(40.0, HEIGHT - 40.0), st.floats(0.0, 6.28))
LINES = st.tuples(st.floats(0.0, WIDTH), st.floats(0.0, HEIGHT), st.floats(0.0, WIDTH), st.floats(0.0, HEIGHT))
STICKS = st.lists(
    st.tuples(*[st.tuples(st.sampled_from([-1.0, 0.5, 1.0]), st.floats(-1, 1)) for _ in range(4)]),
    min_size=2,
    max_size=5,
)


@settings(max_examples=40, deadline=None)
@given(st.lists(LINES, max_size=6), st.lists(PLACES, min_size=4, max_size=4), STICKS, st.floats(5.0, 60.0))
def test_no_driving_gets_into_a_wall(walls, poses, sticks, half):
    world = floor(walls, poses, half=half)
    assume(not any(in_wall(world, robot.x, robot.y) for robot in world.robots))
    assert depth(world) < 1e-5
    for stick in sticks:
        for robot, (linear, angular) in zip(world.robots, stick, strict=True):
            ask(robot, linear * FASTEST, angular * 3.0)
        for _ in range(20):
            before = [(robot.x, robot.y) for robot in world.robots]
            drive(world)
            assert depth(world) < 1e-5
            for robot, (x, y) in zip(world.robots, before, strict=True):
                assert hypot(robot.x - x, robot.y - y) <= SHOVE + FASTEST * DT


def overlap(world):
    """Overlap of the two nearest robots, px."""
    gaps = [hypot(a.x - b.x, a.y - b.y) for i, a in enumerate(world.robots) for b in world.robots[:i]]
    return 2 * RADIUS - min(gaps)


def huddle(random, walls, x, y):
    """A world with four robots at the free positions nearest to (x, y)."""
    world = floor(walls)
    poses, spread = list[tuple[float, float, float]](), 100.0
    while len(poses) < 4:
        px = min(max(x + random.uniform(-spread, spread), RADIUS), WIDTH - RADIUS)
        py = min(max(y + random.uniform(-spread, spread), RADIUS), HEIGHT - RADIUS)
        if not in_wall(world, px, py) and all(hypot(px - a, py - b) >= 2 * RADIUS for a, b, _ in poses):
            poses.append((px, py, 0.0))
        spread += 1.0
    return floor(walls, poses)


def crushed(world, drivers, seconds):
    """Run the drivers; returns the deepest overlap of two robots, px. Asserts that no robot gets into a wall."""
    deepest = 0.0
    for tick in range(round(seconds * HZ)):
        for robot, driver in zip(world.robots, drivers, strict=True):
            driver(robot, tick)
        before = [(robot.x, robot.y) for robot in world.robots]
        drive(world)
        assert not any(in_wall(world, robot.x, robot.y) for robot in world.robots)
        for robot, (x, y) in zip(world.robots, before, strict=True):
            assert hypot(robot.x - x, robot.y - y) <= SHOVE + FASTEST * DT
        deepest = max(deepest, overlap(world))
    assert depth(world) < 1e-5
    return deepest


def towards(x, y, speed):
    """A driver towards a point, backwards if the speed is negative."""

    def driver(robot, tick):
        robot.heading = atan2(y - robot.y, x - robot.x) + (pi if speed < 0.0 else 0.0)
        ask(robot, speed)

    return driver


def mashing(random):
    """A driver at full speed, forwards or backwards with a random turn, changed five times a second."""

    def driver(robot, tick):
        if tick % 10 == 0:
            ask(robot, random.choice((FASTEST, FASTEST, -FASTEST)), random.uniform(-3.0, 3.0))

    return driver


FLOORS = [(game, arena) for game in games() for arena in arenas(game)]


@pytest.mark.parametrize(("game", "arena"), FLOORS, ids=[arena + "-" + game for game, arena in FLOORS])
def test_a_crush_leaves_robots_apart_on_every_floor(game, arena):
    """All four into a corner of the arena, against the end of a wall, against each other, or at random."""
    random = Random(arena)
    walls = [(wall.ax, wall.ay, wall.bx, wall.by) for wall in load(game, arena).walls]
    ends = [(0.0, 0.0), (WIDTH, HEIGHT), (800.0, 0.0), *[wall[:2] for wall in walls], *[wall[2:] for wall in walls]]
    for x, y in random.sample(ends, 3):
        speeds = [random.choice((260.0, FASTEST, -FASTEST)) for _ in range(4)]
        assert crushed(huddle(random, walls, x, y), [towards(x, y, speed) for speed in speeds], 2.0) <= DEEPEST
        drivers = [mashing(random) if random.random() < 0.5 else towards(x, y, speed) for speed in speeds]
        assert crushed(huddle(random, walls, x, y), drivers, 2.0) <= DEEPEST


@settings(max_examples=40, deadline=None)
@given(st.lists(LINES, max_size=8), st.floats(5.0, 40.0), st.integers(0, 2**32))
def test_a_crush_leaves_robots_apart_among_any_walls(walls, half, seed):
    random = Random(seed)
    x, y = random.choice([(wall[0], wall[1]) for wall in walls] or [(0.0, 0.0)])
    try_world = floor(walls, half=half)
    free = [(a, b) for a in range(40, 1561, 40) for b in range(40, 861, 40) if not in_wall(try_world, a, b)]
    free.sort(key=lambda place: hypot(place[0] - x, place[1] - y))
    poses: list[tuple[float, float, float]] = []
    for a, b in free:
        if len(poses) < 4 and all(hypot(a - c, b - d) >= 2 * RADIUS for c, d, _ in poses):
            poses.append((a, b, 0.0))
    assume(len(poses) == 4)
    drivers = [random.choice((towards(x, y, FASTEST), towards(x, y, -260.0), mashing(random))) for _ in range(4)]
    assert crushed(floor(walls, poses, half=half), drivers, 1.0) <= DEEPEST


@pytest.mark.parametrize(("x", "y"), [(0.0, 0.0), (WIDTH, 450.0), (700.0, 300.0)])
def test_a_crushed_robot_can_drive_away(x, y):
    """No robot sticks: after four seconds of pressing all reverse, each by at least 100 px within a second."""
    walls = [(700.0, 300.0, 1100.0, 300.0), (700.0, 300.0, 700.0, 700.0)]
    world = huddle(Random(4), walls, x + 60.0, y + 60.0)
    assert crushed(world, [towards(x, y, FASTEST)] * 4, 4.0) <= DEEPEST
    before = [(robot.x, robot.y) for robot in world.robots]
    out = [towards(x + 20.0 * (robot.x - x), y + 20.0 * (robot.y - y), FASTEST) for robot in world.robots]
    crushed(world, out, 1.0)
    assert all(hypot(robot.x - a, robot.y - b) > 100.0 for robot, (a, b) in zip(world.robots, before, strict=True))


def test_robots_pressed_into_a_corner_come_to_rest():
    """No jitter: after five seconds of full sticks, none of four robots moves by more than 0.1 px."""
    world = huddle(Random(2), (), 60.0, 60.0)
    headings = [atan2(-robot.y, -robot.x) for robot in world.robots]

    def hold_heading(heading):
        def driver(robot, tick):
            robot.heading = heading
            ask(robot, FASTEST)

        return driver

    drivers = [hold_heading(heading) for heading in headings]
    crushed(world, drivers, 5.0)
    before = [(robot.x, robot.y) for robot in world.robots]
    crushed(world, drivers, 0.2)
    for robot, (x, y) in zip(world.robots, before, strict=True):
        assert hypot(robot.x - x, robot.y - y) < 0.1


def test_a_robot_in_an_acute_wedge_stands_and_can_drive_out_again():
    """Two walls that meet at 30 degrees: the tip is (600, 450), open to the right."""
    lean = radians(15)
    arm_x, arm_y = 500.0 * cos(lean), 500.0 * sin(lean)
    walls = [(600.0, 450.0, 600.0 + arm_x, 450.0 - arm_y), (600.0, 450.0, 600.0 + arm_x, 450.0 + arm_y)]
    world = floor(walls, [(1050.0, 450.0, pi)])
    robot = world.robots[0]
    ask(robot, FASTEST)
    for _ in range(5 * HZ):
        drive(world)
        assert depth(world) < 1e-5
    # both arms touch it where its centre is (half + RADIUS) / sin 15 from the tip
    assert robot.x == pytest.approx(600.0 + (15.0 + RADIUS) / sin(lean), abs=FASTEST * DT)
    ask(robot, -FASTEST)
    driven(world, 1.5)
    assert robot.x > 1100.0
