"""Homing brings robots to their places round walls and other robots."""

from itertools import combinations
from math import dist, hypot, pi

import pytest

from pigaming_app.games.arenas import load
from pigaming_app.hardware.control.path_planner import find_path, inflated_floor
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import RADIUS
from tests.cases import one_in
from tests.floor import floor, from_wall
from tests.hardware.mat import NOMINAL_MM, STARTS, Mat, rig_of

MIDDLE = ((800.0, 250.0, 800.0, 650.0),)
GATE = ((600.0, 0.0, 600.0, 380.0), (600.0, 520.0, 600.0, 900.0))  # walls with a gap of 110 px, 1.5 robot diameters


def walls_of(arena):
    return [(wall.ax, wall.ay, wall.bx, wall.by) for wall in arena.walls]


YARD = walls_of(load("pitanks", "courtyard"))


def gathered(mat, goals, walls=(), seconds=60.0, watch=lambda: None):
    """Home robots to these places; returns the time needed, s, or None."""
    world = floor(walls, [(robot.x, robot.y, robot.heading) for robot in mat.robots])
    plant = RealPlant(world, mat.rig)
    plant.summon(goals)
    for tick in range(round(seconds / 0.02)):
        if plant.take_places():
            return 0.02 * tick
        mat.pass_time()
        watch()
        for i, one in enumerate(mat.robots):
            for other in mat.robots[:i]:
                assert hypot(one.x - other.x, one.y - other.y) > 2.0 * RADIUS - 2.0
    return None


def at(mat, robot, goal):
    one = mat.robots[robot]
    turned = abs((one.heading - goal[2] + pi) % (2 * pi) - pi)
    return hypot(one.x - goal[0], one.y - goal[1]) < 20.0 and turned < 0.25


def test_two_robots_change_places():
    mat = Mat([(400.0, 450.0, 0.0), (1000.0, 450.0, pi), *STARTS[2:]])
    goals = {0: (1000.0, 450.0, 0.0), 1: (400.0, 450.0, 0.0)}
    assert gathered(mat, goals) is not None
    assert all(at(mat, robot, goal) for robot, goal in goals.items())


def test_a_wider_robot_takes_the_way_that_its_body_fits():
    """60 mm at 1.32 mm/px are 91 px across: the gap of 85 px at the top is too narrow, that of 150 px is not."""
    walls = ((600.0, 115.0, 600.0, 590.0), (600.0, 770.0, 600.0, 900.0))
    mat = Mat([(300.0, 200.0, 0.0), *STARTS[1:]])
    mat.boards = {0: 1}
    lowest = []
    assert gathered(mat, {0: (900.0, 200.0, 0.0)}, walls, watch=lambda: lowest.append(mat.robots[0].y)) is not None
    assert max(lowest) > 590.0


def test_wider_robots_change_places_without_touching_each_other_or_a_wall():
    """All four have a radius of 60 mm, 9 px more than a 3pi, and pass a wall in the middle."""
    mat = Mat()
    mat.boards = dict.fromkeys(range(4), 1)
    world, radius = floor(MIDDLE), 60.0 / NOMINAL_MM
    nearest, at_wall = [], []

    def watch():
        at = [(one.x, one.y) for one in mat.robots]
        nearest.append(min(hypot(a - x, b - y) for (a, b), (x, y) in combinations(at, 2)))
        walls = [world.walls[i] for i in range(world.wall_count)]
        at_wall.append(min(hypot(*offset_from_wall(wall, x, y)) - wall.half for wall in walls for x, y in at))

    goals = {i: STARTS[(i + 1) % 4] for i in range(4)}
    assert gathered(mat, goals, MIDDLE, watch=watch) is not None
    assert all(at(mat, robot, goal) for robot, goal in goals.items())
    assert min(nearest) > 2.0 * radius
    assert min(at_wall) > radius


