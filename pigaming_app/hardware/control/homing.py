"""Brings real robots to their places: round walls and round each other, smoothly, several at once where there is room.

A robot that sets out reserves its way; another sets out only if its own way keeps clear of the ways and places of all
others. When nobody can move, one that is in the way makes room first. Whoever steers nothing stands still.
"""

from collections.abc import Mapping
from math import atan2, cos, pi, sqrt
from typing import Any, NamedTuple

from pigaming_app.hardware.control.path_planner import Point, among, apart, floor_with, spots, way_to
from pigaming_app.hardware.control.virtual_walls import GAMMA, limits
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.plant import Pose, Twist
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.world import ROBOTS, World

AT, FACING = 12.0, 0.10  # px and rad from its place within which a robot is there
SLOWEST, FASTEST = 45.0, 220.0  # px/s
SLOWEST_TURN, FASTEST_TURN = 0.7, 2.2  # rad/s
CORNER = 30.0  # px from a point of the way at which the next is made for
MARGIN = 14.0  # px between robots that pass each other
BERTHS = (18.0, 4.0)  # px between a robot on its way and a wall, which slows it down; the second where it is narrow
HELD = 4.0 * GAMMA  # px/s: where a wall allows less, the robot drives along it, and out of it where it allows nothing
AGAIN = 20  # ticks after which a way is found anew
MOVED = 0.03  # rad, or tens of px: less than that is no motion
PATIENCE = 10  # ticks without motion after which the slowest speeds grow, each tick by PUSH
PUSH, MOST = 0.05, 2.5
EASE = 0.99  # share of the push that is left after each tick in which it moves
REST: Twist = (0.0, 0.0)


