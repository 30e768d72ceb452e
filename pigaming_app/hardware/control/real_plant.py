"""Real robots as a plant: seen by a tracker, held back by virtual walls and by safety, told over the radio.

Nothing is moved but by its own motors. Before a match the robots take their places (`take_places`, tick by tick, until
it says so); while a match waits, somebody must `watch`, so that faults are noticed when they come and when they go.
"""

from collections.abc import Collection, Iterable, Sequence
from math import exp
from typing import Any

from pigaming_app.hardware.control.homing import Homing, HomingProgress
from pigaming_app.hardware.control.rig import Rig, RobotSnapshot
from pigaming_app.hardware.control.safety import Fault, Response, Safety
from pigaming_app.hardware.control.start_pattern import StartPattern
from pigaming_app.hardware.control.virtual_walls import clipped, coasting, limits
from pigaming_app.hardware.signals import WheelCommand
from pigaming_app.sim.plant import Pose, Sighting, Twist
from pigaming_app.sim.world import DT, HEIGHT, ROBOTS, WIDTH, World

FORGOTTEN = 1.0  # s after which a robot that nobody sees is nobody's obstacle
PUSH = 2000.0  # px/s^2 at which real robots gather speed: one that drives the wrong way is noticed before it is fast
FRESH = 0.5 * DT  # s: a game that thinks for longer is driven by a new prediction
REST: Twist = (0.0, 0.0)


