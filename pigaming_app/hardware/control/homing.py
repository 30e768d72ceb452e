"""Homing: drives real robots to their start poses, round walls and each other, several at once where there is room.

A robot that sets out reserves its path; another sets out only if its own path is clear of all reserved paths and
standing robots. When no robot can move, one makes room, each in its turn, at last those that have arrived; these wait
until the others are home. All others stand still.
"""

from collections.abc import Collection, Mapping, Sequence
from itertools import pairwise
from math import atan2, cos, dist, pi, sqrt
from typing import Any, NamedTuple

from pigaming_app.hardware.control.path_planner import Point, find_path, inflated_floor, reachable_nodes, with_obstacles
from pigaming_app.hardware.control.virtual_walls import GAMMA, speed_limits
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.plant import Pose, Twist
from pigaming_app.sim.world import HZ, ROBOTS, World

POSITION_TOLERANCE, HEADING_TOLERANCE = 12.0, 0.10  # px and rad, tolerances of the goal pose
SLOWEST, FASTEST = 45.0, 220.0  # px/s
SLOWEST_TURN, FASTEST_TURN = 0.7, 2.2  # rad/s
CORNER = 30.0  # px from a waypoint within which the robot heads for the next
MARGIN = 14.0  # px between robots that pass each other
BERTHS = (18.0, 4.0)  # px of clearance from walls, which slow a robot down; the second for narrow gaps
HELD = 4.0 * GAMMA  # px/s: under a lower speed limit a robot drives along the wall, and away from it at 0
REPLAN = 20  # ticks between two searches of a path
MOVED = 0.03  # rad, or tens of px: least motion
PATIENCE = 10  # ticks without motion after which the slowest speeds grow, each tick by PUSH
PUSH, MAX_PUSH = 0.05, 2.5
EASE = 0.99  # decay of the push per tick of motion
REST: Twist = (0.0, 0.0)
RATE = 2.4  # rad/s, of the start pattern
SLOT = round(0.7 * HZ)  # ticks of a turn
PATTERNS = ((1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0))  # by robot


class HomingProgress(NamedTuple):
    """Progress of a robot towards its start pose."""

    robot: int
    pose: Pose  # the goal
    distance: float  # px
    turn: float  # rad, absolute heading error
    arrived: bool
    moving: bool  # under way; else it has arrived, or waits for others to pass


