"""Real robots as a plant: observed by a tracker, limited by virtual walls and safety, commanded over the radio.

Robots move only by their own motors. Before a match they drive to their places (`take_places`, once a tick, until it
returns True); while a match is paused, `watch` must be called once a tick, so that faults are detected and cleared.
"""

from collections.abc import Collection, Iterable, Sequence
from math import exp
from typing import Any

from pigaming_app.hardware.control.homing import Homing, HomingProgress, StartPattern
from pigaming_app.hardware.control.match_recording import MatchRecorder
from pigaming_app.hardware.control.rig import Rig, RobotSnapshot
from pigaming_app.hardware.control.safety import Fault, Response, Safety
from pigaming_app.hardware.control.virtual_walls import clip_twist, speed_limits, stopping_pose
from pigaming_app.hardware.signals import WheelCommand
from pigaming_app.sim.plant import Pose, Sighting, Twist
from pigaming_app.sim.world import DT, HEIGHT, ROBOTS, WIDTH, World

FORGOTTEN = 1.0  # s, age of a pose beyond which a robot is no obstacle
MAX_ACCELERATION = 2000.0  # px/s^2: a robot that drives the wrong way is detected before it is fast
UNPROVEN = 340.0  # mm/s, top speed of a robot that has not yet moved as commanded: it may be wired wrongly
FRESH = 0.5 * DT  # s, age of a prediction beyond which `drive` makes a new one
REST: Twist = (0.0, 0.0)


def held_to(pace: tuple[float, float], twist: Twist) -> Twist:
    """A twist of the same curvature whose wheels are not faster than a pace (see Rig.pace)."""
    (top, half), (linear, angular) = pace, twist
    share = min(1.0, top / max(abs(linear) + half * abs(angular), 1e-9))
    return linear * share, angular * share


