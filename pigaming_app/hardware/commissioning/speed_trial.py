"""Test drive: robots drive on the empty mat as players would, at full speed, into edges and towards each other.

Robots that respond late come too far into walls, or seem not to obey. Whoever does is held slower at once, until a
whole round goes well; nobody in a match is then faster than the slowest of its robots.
"""

from collections.abc import Mapping, Sequence
from math import inf, isfinite
from random import Random

from pigaming_app.hardware.control.real_plant import RealPlant, held_to
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.run_writer import Recorder
from pigaming_app.hardware.signals import Fix
from pigaming_app.sim.plant import Twist
from pigaming_app.sim.world import DT, HEIGHT, HZ, ROBOTS, WIDTH, World

ROUND = 60.0  # s of driving
ENTRY_MM = 5.0  # into an edge, at most
FAST, SPIN = 422.0, 3.0  # px/s and rad/s, of the fastest robot in any game
LOWER = 0.75  # share of the speed that a robot keeps after a round that failed
SLOWEST = 60.0  # px/s of a wheel, below which a robot is too late to play
WARM, GENTLE = 8.0, 0.4  # s at the start, and share of speed, in which delays are measured, as before a match
RESTS = 2.0  # s for which all stand after a failure
WAIT = 30.0  # s of a round in which robots may be out of sight, empty, or stand after an alarm
LINEAR, ANGULAR = (-1.0, -0.5, 0.75, 1.0, 1.0, 1.0), (-1.0, -0.3, 0.0, 0.0, 0.3, 1.0)  # shares of FAST and SPIN


class OwnPace(RealPlant):
    """Robots that are not held to the pace of the slowest: each is tried at its own."""

    def paced(self, twists: Sequence[Twist]) -> list[Twist]:
        return [held_to(self.rig.pace([robot]), twist) for robot, twist in enumerate(twists)]


class SpeedTrial(Recorder):
    """Drives these robots, in rounds of `seconds`, by default ROUND.

    Call `tick` every 1/50 s until it returns True; `rig.tops` are then the speeds that hold.
    """

    def __init__(self, rig: Rig, robots: Sequence[int], seconds: float = 0.0) -> None:
        self.rig, self.robots, self._round = rig, robots, seconds or ROUND
        self.rounds = 1
        self.late: set[int] = set()  # robots that are too late at any speed
        world = World()
        world.radius = rig.radius_in_play(robots)
        for robot in robots:
            world.robots[robot].present = 1
            rig.tops[robot] = inf
        self.plant = OwnPace(world, rig, robots)
        self._random, self._held = Random("test drive"), [(0.0, 0.0)] * ROBOTS
        self._until = [0.0] * ROBOTS  # s
        self._begin()
        self._driven = -WARM
        rig.recorder = self

    def tick(self) -> bool:
        """Drive for 1/50 s; True once done, with all robots stopped. False alarms and entries are noted."""
        if self.plant.safety.pauses or self._rest > 0.0:
            self._stand()
        else:
            self.plant.sense()
            self.plant.drive(self._twists(), DT)
            self._driven += DT
        if self.failed and not self._rest:
            self._slow_down()
        if not self.late and self._driven < self._round and self._waited < WAIT:
            return False
        self.rig.recorder = None
        self.rig.send([None] * ROBOTS)
        return True

    @property
    def held_up(self) -> bool:
        """True if the drive has ended because robots were out of sight, or did not answer."""
        return self._waited >= WAIT

    @property
    def failed(self) -> set[int]:
        """Robots that came too far into an edge in this round, or raised an alarm."""
        return {robot for robot in self.robots if self.alarms[robot] or self.entries[robot] > ENTRY_MM}

    @property
    def tops_mm(self) -> Mapping[int, int]:
        """Top speed of a wheel of each robot, mm/s; 0: not limited."""
        return {i: round(top * self.rig.mm) if isfinite(top := self.rig.tops[i]) else 0 for i in self.robots}

    def record_fixes(self, now: float, captured: float, fixes: Sequence[Fix]) -> None:
        """How far robots are in an edge; one that was put down there does not count until it has left."""
        for fix in fixes:
            radius, robot = self.rig.radius(fix.robot), fix.robot
            depth = radius + max(-fix.x, -fix.y, fix.x - WIDTH, fix.y - HEIGHT)
            if depth < 0.0 <= self._driven:
                self._inside.add(robot)
            if robot in self._inside:
                self.entries[robot] = max(self.entries[robot], depth * self.rig.mm)

    def _begin(self) -> None:
        self._driven, self._waited, self._rest, self._inside = 0.0, 0.0, 0.0, set[int]()
        self.entries, self.alarms = [0.0] * ROBOTS, [0] * ROBOTS

    def _stand(self) -> None:
        """Note the robots that seem not to obey, and let all stand."""
        for robot in self.plant.safety.latched:
            self.alarms[robot] += self._driven >= 0.0
            self.plant.clear_fault(robot)
        self.plant.watch()
        self._waited += DT
        if self._rest and (rest := self._rest - DT) <= 0.0:
            self._begin()
        elif self._rest:
            self._rest = rest

    def _twists(self) -> list[Twist]:
        """Random sticks, each held for up to a second."""
        now = self.rig.clock()
        for robot in range(ROBOTS):
            if now >= self._until[robot]:
                self._until[robot] = now + self._random.randrange(3, HZ) * DT
                self._held[robot] = FAST * self._random.choice(LINEAR), SPIN * self._random.choice(ANGULAR)
        share = GENTLE if self._driven < 0.0 else 1.0
        return [(share * linear, share * angular) for linear, angular in self._held]

    def _slow_down(self) -> None:
        """Hold the robots that failed slower, for another round."""
        for robot in self.failed:
            pace, half = self.rig.pace([robot])
            self.rig.tops[robot] = LOWER * min(pace, FAST + half * SPIN)
            if self.rig.tops[robot] < SLOWEST:
                self.late.add(robot)
        self.rounds += 1
        self._rest = RESTS