@pytest.mark.long
@pytest.mark.again
def test_wide_robots_at_home_make_room_for_those_that_they_block():
    """3pis on a television of 65 inches: the first two arrive in the only ways out of the pockets of the others."""
    arena, mm = load("pitanks", "trenches"), 1199.0 / 1600.0
    body = 47.5 / mm
    mat = Mat()
    mat.rig = rig_of(mat, mat, mm=mm)
    world = floor(walls_of(arena), STARTS, radius=mat.rig.radius_in_play(range(4)))
    plant = RealPlant(world, mat.rig)
    goals = {i: (start.x, start.y, start.heading) for i, start in zip((0, 2, 1, 3), arena.starts, strict=True)}
    plant.summon({0: goals[0], 1: goals[1], 2: goals[2], 3: goals[3]})
    for _ in range(100 * 50):
        if plant.take_places():
            break
        mat.pass_time()
        at_wall = min(from_wall(wall, one.x, one.y) - wall.half for wall in arena.walls for one in mat.robots)
        assert at_wall > body - 1.0
        assert min(hypot(a.x - b.x, a.y - b.y) for a, b in combinations(mat.robots, 2)) > 2.0 * body - 2.0
    assert all(at(mat, robot, goal) for robot, goal in goals.items())


def test_two_robots_pass_a_gate_one_after_the_other():
    mat = Mat([(300.0, 300.0, 0.0), (300.0, 600.0, 0.0), *STARTS[1:3]])
    goals = {0: (900.0, 300.0, 0.0), 1: (900.0, 600.0, 0.0)}
    assert gathered(mat, goals, GATE) is not None
    assert all(at(mat, robot, goal) for robot, goal in goals.items())


def test_a_robot_that_stands_in_a_wall_gets_out_first():
    mat = Mat([(590.0, 300.0, 0.5), *STARTS[1:]])
    goals = {0: (300.0, 300.0, 0.0)}
    assert gathered(mat, goals, GATE) is not None
    assert at(mat, 0, goals[0])


def test_a_robot_gets_round_the_end_of_a_wall_that_holds_it():
    mat = Mat([(833.0, 204.6, 2.26), (1370.0, 840.0, 4.88), (142.4, 778.8, 2.88), (1304.4, 188.2, 0.93)])
    assert gathered(mat, {0: (1414.0, 276.3, 0.27)}, YARD, seconds=20.0) is not None


def test_a_robot_beside_a_wall_sets_out_across_its_heading():
    mat = Mat([(700.1, 192.0, 1.28), (1191.3, 565.6, 1.87), (1546.4, 220.5, 3.58), (281.7, 744.1, 5.46)])
    assert gathered(mat, {0: (448.6, 653.8, 5.17)}, YARD, seconds=20.0) is not None


@pytest.mark.parametrize("name", one_in(3, ["labyrinth", "classic", "trenches"]))
def test_robots_take_their_places_in_an_arena_round_walls_and_each_other(name):
    mat, arena = Mat(), load("pitanks", name)
    goals = {i: (start.x, start.y, start.heading) for i, start in enumerate(arena.starts)}
    assert gathered(mat, goals, walls_of(arena), seconds=45.0) is not None
    assert all(at(mat, robot, goal) for robot, goal in goals.items())


def test_a_robot_whose_place_is_taken_waits():
    mat = Mat([(400.0, 450.0, 0.0), (1000.0, 450.0, pi), *STARTS[2:]])
    assert gathered(mat, {0: (1000.0, 450.0, 0.0)}, seconds=4.0) is None
    assert mat.robots[1].x == 1000.0
    assert hypot(mat.robots[0].x - 400.0, mat.robots[0].y - 450.0) < 1.0, "it does not drive about"


def test_a_robot_in_its_place_stays_when_it_is_nudged_and_comes_back_when_it_is_carried_off():
    mat = Mat()
    world = floor(poses=STARTS)
    plant = RealPlant(world, mat.rig)
    plant.summon({0: STARTS[0], 1: (1200.0, 200.0, 2.4)})
    plant.take_places()
    mat.robots[0].x += 15.0
    plant.take_places()
    assert plant.places[0].arrived
    mat.robots[0].x += 100.0
    for _ in range(1500):
        if plant.take_places():
            break
        mat.pass_time()
    assert mat.robots[0].x == pytest.approx(STARTS[0][0], abs=20.0)


def test_a_path_keeps_clear_of_walls_and_ends_at_the_goal():
    world = floor(GATE)
    path = find_path(inflated_floor(world, 4.0), (300.0, 200.0), (900.0, 200.0))
    assert path[-1] == (900.0, 200.0)
    assert any(dist(point, (600.0, 450.0)) < 60.0 for point in path)
    assert find_path(inflated_floor(world, 30.0), (300.0, 200.0), (900.0, 200.0)) == []