class RealPlant:
    """The robots of `real` are real ones of the rig; the others stay where the world's record has them."""

    def __init__(self, world: World, rig: Rig, real: Iterable[int] = range(ROBOTS)) -> None:
        self.world: Any = world
        self.rig = rig
        self.real = set(real)
        self.safety = Safety()
        self.motion: list[Twist] = [REST] * ROBOTS  # px/s and rad/s, when what was said last begins to act
        self._pushed = [0.0] * ROBOTS  # px/s, what was asked of each robot last
        self._homing: Homing | None = None
        self._greeting = StartPattern()
        self._snapshot: RobotSnapshot | None = None  # of this tick, until it is driven by
        self._left_at: list[float | None] = [None] * ROBOTS  # s, when a robot left the arena

    @property
    def faults(self) -> list[Fault]:
        """What is wrong now, worst first."""
        return self.safety.faults

    @property
    def places(self) -> list[HomingProgress]:
        """How far the robots that take their places are; empty once all have."""
        return self._homing.places if self._homing else []

    @property
    def goals(self) -> dict[int, Pose]:
        """Where the robots that take their places shall be."""
        return dict(self._homing.goals) if self._homing else {}

    def sense(self) -> list[Sighting]:
        seen = self._look().now
        return [seen[i] if i in self.real else _recorded(robot) for i, robot in enumerate(self.world.robots)]

    def drive(self, twists: Sequence[Twist], dt: float) -> None:
        """Ask the real robots among these to drive; walls and safety have the last word."""
        snapshot, self._snapshot = self._snapshot, None
        if snapshot is None or self.rig.clock() - snapshot.time > FRESH:
            snapshot = self.rig.snapshot()
        seen = snapshot.now
        held = self._judge(snapshot)
        ahead = self._ahead(snapshot)
        solid = [i for i in range(ROBOTS) if self._is_solid(i, seen[i])]
        wheels = [self._wheels(i, twists[i], held[i], ahead, solid) for i in range(ROBOTS)]
        for i, robot in enumerate(self.world.robots):
            if i in self.real:
                self._roll(i, wheels[i], dt)
                robot.linear, robot.angular = self.motion[i]
        self.rig.tell(wheels)

    def place(self, poses: Sequence[Pose]) -> None:
        """Begin to take places: those of the real robots that are in the match."""
        self.summon({i: poses[i] for i in self.real if self.world.robots[i].present})

    def summon(self, goals: dict[int, Pose]) -> None:
        """Begin to take places: these robots, real or about to be."""
        self._homing = Homing(self.world, goals) if goals else None

    def take_places(self) -> bool:
        """One tick of driving there; whether all have arrived. Faults hold for it as for a match."""
        if self._homing is None:
            return True
        seen = self.sense_all()
        told = self._homing.twists(seen | self._projected(self._homing.goals))
        told |= self._greeting.twists(seen.keys() & told.keys())
        real = self.real
        self.real = real | set(told)
        try:
            self.drive([told.get(i, REST) for i in range(ROBOTS)], DT)
        finally:
            self.real = real
        if self._homing.done:
            self._homing = None
        return self._homing is None

    def accept_places(self) -> None:
        """Let everybody begin where it stands."""
        self._homing = None

    def forgive(self, robot: int) -> None:
        """Somebody has looked after a robot that did not do as it was told: it may try again."""
        self.rig.forget(robot)
        self.safety.forgive(robot)

    def watch(self) -> list[Fault]:
        """One tick of a match that waits: all robots stand; what is wrong now."""
        self.rig.pump()
        self.drive([REST] * ROBOTS, DT)
        return self.faults

    def sense_all(self) -> dict[int, Pose]:
        """The robots that are seen on the mat, in a match or not."""
        found = enumerate(self._look().now)
        return {i: (one.x, one.y, one.heading) for i, one in found if one.age < FORGOTTEN}

    def _look(self) -> RobotSnapshot:
        """The robots at the beginning of a tick."""
        self.rig.pump()
        self._snapshot = self.rig.snapshot()
        return self._snapshot

    def _projected(self, calling: Collection[int]) -> dict[int, Pose]:
        """The simulated robots among which the real ones take their places, counted from ROBOTS on."""
        return {
            ROBOTS + i: (robot.x, robot.y, robot.heading)
            for i, robot in enumerate(self.world.robots)
            if robot.present and i not in self.real and i not in calling
        }

    def close(self) -> None:
        """Stop the robots and let go of the hardware."""
        self.rig.close()

    def _judge(self, seen: RobotSnapshot) -> list[Response]:
        """What safety says of every robot."""
        now, outside = self.rig.clock(), dict[int, float]()
        for i, sighting in enumerate(seen.now):
            inside = 0.0 <= sighting.x <= WIDTH and 0.0 <= sighting.y <= HEIGHT
            left_at = self._left_at[i]
            self._left_at[i] = None if inside or sighting.age > FORGOTTEN else now if left_at is None else left_at
            if i in self.real and self.world.robots[i].present:
                outside[i] = max(now - left_at, 1e-3) if (left_at := self._left_at[i]) is not None else 0.0
        signs = self.rig.signs(outside, seen)
        return self.safety.judge([signs.get(i) for i in range(ROBOTS)], now)

    def _ahead(self, snapshot: RobotSnapshot) -> list[Pose]:
        """Where every robot, real or not, comes to rest if it is told to stop now."""
        trains = [one.drivetrain for one in self.rig.kinematics]
        poses = []
        for i, (robot, train) in enumerate(zip(self.world.robots, trains, strict=True)):
            seen = snapshot.later[i]
            simulated = robot.present and i not in self.real
            pose = (robot.x, robot.y, robot.heading) if simulated else (seen.x, seen.y, seen.heading)
            poses.append(coasting(pose, self.motion[i], train.lag) if i in self.real else pose)
        return poses

    def _is_solid(self, robot: int, seen: Sighting) -> bool:
        """Whether it must not be run into: all in the match, and what else the camera sees."""
        simulated = self.world.robots[robot].present and robot not in self.real
        return bool(simulated) or seen.age < FORGOTTEN

    def _wheels(
        self, robot: int, asked: Twist, held: Response, ahead: Sequence[Pose], solid: Sequence[int]
    ) -> WheelCommand | None:
        """What one robot is told: nothing, to stand, or what walls and safety leave of what was asked."""
        if robot not in self.real or not self.world.robots[robot].present or held == Response.OFF:
            return None
        kinematics = self.rig.kinematics[robot]
        if held == Response.STOP:
            self._pushed[robot] = 0.0
            return kinematics.stand()
        if held == Response.HALF:
            asked = (0.5 * asked[0], 0.5 * asked[1])
        x, y, _ = ahead[robot]
        others = [(ahead[i][0], ahead[i][1]) for i in solid if i != robot]
        asked = eased(asked[0], self._pushed[robot]), asked[1]
        left = clipped(ahead[robot], asked, limits(self.world, x, y, others), kinematics.drivetrain.lag)
        self._pushed[robot] = left[0]
        return kinematics.wheels(left)

    def _roll(self, robot: int, wheels: WheelCommand | None, dt: float) -> None:
        """Follow the motors: how fast the robot will go when the next command acts."""
        kinematics = self.rig.kinematics[robot]
        goal = kinematics.goes(wheels) if wheels else REST
        share = 1.0 - exp(-dt / kinematics.drivetrain.lag)
        linear, angular = self.motion[robot]
        self.motion[robot] = (linear + (goal[0] - linear) * share, angular + (goal[1] - angular) * share)


def eased(asked: float, before: float) -> float:
    """A speed, px/s, that is not farther from standing still than PUSH allows in a tick; slowing down is free."""
    start = before if before * asked > 0.0 else 0.0
    most = abs(start) + PUSH * DT
    return max(-most, min(most, asked))


def _recorded(robot: Any) -> Sighting:
    return Sighting(robot.x, robot.y, robot.heading, 0.0)