class Homing:
    """Drives the robots of `goals` (pose by robot) through the walls of the world.

    `margins`: length by which each robot's body is wider than that of a simulated one, px (see Rig.margin).
    """

    def __init__(self, world: World, goals: Mapping[int, Pose], margins: Sequence[float] = (0.0,) * ROBOTS) -> None:
        self.world: Any = world
        self._margins = [*margins, *[0.0] * ROBOTS]  # of the real robots, then of the simulated ones
        self.goals = dict(goals)
        self.places: list[HomingProgress] = []
        self._floors = {
            margin: [inflated_floor(world, berth, margin) for berth in BERTHS] for margin in set(self._margins)
        }
        self._paths: dict[int, list[Point]] = {}
        self._yielded: dict[int, int] = {}  # tick at which a robot last set out to make room
        self._waiting: set[int] = set()  # robots that had arrived and have made room
        self._arrived: set[int] = set()  # at the goal's position; only the turn is left
        self._home: set[int] = set()
        self._tick = 0
        self._push = [1.0] * ROBOTS  # factor of the slowest speeds
        self._last_motion: dict[int, tuple[int, Pose]] = {}  # tick and pose of the last motion

    @property
    def done(self) -> bool:
        """True if all robots had arrived in the last tick."""
        return len(self.places) == len(self.goals) and all(place.arrived for place in self.places)

    def twists(self, poses: Mapping[int, Pose]) -> dict[int, Twist]:
        """One tick: the twist of each robot of `goals`, px/s and rad/s. `poses`: all robots on the mat."""
        self._tick += 1
        self.places = [self._placed(robot, poses.get(robot)) for robot in self.goals]
        if not self._blocked(poses):
            self._waiting.clear()
        for robot in sorted(self.goals.keys() - self._waiting):
            due = robot not in self._paths or (self._tick + 5 * robot) % REPLAN == 0
            if due and robot in poses and robot not in self._home and robot not in self._arrived:
                self._set_out(robot, poses)
        if not self._paths and not self.done:
            self._make_room(poses)
        twists = dict.fromkeys(self.goals, REST)
        for robot in list(self._paths):
            twists[robot] = self._follow(robot, poses[robot])
            self._adapt_push(robot, poses[robot], twists[robot])
        return twists

    def _placed(self, robot: int, pose: Pose | None) -> HomingProgress:
        """The progress of a robot, with hysteresis: one that has arrived stays so if nudged, but not if carried off."""
        goal = self.goals[robot]
        if pose is None:
            self._forget(robot)
            return HomingProgress(robot, goal, 1e9, pi, False, False)
        off, turn = dist(goal[:2], pose[:2]), abs(turn_to(goal[2] - pose[2]))
        slack = 2.0 if robot in self._home else 1.0
        leaves = robot in self._paths and dist(self._paths[robot][-1], goal[:2]) > POSITION_TOLERANCE
        arrived = not leaves and off < POSITION_TOLERANCE * slack and turn < HEADING_TOLERANCE * slack
        if arrived:
            self._forget(robot)
            self._home.add(robot)
        else:
            self._home.discard(robot)
        return HomingProgress(robot, goal, off, turn, arrived, robot in self._paths)

    def _forget(self, robot: int) -> None:
        self._paths.pop(robot, None)
        self._arrived.discard(robot)

    def _set_out(self, robot: int, poses: Mapping[int, Pose]) -> None:
        """Find a path to its target: its goal, or the spot where it makes room."""
        target = self._paths[robot][-1] if robot in self._paths else self.goals[robot][:2]
        for floor in self._floors[self._margins[robot]]:
            path = find_path(self._among(floor, robot, poses), poses[robot][:2], target)
            if path:
                self._paths[robot] = path
                return

    def _make_room(self, poses: Mapping[int, Pose]) -> None:
        """Send one robot to a free spot clear of all goals and robots, and if possible of the ways of the others.

        If only one has not arrived, moving it would help no other.
        """
        blocked = self._blocked(poses)
        if not blocked:
            return
        others = [robot for robot in self.goals if robot in poses and {robot} != blocked and robot not in self._waiting]
        for robot in sorted(others, key=lambda robot: (self._yielded.get(robot, -1), robot in self._home, robot)):
            if robot in self._home:
                self._waiting.add(robot)
            elif robot in self._yielded:  # all have made room, in vain
                self._waiting.clear()
            self._yielded[robot] = self._tick
            floor = self._among(self._floors[self._margins[robot]][0], robot, poses)
            taken = [pose[:2] for other, pose in poses.items() if other != robot]
            taken += [goal[:2] for goal in self.goals.values()]
            wide = 2.0 * (self.world.radius + MARGIN + max(self._margins))
            nodes = reachable_nodes(floor, poses[robot][:2])
            spots = [spot for spot in nodes if all(dist(spot, point) > wide for point in taken)]
            ways = [self._way(other, poses[other]) for other in blocked - {robot}]
            aside = (spot for spot in spots if all(_off(way, spot) > wide for way in ways))
            if spots:
                spot = next(aside, spots[0])
                self._paths[robot] = find_path(floor, poses[robot][:2], spot) or [spot]
                return

    def _way(self, robot: int, pose: Pose) -> list[Point]:
        """The way of a robot to its goal if it were alone."""
        floor = self._floors[self._margins[robot]][-1]
        return [pose[:2], *(find_path(floor, pose[:2], self.goals[robot][:2]) or [self.goals[robot][:2]])]

    def _blocked(self, poses: Mapping[int, Pose]) -> set[int]:
        """The robots that are not at their goals, but for those that wait."""
        return {robot for robot in self.goals if robot in poses} - self._home - self._waiting

    def _among(self, floor: Any, robot: int, poses: Mapping[int, Pose]) -> Any:
        """The floor with all other robots and their paths as obstacles."""
        half = self.world.radius + MARGIN + self._margins[robot]
        lines = [
            ([pose[:2], *self._paths.get(other, ())], half + self._margins[other])
            for other, pose in poses.items()
            if other != robot
        ]
        return with_obstacles(floor, lines)

    def _follow(self, robot: int, pose: Pose) -> Twist:
        """The twist along its path; at the end, the turn to the goal's heading."""
        path, goal, push = self._paths[robot], self.goals[robot], self._push[robot]
        x, y, heading = pose
        while len(path) > 1 and dist((x, y), path[0]) < CORNER:
            path.pop(0)
        remaining = dist((x, y), path[-1]) if len(path) == 1 else 1e9
        if remaining < (POSITION_TOLERANCE if robot in self._arrived else POSITION_TOLERANCE - 4.0):
            if dist(path[-1], goal[:2]) > POSITION_TOLERANCE:
                del self._paths[robot]  # it has made room; plan from here to its goal
                return REST
            self._arrived.add(robot)
            return 0.0, _on_the_spot(turn_to(goal[2] - heading), push)
        self._arrived.discard(robot)
        dx, dy = path[0][0] - x, path[0][1] - y
        direction = _slide(self.world, (x, y), (dx, dy), self._margins[robot])
        held = direction != (dx, dy)
        bearing = turn_to(atan2(direction[1], direction[0]) - heading)
        back = remaining < 2.0 * self.world.radius and abs(bearing) > 0.5 * pi
        bearing = turn_to(bearing + pi) if back else bearing
        if abs(bearing) > 0.9:
            return 0.0, _on_the_spot(bearing, push)
        speed = SLOWEST * push if held else min(FASTEST, max(SLOWEST * push, 2.0 * remaining)) * cos(1.5 * bearing)
        return (-speed if back else speed), 2.5 * bearing

    def _adapt_push(self, robot: int, pose: Pose, twist: Twist) -> None:
        """Raise the slowest speeds until a robot with a wide deadband moves, then let them decay."""
        since, (x, y, heading) = self._last_motion.get(robot, (self._tick, pose))
        moved = 0.1 * dist((x, y), pose[:2]) + abs(turn_to(pose[2] - heading))
        if moved >= MOVED or twist == REST or robot not in self._last_motion:
            self._last_motion[robot] = self._tick, pose
            self._push[robot] = max(1.0, EASE * self._push[robot])
        elif self._tick - since > PATIENCE:
            self._push[robot] = min(self._push[robot] + PUSH, MAX_PUSH)


