"""Path planner for homing: paths with clearance from walls, robots and reserved paths.

Standing robots and the paths of moving ones are walls to the others.
"""

from collections.abc import Iterable, Sequence
from math import dist
from typing import Any

from pigaming_app.sim.flow_field import Route, expand, free_node, update_route
from pigaming_app.sim.grid import BLOCKED, block_rim, wall_on_grid
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import CELL, COLUMNS, HEIGHT, NODES, WIDTH, Wall

MAX_POINTS = 40  # of a path

Point = tuple[float, float]


class FreeFloor:
    """Walls, grid and the radius of robots, the parts of a world in which paths are found."""

    shifts = 0

    def __init__(self, radius: float, walls: Iterable[Any] = (), grid: Iterable[int] = (0,) * NODES) -> None:
        self.radius, self.walls, self.grid = radius, list(walls), list(grid)

    @property
    def wall_count(self) -> int:
        """Number of its walls."""
        return len(self.walls)


def inflated_floor(world: Any, berth: float, margin: float = 0.0) -> Any:
    """A floor with the standing walls of the world, each `berth` + `margin` px thicker, for a robot of that margin."""
    floor: Any = FreeFloor(world.radius)
    block_rim(floor)
    for i in range(world.wall_count):
        wall = world.walls[i]
        if wall.health:
            _add(floor, (wall.ax, wall.ay), (wall.bx, wall.by), wall.half + berth + margin)
    corners = ((0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT))
    for one, other in zip(corners, corners[1:] + corners[:1], strict=True):
        if margin:
            _add(floor, one, other, margin)
    return floor


def with_obstacles(floor: Any, lines: Iterable[tuple[Sequence[Point], float]]) -> Any:
    """A copy of the floor with lines or single points as additional walls, each with its half width, px."""
    copy = FreeFloor(floor.radius, floor.walls, floor.grid)
    for points, half in lines:
        for one, other in zip(points, points[1:] or points, strict=False):
            _add(copy, one, other, half)
    return copy


def find_path(floor: Any, start: Point, goal: Point) -> list[Point]:
    """Waypoints from start to goal, the goal being the last; empty if there is no path."""
    radius = floor.radius
    x, y = min(max(start[0], radius), WIDTH - radius), min(max(start[1], radius), HEIGHT - radius)
    route: Any = Route()
    route.active, route.goal_x, route.goal_y = 1, goal[0], goal[1]
    path: list[Point] = []
    for _ in range(MAX_POINTS):
        update_route(floor, route, x, y)
        if route.straight:
            return [*path, goal] if is_clear(floor, x, y, *goal, radius + 1.0) else _last_leg(floor, path, (x, y), goal)
        if path and (route.waypoint_x, route.waypoint_y) == path[-1]:
            return []
        x, y = route.waypoint_x, route.waypoint_y
        path.append((x, y))
    return []


def _last_leg(floor: Any, path: list[Point], at: Point, goal: Point) -> list[Point]:
    """A goal next to a wall: straight from the nearest node."""
    return [*path, goal] if dist(at, goal) < CELL and is_clear(floor, *at, *goal, floor.radius - 2.0) else []


def reachable_nodes(floor: Any, start: Point) -> list[Point]:
    """The free nodes reachable from `start`, nearest first, px."""
    field: Any = Route()
    root = free_node(floor, *start)
    if root == 0:
        return []
    expand(floor, field, root, -1)
    nodes = [node for node in range(NODES) if field.reach[node] > 1 and not floor.grid[node] & BLOCKED]
    nodes.sort(key=lambda node: int(field.reach[node]))
    return [(node % COLUMNS * CELL, node // COLUMNS * CELL) for node in nodes]


def _add(floor: Any, one: Point, other: Point, half: float) -> None:
    """Add a wall from one point to another, or at a single one."""
    wall: Any = Wall()
    (ax, ay), (bx, by) = one, other
    wall.ax, wall.ay, wall.bx, wall.by, wall.half, wall.health = ax, ay, bx, by, half, 1
    edge = wall.half + floor.radius
    wall.left, wall.right = min(ax, bx) - edge, max(ax, bx) + edge
    wall.top, wall.bottom = min(ay, by) - edge, max(ay, by) + edge
    floor.walls.append(wall)
    wall_on_grid(floor, wall, 1)
