"""Path planning: around walls, to the goal, and without failure if there is no path."""

from math import atan2, cos, hypot

import pytest

from pigaming_app.games.arenas import arenas, load
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.arena import build
from pigaming_app.sim.contact import drive, in_wall
from pigaming_app.sim.flow_field import Route, free_node, update_route
from pigaming_app.sim.grid import BLOCKED, wall_on_grid
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import CELL, COLUMNS, HZ, World
from tests.floor import floor

U = [(600.0, 250.0, 1000.0, 250.0), (1000.0, 250.0, 1000.0, 650.0), (1000.0, 650.0, 600.0, 650.0)]  # open to the left


def route(x, y):
    made = Route()
    made.active, made.goal_x, made.goal_y = 1, x, y
    return made


def follow(world, robot, to, seconds):
    """Follow the route to its goal; returns the time in s, or None if it was not reached."""
    for tick in range(round(seconds * HZ)):
        update_route(world, to, robot.x, robot.y)
        bearing = turn_to(atan2(to.waypoint_y - robot.y, to.waypoint_x - robot.x) - robot.heading)
        robot.requested_angular = max(-3.0, min(3.0, 6.0 * bearing))
        robot.requested_linear = 260.0 * max(0.0, cos(bearing)) ** 3
        drive(world)
        if hypot(to.goal_x - robot.x, to.goal_y - robot.y) < 20.0:
            return tick / HZ
    return None


def test_on_an_empty_floor_the_way_is_the_goal_itself():
    to = route(1200.0, 700.0)
    update_route(floor(), to, 200.0, 200.0)
    assert (to.waypoint_x, to.waypoint_y, to.straight) == (1200.0, 700.0, 1)


def test_the_field_leads_out_of_a_u_and_round_it():
    world = floor(walls=U, poses=[(900.0, 450.0, 0.0)])
    robot, to = world.robots[0], route(1200.0, 450.0)
    update_route(world, to, robot.x, robot.y)
    assert not to.straight
    assert to.waypoint_x < robot.x  # the goal is to the right, the way out to the left
    # out 300 px, over 240, and back 600: at least 1000 px, 4 s at full speed
    seconds = follow(world, robot, to, 12.0)
    assert seconds is not None
    assert seconds > 4.0


def test_a_robot_gets_from_every_corner_to_every_other():
    world = floor(walls=U)
    for start in ((110.0, 110.0), (1490.0, 790.0), (800.0, 450.0)):
        for goal in ((1490.0, 110.0), (110.0, 790.0), (900.0, 500.0)):
            for other in world.robots[1:]:
                other.present = 0
            robot = world.robots[0]
            robot.x, robot.y = start
            assert follow(world, robot, route(*goal), 15.0) is not None, (start, goal)


@pytest.mark.parametrize("name", arenas("pitanks"))
def test_every_start_of_every_arena_leads_to_every_other(name):
    arena = load("pitanks", name)
    for start in arena.starts:
        for goal in arena.starts:
            world = World()
            build(world, arena)
            robot = world.robots[0]
            robot.present, robot.x, robot.y, robot.heading = 1, start.x, start.y, start.heading
            assert follow(world, robot, route(goal.x, goal.y), 30.0) is not None


def test_the_way_is_always_one_that_the_robot_fits_through():
    world = floor(walls=U)
    to = route(1200.0, 450.0)
    for column in range(1, COLUMNS - 1):
        for row in range(1, 18):
            x, y = column * CELL, row * CELL
            if world.grid[row * COLUMNS + column] & BLOCKED:
                continue
            update_route(world, to, x, y)
            assert is_clear(world, x, y, to.waypoint_x, to.waypoint_y, 36.0)
            assert not in_wall(world, to.waypoint_x, to.waypoint_y)


def test_an_unreachable_goal_is_harmless():
    box = [*U, (600.0, 250.0, 600.0, 650.0)]
    world = floor(walls=box, poses=[(200.0, 450.0, 0.0)])
    robot, to = world.robots[0], route(800.0, 450.0)
    assert follow(world, robot, to, 5.0) is None
    assert (to.waypoint_x, to.waypoint_y) == (800.0, 450.0)
    assert not in_wall(world, robot.x, robot.y)


@pytest.mark.parametrize("goal", [(-500.0, 9000.0), (0.0, 0.0), (1600.0, 900.0), (800.0, 250.0)])
def test_a_goal_outside_or_inside_a_wall_is_harmless(goal):
    world = floor(walls=U, poses=[(900.0, 450.0, 0.0)])
    follow(world, world.robots[0], route(*goal), 3.0)
    assert not in_wall(world, world.robots[0].x, world.robots[0].y)


def test_a_wall_shot_away_opens_the_way():
    world = floor(walls=U)
    to = route(1200.0, 450.0)
    update_route(world, to, 900.0, 450.0)
    assert not to.straight
    world.walls[1].health = 0
    wall_on_grid(world, world.walls[1], -1)
    update_route(world, to, 900.0, 450.0)
    assert to.straight


def test_the_grid_is_as_before_when_a_wall_is_taken_out():
    world, bare = floor(walls=U), floor()
    for wall in world.walls[:3]:
        wall_on_grid(world, wall, -1)
    assert world.grid == bare.grid


def test_the_nearest_free_node_is_free_or_none():
    world = floor(walls=U)
    for x in range(0, 1600, 37):
        for y in range(0, 900, 41):
            node = free_node(world, float(x), float(y))
            assert node == 0 or not world.grid[node] & BLOCKED
