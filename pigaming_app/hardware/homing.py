"""Brings real robots to their places: round walls and round each other, smoothly, several at once where there is room.

A robot that sets out reserves its way; another sets out only if its own way keeps clear of the ways and places of all
others. When nobody can move, one that is in the way makes room first. Whoever steers nothing stands still.
"""

from collections.abc import Mapping
from math import atan2, cos, pi, sqrt
from typing import Any, NamedTuple

from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.grid import BLOCKED, wall_on_grid
from pigaming_app.sim.navigate import Errand, find_way, free_node, grow
from pigaming_app.sim.plant import Pose, Twist
from pigaming_app.sim.robots import RADIUS
from pigaming_app.sim.sweep import clear
from pigaming_app.sim.world import CELL, COLUMNS, HEIGHT, NODES, WIDTH, Wall, World

AT, FACING = 12.0, 0.10  # px and rad from its place within which a robot is there
SLOWEST, FASTEST = 45.0, 220.0  # px/s
SLOWEST_TURN, FASTEST_TURN = 0.7, 2.2  # rad/s
CORNER = 30.0  # px from a point of the way at which the next is made for
MARGIN = 14.0  # px between robots that pass each other
MOST_POINTS = 40  # of a way

Point = tuple[float, float]


class Place(NamedTuple):
    """How far a robot is from where it shall begin."""

    robot: int
    pose: Pose  # where it shall be
    distance: float  # px
    turn: float  # rad, how far it is turned away
    there: bool
    moving: bool  # it is on its way; else it is there, or waits for others to pass


class Homing:
    """Drives the robots of `goals` to these poses in the world's walls."""

    def __init__(self, world: World, goals: Mapping[int, Pose]) -> None:
        self.world: Any = world
        self.goals = dict(goals)
        self.places: list[Place] = []
        self._ways: dict[int, list[Point]] = {}
        self._aside: set[int] = set()  # robots that make room first
        self._home: set[int] = set()

    @property
    def done(self) -> bool:
        """Whether everybody was there when last looked at."""
        return len(self.places) == len(self.goals) and all(place.there for place in self.places)

    def twists(self, poses: Mapping[int, Pose]) -> dict[int, Twist]:
        """One tick: what to ask of each robot of `goals` now. `poses` are of all robots that stand on the mat."""
        self._note(poses)
        for robot in self.goals:
            if robot not in self._ways and robot not in self._home and robot in poses:
                self._set_out(robot, poses)
        if not self._ways and not self.done:
            self._make_room(poses)
        told = dict.fromkeys(self.goals, (0.0, 0.0))
        for robot in [robot for robot in self._ways if robot in poses]:
            told[robot] = self._follow(robot, poses[robot])
        return told

    def _note(self, poses: Mapping[int, Pose]) -> None:
        """See who is there. Who was and has been moved a little stays; who was carried off begins anew."""
        self.places = []
        for robot, goal in self.goals.items():
            if robot not in poses:
                self.places.append(Place(robot, goal, 1e9, pi, False, False))
                self._ways.pop(robot, None)
                continue
            x, y, heading = poses[robot]
            distance = sqrt((goal[0] - x) ** 2 + (goal[1] - y) ** 2)
            turn = abs(turn_to(goal[2] - heading))
            slack = 2.0 if robot in self._home else 1.0
            there = distance < AT * slack and turn < FACING * slack
            if there:
                self._home.add(robot)
                self._ways.pop(robot, None)
                self._aside.discard(robot)
            else:
                self._home.discard(robot)
            self.places.append(Place(robot, goal, distance, turn, there, robot in self._ways))

    def _set_out(self, robot: int, poses: Mapping[int, Pose]) -> None:
        x, y, _ = poses[robot]
        goal_x, goal_y, _ = self.goals[robot]
        way = _way(self._floor(robot, poses), (x, y), (goal_x, goal_y))
        if way:
            self._ways[robot] = way

    def _make_room(self, poses: Mapping[int, Pose]) -> None:
        """Send one robot that cannot get to its place to a free spot from where the others are not held up."""
        for robot in sorted(self.goals, key=lambda one: (one in self._aside, one)):
            if robot in self._home or robot not in poses:
                continue
            self._aside.add(robot)
            x, y, _ = poses[robot]
            floor = self._floor(robot, poses)
            taken = [(px, py) for other, (px, py, _) in poses.items() if other != robot]
            taken += [(gx, gy) for gx, gy, _ in self.goals.values()]
            for spot in _spots(floor, (x, y)):
                if all(_apart(spot, one) > 2.0 * RADIUS + 2.0 * MARGIN for one in taken):
                    self._ways[robot] = _way(floor, (x, y), spot)
                    return

    def _floor(self, robot: int, poses: Mapping[int, Pose]) -> Any:
        """The world's walls, and what stands or is on its way besides this robot, as walls."""
        floor = World()
        floor.wall_count, floor.grid = self.world.wall_count, list(self.world.grid)
        floor.walls = list(self.world.walls[: floor.wall_count])
        for other, (x, y, _) in poses.items():
            if other == robot:
                continue
            points = [(x, y), *self._ways.get(other, ())]
            for (ax, ay), (bx, by) in zip(points, points[1:] or points, strict=False):
                _add(floor, ax, ay, bx, by)
        return floor

    def _follow(self, robot: int, pose: Pose) -> Twist:
        """Along its way; at its end, turn as the place asks."""
        way, goal = self._ways[robot], self.goals[robot]
        x, y, heading = pose
        while len(way) > 1 and _apart((x, y), way[0]) < CORNER:
            way.pop(0)
        left = _apart((x, y), way[-1]) if len(way) == 1 else 1e9
        if left < (AT - 4.0):
            if robot in self._aside and _apart(way[-1], goal[:2]) > AT:
                del self._ways[robot]  # out of the way; from here to its place
                return 0.0, 0.0
            return 0.0, _turning(turn_to(goal[2] - heading))
        bearing = turn_to(atan2(way[0][1] - y, way[0][0] - x) - heading)
        back = left < 2.0 * RADIUS and abs(bearing) > 0.5 * pi
        bearing = turn_to(bearing + pi) if back else bearing
        speed = min(FASTEST, max(SLOWEST, 2.0 * left)) * max(0.0, cos(1.5 * bearing)) if abs(bearing) < 0.9 else 0.0
        return (-speed if back else speed), _turning(bearing) if abs(bearing) > 0.03 else 0.0