def _off(way: Sequence[Point], point: Point) -> float:
    """Distance of a point from a way, px."""
    gaps = []
    for (ax, ay), (bx, by) in pairwise(way):
        ex, ey = bx - ax, by - ay
        along = ((point[0] - ax) * ex + (point[1] - ay) * ey) / max(ex * ex + ey * ey, 1e-9)
        share = min(max(along, 0.0), 1.0)
        gaps.append(dist(point, (ax + share * ex, ay + share * ey)))
    return min(gaps)


def _on_the_spot(angle: float, push: float) -> float:
    """Turn rate (rad/s) towards an angle (rad)."""
    rate = min(FASTEST_TURN, max(push * SLOWEST_TURN, 2.5 * abs(angle)))
    return rate if angle > 0.0 else -rate


def _slide(world: Any, at: Point, aim: Point, margin: float) -> Point:
    """The direction of `aim`, deflected along a wall that limits the robot, and away from it the nearer it is.

    Straight away from the wall would oscillate: at the end of a wall a robot would move out and back without progress.
    """
    held = [limit for limit in speed_limits(world, *at, margin=margin) if limit.speed < HELD]
    out_x, out_y = -sum(limit.nx for limit in held), -sum(limit.ny for limit in held)
    length = sqrt(out_x * out_x + out_y * out_y)
    inward = -(aim[0] * out_x + aim[1] * out_y)
    if length < 1e-6 or inward <= 0.0:
        return aim
    out_x, out_y, inward = out_x / length, out_y / length, inward / length
    near = 1.0 - min(limit.speed for limit in held) / HELD
    off = near * sqrt(aim[0] * aim[0] + aim[1] * aim[1]) + (1.0 - near) * inward
    return (1.0 - near) * aim[0] + off * out_x, (1.0 - near) * aim[1] + off * out_y


class StartPattern:
    """Two turns of every robot, from when it is first seen, in a distinct pattern.

    With a wrong lid, wiring or wheel they contradict the commands, so faults are detected before it drives; see
    motion_check.
    """

    def __init__(self) -> None:
        self._ticks: dict[int, int] = {}  # by robot, since its start

    def twists(self, seen: Collection[int]) -> dict[int, Twist]:
        """One tick: the twists (px/s, rad/s) of those robots that have not finished."""
        twists: dict[int, Twist] = {}
        for robot in seen:
            ticks = self._ticks.setdefault(robot, 0)
            if ticks < 2 * SLOT:
                self._ticks[robot] = ticks + 1
                twists[robot] = 0.0, RATE * PATTERNS[robot][ticks // SLOT]
        return twists