class RealPlant:
    """The robots of `real` are those of the rig; the others stay at the pose of the world's record."""

    def __init__(self, world: World, rig: Rig, real: Iterable[int] = range(ROBOTS)) -> None:
        self.world: Any = world
        self.rig = rig
        self.real = set(real)
        self.safety = Safety(rig.remote)
        self.recorder: MatchRecorder | None = None  # of the match, if it is recorded
        self.motion: list[Twist] = [REST] * ROBOTS  # px/s and rad/s, predicted to when the latest command acts
        self._speeds = [0.0] * ROBOTS  # px/s, last commanded speed of each robot
        self._homing: Homing | None = None
        self._start_pattern = StartPattern()
        self._snapshot: RobotSnapshot | None = None  # of this tick, until `drive` uses it
        self._left_at: list[float | None] = [None] * ROBOTS  # s, when a robot left the arena

    @property
    def mm(self) -> float:
        """Length of an arena px, mm."""
        return self.rig.mm

    @property
    def faults(self) -> list[Fault]:
        """Present faults, worst first."""
        return self.safety.faults

    @property
    def places(self) -> list[HomingProgress]:
        """Progress of the robots that take their places; empty once all have."""
        return self._homing.places if self._homing else []

    @property
    def goals(self) -> dict[int, Pose]:
        """Goal poses of the robots that take their places."""
        return dict(self._homing.goals) if self._homing else {}

    def sense(self) -> list[Sighting]:
        seen, robots = self._sense_tick().now, self.world.robots
        sightings = [seen[i] if i in self.real else _recorded(robot) for i, robot in enumerate(robots)]
        if self.recorder:
            self.recorder.track.add(robots, sightings)
        return sightings

    def drive(self, twists: Sequence[Twist], dt: float) -> None:
        """Command the real robots, clipped by walls and safety."""
        twists = self.paced(twists)
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
        self.rig.send(wheels)

    def paced(self, twists: Sequence[Twist]) -> list[Twist]:
        """Twists that the slowest real robot can follow, so that nobody is faster; paths keep their curvature."""
        pace = self.rig.pace([i for i in self.real if self.world.robots[i].present])
        return [held_to(pace, twist) for twist in twists]

    def place(self, poses: Sequence[Pose]) -> None:
        """Start homing the real robots of the match to these poses."""
        self.summon({i: poses[i] for i in self.real if self.world.robots[i].present})

    def summon(self, goals: dict[int, Pose]) -> None:
        """Start homing these robots, real or about to be."""
        margins = [self.rig.margin(robot, self.world.radius) for robot in range(ROBOTS)]
        self._homing = Homing(self.world, goals, margins) if goals else None

    def take_places(self) -> bool:
        """One tick of homing; true if all have arrived. Faults apply as in a match."""
        if self._homing is None:
            return True
        seen = self.sense_all()
        twists = self._homing.twists(seen | self._projected(self._homing.goals))
        twists |= self._start_pattern.twists(seen.keys() & twists.keys())
        real = self.real
        self.real = real | set(twists)
        try:
            self.drive([twists.get(i, REST) for i in range(ROBOTS)], DT)
        finally:
            self.real = real
        if self._homing.done:
            self._homing = None
        return self._homing is None

    def start_from_here(self) -> None:
        """Start from the present poses."""
        self._homing = None

    def clear_fault(self, robot: int) -> None:
        """Clear the latched fault of a robot after somebody has checked it."""
        self.rig.forget(robot)
        self.safety.clear_fault(robot)

    def watch(self) -> list[Fault]:
        """One tick of a paused match: all robots stand. Returns the present faults."""
        self.rig.pump()
        self.drive([REST] * ROBOTS, DT)
        return self.faults

    def sense_all(self) -> dict[int, Pose]:
        """Poses of all robots on the mat, in a match or not."""
        seen = enumerate(self._sense_tick().now)
        return {i: (robot.x, robot.y, robot.heading) for i, robot in seen if robot.age < FORGOTTEN}

    def _sense_tick(self) -> RobotSnapshot:
        """The snapshot for this tick."""
        self.rig.pump()
        self._snapshot = self.rig.snapshot()
        return self._snapshot

    def _projected(self, summoned: Collection[int]) -> dict[int, Pose]:
        """Poses of the simulated robots except those summoned, numbered from ROBOTS on: obstacles for homing."""
        return {
            ROBOTS + i: (robot.x, robot.y, robot.heading)
            for i, robot in enumerate(self.world.robots)
            if robot.present and i not in self.real and i not in summoned
        }

    def close(self) -> None:
        """Stop the robots and release the hardware."""
        self.rig.close()

    def _judge(self, seen: RobotSnapshot) -> list[Response]:
        """The safety response for every robot."""
        now, outside = self.rig.clock(), dict[int, float]()
        for i, sighting in enumerate(seen.now):
            inside = 0.0 <= sighting.x <= WIDTH and 0.0 <= sighting.y <= HEIGHT
            left_at = self._left_at[i]
            self._left_at[i] = None if inside or sighting.age > FORGOTTEN else now if left_at is None else left_at
            if i in self.real and self.world.robots[i].present:
                outside[i] = max(now - left_at, 1e-3) if (left_at := self._left_at[i]) is not None else 0.0
        health = self.rig.health(outside, seen)
        return self.safety.judge([health.get(i) for i in range(ROBOTS)], now)

    def _ahead(self, snapshot: RobotSnapshot) -> list[Pose]:
        """The stopping pose of every robot, real or simulated."""
        trains = [kinematics.drivetrain for kinematics in self.rig.kinematics]
        poses = []
        for i, (robot, train) in enumerate(zip(self.world.robots, trains, strict=True)):
            seen = snapshot.later[i]
            simulated = robot.present and i not in self.real
            pose = (robot.x, robot.y, robot.heading) if simulated else (seen.x, seen.y, seen.heading)
            poses.append(stopping_pose(pose, self.motion[i], train.lag) if i in self.real else pose)
        return poses

    def _is_solid(self, robot: int, seen: Sighting) -> bool:
        """True if it is an obstacle: in the match, or seen by the camera."""
        simulated = self.world.robots[robot].present and robot not in self.real
        return bool(simulated) or seen.age < FORGOTTEN

    def _margin(self, robot: int) -> float:
        """Margin of an obstacle, px: 0 for a simulated robot."""
        simulated = self.world.robots[robot].present and robot not in self.real
        return 0.0 if simulated else self.rig.margin(robot, self.world.radius)

    def _wheels(
        self, robot: int, desired: Twist, held: Response, ahead: Sequence[Pose], solid: Sequence[int]
    ) -> WheelCommand | None:
        """The command of one robot: None, rest, or the twist clipped by walls and safety."""
        if robot not in self.real or not self.world.robots[robot].present or held == Response.OFF:
            return None
        kinematics = self.rig.kinematics[robot]
        if held == Response.STOP:
            self._speeds[robot] = 0.0
            return kinematics.stand()
        if held == Response.HALF:
            desired = (0.5 * desired[0], 0.5 * desired[1])
        if not self.rig.motion_checks[robot].obeys:
            desired = held_to((UNPROVEN / self.mm, 0.0), desired)
        x, y, _ = ahead[robot]
        others = [(ahead[i][0], ahead[i][1], self._margin(i)) for i in solid if i != robot]
        desired = limit_acceleration(desired[0], self._speeds[robot]), desired[1]
        limits = speed_limits(self.world, x, y, others, self._margin(robot))
        allowed = clip_twist(ahead[robot], desired, limits, kinematics.drivetrain.lag)
        self._speeds[robot] = allowed[0]
        return kinematics.wheels(allowed)

    def _roll(self, robot: int, wheels: WheelCommand | None, dt: float) -> None:
        """Advance the motor model: the robot's motion when the next command acts."""
        kinematics = self.rig.kinematics[robot]
        goal = kinematics.expected_twist(wheels) if wheels else REST
        share = 1.0 - exp(-dt / kinematics.drivetrain.lag)
        linear, angular = self.motion[robot]
        self.motion[robot] = (linear + (goal[0] - linear) * share, angular + (goal[1] - angular) * share)


def limit_acceleration(desired: float, before: float) -> float:
    """A speed (px/s) limited to MAX_ACCELERATION over a tick; deceleration is not limited."""
    start = before if before * desired > 0.0 else 0.0
    limit = abs(start) + MAX_ACCELERATION * DT
    return max(-limit, min(limit, desired))


def _recorded(robot: Any) -> Sighting:
    return Sighting(robot.x, robot.y, robot.heading, 0.0)