def _turning(angle: float) -> float:
    rate = min(FASTEST_TURN, max(SLOWEST_TURN, 2.5 * abs(angle)))
    return rate if angle > 0.0 else -rate


def _apart(one: Point, other: Point) -> float:
    return sqrt((one[0] - other[0]) ** 2 + (one[1] - other[1]) ** 2)


def _add(floor: Any, ax: float, ay: float, bx: float, by: float) -> None:
    """Stand a wall as wide as a robot on the floor, from one point to another or on a single one."""
    wall: Any = Wall()
    wall.ax, wall.ay, wall.bx, wall.by, wall.half, wall.health = ax, ay, bx, by, RADIUS + MARGIN, 1
    edge = wall.half + RADIUS
    wall.left, wall.right = min(ax, bx) - edge, max(ax, bx) + edge
    wall.top, wall.bottom = min(ay, by) - edge, max(ay, by) + edge
    floor.walls.append(wall)
    floor.wall_count += 1
    wall_on_grid(floor, wall, 1)


def _way(floor: Any, start: Point, goal: Point) -> list[Point]:
    """The points to drive to, the last of them the goal; empty where there is no way."""
    x, y = min(max(start[0], RADIUS), WIDTH - RADIUS), min(max(start[1], RADIUS), HEIGHT - RADIUS)
    errand: Any = Errand()
    errand.wanted, errand.goal_x, errand.goal_y = 1, goal[0], goal[1]
    way: list[Point] = []
    for _ in range(MOST_POINTS):
        find_way(floor, errand, x, y)
        if errand.straight:
            return [*way, goal] if clear(floor, x, y, *goal, RADIUS + 1.0) else _last_bit(floor, way, (x, y), goal)
        if way and (errand.way_x, errand.way_y) == way[-1]:
            return []
        x, y = errand.way_x, errand.way_y
        way.append((x, y))
    return []


def _last_bit(floor: Any, way: list[Point], at: Point, goal: Point) -> list[Point]:
    """A place beside a wall: from the node next to it straight there."""
    return [*way, goal] if _apart(at, goal) < CELL and clear(floor, *at, *goal, RADIUS - 2.0) else []


def _spots(floor: Any, start: Point) -> list[Point]:
    """The free nodes that can be reached from there, nearest first."""
    field: Any = Errand()
    root = free_node(floor, *start)
    if root == 0:
        return []
    grow(floor, field, root, -1)
    nodes = [node for node in range(NODES) if field.reach[node] > 1 and not floor.grid[node] & BLOCKED]
    nodes.sort(key=lambda node: int(field.reach[node]))
    return [(node % COLUMNS * CELL, node // COLUMNS * CELL) for node in nodes]
