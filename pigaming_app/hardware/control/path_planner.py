"""Ways for real robots that take their places: round walls with room to spare, round robots and their ways.

A robot that stands, and the way of one that drives, are walls to the others.
"""

from collections.abc import Iterable, Sequence
from math import sqrt
from typing import Any

from pigaming_app.sim.flow_field import Route, expand, free_node, update_route
from pigaming_app.sim.grid import BLOCKED, block_rim, wall_on_grid
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import CELL, COLUMNS, HEIGHT, NODES, WIDTH, Wall, World

MOST_POINTS = 40  # of a way

Point = tuple[float, float]


def apart(one: Point, other: Point) -> float:
    """How far two points are from each other, px."""
    return sqrt((one[0] - other[0]) ** 2 + (one[1] - other[1]) ** 2)


def floor_with(world: Any, berth: float) -> Any:
    """A floor with the walls that stand, so many px thicker."""
    floor: Any = World()
    floor.walls = []
    block_rim(floor)
    for i in range(world.wall_count):
        wall = world.walls[i]
        if wall.health:
            _add(floor, (wall.ax, wall.ay), (wall.bx, wall.by), wall.half + berth)
    return floor


def among(floor: Any, lines: Iterable[Sequence[Point]], half: float) -> Any:
    """The same floor, where these lines, or single points, are walls too, `half` px to either side."""
    wider: Any = World()
    wider.wall_count, wider.walls, wider.grid = floor.wall_count, list(floor.walls), list(floor.grid)
    for points in lines:
        for one, other in zip(points, points[1:] or points, strict=False):
            _add(wider, one, other, half)
    return wider


def way_to(floor: Any, start: Point, goal: Point) -> list[Point]:
    """The points to drive to, the last of them the goal; empty where there is no way."""
    x, y = min(max(start[0], RADIUS), WIDTH - RADIUS), min(max(start[1], RADIUS), HEIGHT - RADIUS)
    route: Any = Route()
    route.wanted, route.goal_x, route.goal_y = 1, goal[0], goal[1]
    way: list[Point] = []
    for _ in range(MOST_POINTS):
        update_route(floor, route, x, y)
        if route.straight:
            return [*way, goal] if is_clear(floor, x, y, *goal, RADIUS + 1.0) else _last_bit(floor, way, (x, y), goal)
        if way and (route.way_x, route.way_y) == way[-1]:
            return []
        x, y = route.way_x, route.way_y
        way.append((x, y))
    return []


def _last_bit(floor: Any, way: list[Point], at: Point, goal: Point) -> list[Point]:
    """A place beside a wall: from the node next to it straight there."""
    return [*way, goal] if apart(at, goal) < CELL and is_clear(floor, *at, *goal, RADIUS - 2.0) else []


def spots(floor: Any, start: Point) -> list[Point]:
    """The free nodes that can be reached from there, nearest first."""
    field: Any = Route()
    root = free_node(floor, *start)
    if root == 0:
        return []
    expand(floor, field, root, -1)
    nodes = [node for node in range(NODES) if field.reach[node] > 1 and not floor.grid[node] & BLOCKED]
    nodes.sort(key=lambda node: int(field.reach[node]))
    return [(node % COLUMNS * CELL, node // COLUMNS * CELL) for node in nodes]


def _add(floor: Any, one: Point, other: Point, half: float) -> None:
    """Stand a wall on the floor, from one point to another or on a single one."""
    wall: Any = Wall()
    (ax, ay), (bx, by) = one, other
    wall.ax, wall.ay, wall.bx, wall.by, wall.half, wall.health = ax, ay, bx, by, half, 1
    edge = wall.half + RADIUS
    wall.left, wall.right = min(ax, bx) - edge, max(ax, bx) + edge
    wall.top, wall.bottom = min(ay, by) - edge, max(ay, by) + edge
    floor.walls.append(wall)
    floor.wall_count += 1
    wall_on_grid(floor, wall, 1)