class HomingProgress(NamedTuple):
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
        self.places: list[HomingProgress] = []
        self._floors = [floor_with(world, berth) for berth in BERTHS]
        self._ways: dict[int, list[Point]] = {}
        self._aside: set[int] = set()  # robots that have made room
        self._arrived: set[int] = set()  # robots that only have to turn
        self._home: set[int] = set()
        self._tick = 0
        self._push = [1.0] * ROBOTS  # by what the slowest speeds are multiplied
        self._before: dict[int, tuple[int, Pose]] = {}  # the tick and the pose when it last moved

    @property
    def done(self) -> bool:
        """Whether everybody was there when last looked at."""
        return len(self.places) == len(self.goals) and all(place.there for place in self.places)

    def twists(self, poses: Mapping[int, Pose]) -> dict[int, Twist]:
        """One tick: what to ask of each robot of `goals` now. `poses` are of all robots that stand on the mat."""
        self._tick += 1
        self.places = [self._placed(robot, poses.get(robot)) for robot in self.goals]
        for robot in self.goals:
            due = robot not in self._ways or (self._tick + 5 * robot) % AGAIN == 0
            if due and robot in poses and robot not in self._home and robot not in self._arrived:
                self._set_out(robot, poses)
        if not self._ways and not self.done:
            self._make_room(poses)
        told = dict.fromkeys(self.goals, REST)
        for robot in list(self._ways):
            told[robot] = self._follow(robot, poses[robot])
            self._feel(robot, poses[robot], told[robot])
        return told

    def _placed(self, robot: int, pose: Pose | None) -> HomingProgress:
        """Who is there stays, even if it is moved a little; who was carried off begins anew."""
        goal = self.goals[robot]
        if pose is None:
            self._forget(robot)
            return HomingProgress(robot, goal, 1e9, pi, False, False)
        distance, turn = apart(goal[:2], pose[:2]), abs(turn_to(goal[2] - pose[2]))
        slack = 2.0 if robot in self._home else 1.0
        there = distance < AT * slack and turn < FACING * slack
        if there:
            self._forget(robot)
            self._home.add(robot)
        else:
            self._home.discard(robot)
        return HomingProgress(robot, goal, distance, turn, there, robot in self._ways)

    def _forget(self, robot: int) -> None:
        self._ways.pop(robot, None)
        self._aside.discard(robot)
        self._arrived.discard(robot)

    def _set_out(self, robot: int, poses: Mapping[int, Pose]) -> None:
        """Find the way to where it makes for: its place, or a spot where it is in nobody's way."""
        target = self._ways[robot][-1] if robot in self._ways else self.goals[robot][:2]
        for floor in self._floors:
            way = way_to(self._among(floor, robot, poses), poses[robot][:2], target)
            if way:
                self._ways[robot] = way
                return

    def _make_room(self, poses: Mapping[int, Pose]) -> None:
        """Send one robot that cannot get to its place to a free spot from where the others are not held up.

        The last one to arrive waits: nobody would be helped by its driving about.
        """
        under_way = [robot for robot in self.goals if robot in poses and robot not in self._home]
        if len(under_way) < 2:
            return
        for robot in sorted(under_way, key=lambda one: (one in self._aside, one)):
            self._aside.add(robot)
            floor = self._among(self._floors[0], robot, poses)
            taken = [pose[:2] for other, pose in poses.items() if other != robot]
            taken += [goal[:2] for goal in self.goals.values()]
            for spot in spots(floor, poses[robot][:2]):
                if all(apart(spot, one) > 2.0 * (RADIUS + MARGIN) for one in taken):
                    self._ways[robot] = way_to(floor, poses[robot][:2], spot) or [spot]
                    return

    def _among(self, floor: Any, robot: int, poses: Mapping[int, Pose]) -> Any:
        """The floor with what stands or is on its way besides this robot."""
        lines = [[pose[:2], *self._ways.get(other, ())] for other, pose in poses.items() if other != robot]
        return among(floor, lines, RADIUS + MARGIN)

    def _follow(self, robot: int, pose: Pose) -> Twist:
        """Along its way; at its end, turn as the place asks."""
        way, goal, push = self._ways[robot], self.goals[robot], self._push[robot]
        x, y, heading = pose
        while len(way) > 1 and apart((x, y), way[0]) < CORNER:
            way.pop(0)
        left = apart((x, y), way[-1]) if len(way) == 1 else 1e9
        if left < (AT if robot in self._arrived else AT - 4.0):
            if apart(way[-1], goal[:2]) > AT:
                del self._ways[robot]  # out of the way; from here to its place
                return REST
            self._arrived.add(robot)
            return 0.0, _on_the_spot(turn_to(goal[2] - heading), push)
        self._arrived.discard(robot)
        dx, dy = way[0][0] - x, way[0][1] - y
        along = _along(self.world, (x, y), (dx, dy))
        held = along != (dx, dy)
        bearing = turn_to(atan2(along[1], along[0]) - heading)
        back = left < 2.0 * RADIUS and abs(bearing) > 0.5 * pi
        bearing = turn_to(bearing + pi) if back else bearing
        if abs(bearing) > 0.9:
            return 0.0, _on_the_spot(bearing, push)
        speed = SLOWEST * push if held else min(FASTEST, max(SLOWEST * push, 2.0 * left)) * cos(1.5 * bearing)
        return (-speed if back else speed), 2.5 * bearing

    def _feel(self, robot: int, pose: Pose, told: Twist) -> None:
        """Motors with a wide deadband stand still at first: push until the robot moves, then ease off."""
        since, (x, y, heading) = self._before.get(robot, (self._tick, pose))
        moved = 0.1 * apart((x, y), pose[:2]) + abs(turn_to(pose[2] - heading))
        if moved >= MOVED or told == REST or robot not in self._before:
            self._before[robot] = self._tick, pose
            self._push[robot] = max(1.0, EASE * self._push[robot])
        elif self._tick - since > PATIENCE:
            self._push[robot] = min(self._push[robot] + PUSH, MOST)


def _on_the_spot(angle: float, push: float) -> float:
    """Rad/s to turn by an angle."""
    rate = min(FASTEST_TURN, max(push * SLOWEST_TURN, 2.5 * abs(angle)))
    return rate if angle > 0.0 else -rate


def _along(world: Any, at: Point, aim: Point) -> Point:
    """The direction of `aim`, but along a wall that holds a robot there, and the more away from it the nearer it is.

    Straight away from the wall would be a trap: at the end of a wall a robot would go out, on, out, and get nowhere.
    """
    held = [limit for limit in limits(world, *at) if limit.speed < HELD]
    out_x, out_y = -sum(limit.nx for limit in held), -sum(limit.ny for limit in held)
    length = sqrt(out_x * out_x + out_y * out_y)
    inward = -(aim[0] * out_x + aim[1] * out_y)
    if length < 1e-6 or inward <= 0.0:
        return aim
    out_x, out_y, inward = out_x / length, out_y / length, inward / length
    near = 1.0 - min(limit.speed for limit in held) / HELD
    off = near * sqrt(aim[0] * aim[0] + aim[1] * aim[1]) + (1.0 - near) * inward
    return (1.0 - near) * aim[0] + off * out_x, (1.0 - near) * aim[1] + off * out_y
