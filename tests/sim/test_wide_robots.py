"""Robots wider than usual, as on small surfaces: they stay out of walls and of each other, and go where they fit."""

import random
from math import hypot

import numpy as np
import pytest

from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import load, on_mat, shipped_arenas, widest
from pigaming_app.games.match import Match
from pigaming_app.sim.arena import Arena, StartPose, WallSpec, build
from pigaming_app.sim.contact import OVERLAP, drive
from pigaming_app.sim.flow_field import Route, update_route
from pigaming_app.sim.world import HEIGHT, ROBOTS, SOLID, WIDTH, World
from tests.matches import setup_of

cv2 = pytest.importorskip("cv2")


def gap_to_walls(world, x, y):
    """Distance of a point from the nearest wall or rim, px, by sampling each wall at every px of its length."""
    gaps = [x, y, WIDTH - x, HEIGHT - y]
    for wall in world.walls[: world.wall_count]:
        share = np.linspace(0.0, 1.0, 2 + int(hypot(wall.bx - wall.ax, wall.by - wall.ay)))
        line = np.hypot(wall.ax + share * (wall.bx - wall.ax) - x, wall.ay + share * (wall.by - wall.ay) - y)
        gaps.append(line.min() - wall.half)
    return min(gaps)


def random_world():
    """Four robots of some radius among six walls, none in any."""
    radius = random.uniform(36.0, 110.0)
    walls = [
        WallSpec(
            random.uniform(0.0, WIDTH),
            random.uniform(0.0, HEIGHT),
            random.uniform(0.0, WIDTH),
            random.uniform(0.0, HEIGHT),
            random.uniform(5.0, 40.0),
            SOLID,
        )
        for _ in range(6)
    ]
    world = World()
    build(world, Arena("", {}, tuple(walls), (StartPose(0.0, 0.0, 0.0),) * 4, "", radius=radius))
    placed: list[tuple[float, float]] = []
    for robot in world.robots:
        for _ in range(3000):
            x, y = random.uniform(0.0, WIDTH), random.uniform(0.0, HEIGHT)
            free = all(hypot(x - a, y - b) > 2.0 * radius for a, b in placed)
            if free and gap_to_walls(world, x, y) > radius + 0.6:
                robot.present, robot.x, robot.y, robot.heading = 1, x, y, random.uniform(0.0, 6.28)
                placed.append((x, y))
                break
    return world


def test_no_hull_enters_a_wall_or_another_however_wide_robots_are():
    for _ in range(6):
        world = random_world()
        for tick in range(250):
            for robot in world.robots:
                if tick % 20 == 0:
                    robot.requested_linear, robot.requested_angular = (
                        random.choice((-340.0, 340.0)),
                        random.uniform(-3, 3),
                    )
            drive(world)
            there = [robot for robot in world.robots if robot.present]
            for i, robot in enumerate(there):
                assert gap_to_walls(world, robot.x, robot.y) > world.radius - 0.1
                for other in there[:i]:
                    assert hypot(robot.x - other.x, robot.y - other.y) > 2.0 * world.radius - OVERLAP - 1e-6


@pytest.mark.parametrize("name", shipped_arenas("pitanks"))
def test_the_widest_robots_of_an_arena_have_ways_between_its_starts_in_a_picture_of_it(name):
    """Of the picture all is cut off that is nearer to a wall than their radius: what is left connects the starts."""
    arena = load("pitanks", name)
    radius = widest("pitanks", arena.source)
    assert 36.0 < radius < 150.0
    picture = np.full((901, 1601), 255, np.uint8)
    for wall in arena.walls:
        ends = (round(wall.ax), round(wall.ay)), (round(wall.bx), round(wall.by))
        cv2.line(picture, *ends, 0, round(2 * wall.half))
    picture[[0, -1]] = picture[:, [0, -1]] = 0
    room = cv2.distanceTransform(picture, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    areas = cv2.connectedComponents((room > radius - 2.0).astype(np.uint8))[1]
    assert len({areas[round(start.y), round(start.x)] for start in arena.starts}) == 1
    assert areas[round(arena.starts[0].y), round(arena.starts[0].x)] > 0


def test_a_wide_robot_is_led_where_it_fits():
    """A wall with a gap of 110 px near the robot and one of 260 px far off: 72 px fit through both, 120 px not."""
    walls = tuple(WallSpec(800.0, a, 800.0, b, 15.0, SOLID) for a, b in ((0.0, 200.0), (340.0, 550.0), (840.0, 900.0)))
    for radius, through in ((36.0, 270.0), (60.0, 695.0)):
        world, route, (x, y) = World(), Route(), (500.0, 250.0)
        build(world, Arena("", {}, walls, (StartPose(x, y, 0.0),) * 4, "", radius=radius))
        route.active, route.goal_x, route.goal_y = 1, 1100.0, 250.0
        crossed = []
        for _ in range(400):
            update_route(world, route, x, y)
            way = hypot(route.waypoint_x - x, route.waypoint_y - y)
            if way < 1.0:
                break
            x += min(10.0, way) * (route.waypoint_x - x) / way
            y += min(10.0, way) * (route.waypoint_y - y) / way
            crossed += [y] * (abs(x - 800.0) < 6.0)
            assert gap_to_walls(world, x, y) > radius - 1.0
        assert crossed, "it gets to the other side"
        assert abs(crossed[0] - through) < 130.0


@pytest.mark.parametrize(("game", "arena"), [("pitanks", "trenches"), ("race", "hairpin"), ("football", "classic")])
def test_a_match_of_wide_robots_is_played_by_its_ais(game, arena):
    """As on a television of 65 inches: nobody gets stuck for good, and nobody enters a wall."""
    match = Match(
        setup_of(game, "level3 level3 level3 level3", arena, 1.0), arena=on_mat(game, load(game, arena), (), 63.4)
    )
    assert match.state.radius == 63.4
    for seat in range(ROBOTS):
        match.sit(seat, make_brain(game, "level3", seat))
    way, last = [0.0] * ROBOTS, [(robot.x, robot.y) for robot in match.state.robots]
    for tick in range(1200):
        match.tick()
        for seat, robot in enumerate(match.state.robots):
            way[seat] += hypot(robot.x - last[seat][0], robot.y - last[seat][1])
            last[seat] = robot.x, robot.y
            if tick % 10 == 0:
                assert gap_to_walls(match.state, robot.x, robot.y) > 63.3 or match.state.wall_count > 9
    assert min(way) > 1000.0
