"""Plant with real and simulated robots in one match: a real one is a moving, immovable obstacle to simulated ones.

Any robot can be swapped at any time: a simulated one continues from the pose of the real one; a real one first drives
or is carried to the pose of the simulated one (`take_places`).
"""

from collections.abc import Iterable, Sequence
from math import hypot
from typing import Any

from pigaming_app.hardware.control.moving_things import MovingThings, Things
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.control.rig import Rig, RobotSnapshot
from pigaming_app.hardware.control.safety import Fault
from pigaming_app.sim.contact import MOVED, ROUNDS, SLOP, limit_step, push_out_of_walls, put_back, separate
from pigaming_app.sim.plant import Pose, Twist
from pigaming_app.sim.robot import integrate
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import HEIGHT, WIDTH, World

BERTH = 7.0  # px, clearance from walls of a real robot that takes over


class MixedPlant(RealPlant):
    """The robots of `real` are real, the others simulated in the world's record."""

    def __init__(self, world: World, rig: Rig, real: Iterable[int] = ()) -> None:
        super().__init__(world, rig, real)
        self.arriving: set[int] = set()  # real robots that will take over
        self.things: MovingThings | None = None  # on the mat, if they may be moved

    @property
    def shown_things(self) -> Things | None:
        """The things in play now; None: those of the arena."""
        return self.things.shown if self.things else None

    def watch(self) -> list[Fault]:
        self._move_things()
        return super().watch()

    def _sense_tick(self) -> RobotSnapshot:
        self._move_things()
        return super()._sense_tick()

    def drive(self, twists: Sequence[Twist], dt: float) -> None:
        """Drive real robots within walls and safety, and simulate the others."""
        super().drive(twists, dt)
        twists = self.paced(twists)
        simulated = [i for i, robot in enumerate(self.world.robots) if robot.present and i not in self.real]
        for i in simulated:
            self.world.robots[i].requested_linear, self.world.robots[i].requested_angular = twists[i]
        simulate(self.world, simulated)

    def place(self, poses: Sequence[Pose]) -> None:
        """Place simulated robots at once; real ones begin to drive to their places."""
        for i, (x, y, heading) in enumerate(poses):
            if i not in self.real:
                robot = self.world.robots[i]
                robot.x, robot.y, robot.heading = x, y, heading
                robot.linear = robot.angular = 0.0
        super().place(poses)

    def swap(self, robot: int, real: bool) -> None:
        """Switch a robot between real and simulated. A real one must take its place first."""
        goals = self.goals
        if not real:
            self.real.discard(robot)
            self.arriving.discard(robot)
            goals.pop(robot, None)
            self.safety.forget(robot, not self.real | self.arriving)
        elif robot not in self.real:
            self.arriving.add(robot)
            record = self.world.robots[robot]
            goals[robot] = (*clear_of_walls(self.world, record.x, record.y), record.heading)
        self.summon(goals)

    def take_places(self) -> bool:
        """One tick of homing; true if all have arrived."""
        done = super().take_places()
        if done:
            self.start_from_here()
        return done

    def start_from_here(self) -> None:
        """Start from the present poses; robots that were summoned take over."""
        super().start_from_here()
        self.real |= self.arriving
        self.arriving.clear()

    def _move_things(self) -> None:
        """Replace the walls of things that have moved, between two ticks; after the match they stay."""
        if self.things is None or self.world.over:
            return
        simulated = [robot for i, robot in enumerate(self.world.robots) if robot.present and i not in self.real]
        moves = self.things.update(simulated)
        if self.recorder:
            self.recorder.moves += moves


def clear_of_walls(world: Any, x: float, y: float) -> tuple[float, float]:
    """The nearest point that a real robot can drive to, px; simulated ones may stand closer to walls."""
    berth = world.radius + BERTH
    for _ in range(ROUNDS):
        x, y = min(max(x, berth), WIDTH - berth), min(max(y, berth), HEIGHT - berth)
        for i in range(world.wall_count):
            wall = world.walls[i]
            dx, dy = offset_from_wall(wall, x, y)
            off, room = hypot(dx, dy), wall.half + berth
            if wall.health and 0.0 < off < room:
                x, y = x + dx * (room / off - 1.0), y + dy * (room / off - 1.0)
    return x, y


def simulate(world: Any, simulated: Sequence[int]) -> None:
    """One tick of these robots, as in sim.contact; all others are immovable."""
    robots = world.robots
    for i in simulated:
        if robots[i].recover:
            put_back(world, i)
    starts = [(robots[i], robots[i].x, robots[i].y) for i in simulated]
    fixed = [(robot, robot.x, robot.y) for i, robot in enumerate(robots) if i not in simulated]
    for i in simulated:
        integrate(robots[i])
    for _ in range(2 * ROUNDS):  # each round resolves half of the overlap with an immovable robot
        moved = separate(world) > SLOP
        for robot, x, y in fixed:
            robot.x, robot.y = x, y
        for i in simulated:
            moved = push_out_of_walls(world, robots[i]) == MOVED or moved
        if not moved:
            break
    for robot, x, y in starts:
        limit_step(world, robot, x, y)
