"""A synthetic calibration, and a simulated mat with ideal tracker and link, for tests of the code between them.

The emulated arena covers the same with pictures and packets.
"""

from collections import deque
from math import cos, exp, sin

import numpy as np

from pigaming_app.hardware.calibration.ground_plane import GroundPlane, Lens
from pigaming_app.hardware.control.kinematics import IDEAL
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.radio.protocol import LinkQuality
from pigaming_app.hardware.signals import CameraFrame, Fix, Telemetry, WheelCommand
from pigaming_app.sim.drivetrain import Drivetrain, Wheel, twist
from pigaming_app.sim.plant import Sighting

STEP = 0.01  # s
LATE = 0.06  # s
TRUE = Drivetrain(Wheel(740.0, 0.04), Wheel(780.0, 0.03), 63.0, 0.09, 0.03)
EVEN = Drivetrain(Wheel(760.0, 0.03), Wheel(760.0, 0.03), 63.0, 0.09, 0.03)
STARTS = ((200.0, 200.0, 0.8), (1400.0, 200.0, 2.4), (1400.0, 700.0, 3.9), (200.0, 700.0, 5.5))


def nominal(camera: tuple[int, int] = (1920, 1080), width_mm: float = 2112.0, height: float = 2500.0) -> GroundPlane:
    """A camera above the centre, without distortion, with the whole 1920 x 1080 canvas in view."""
    scale = 1920.0 / camera[0]
    plane = (scale, 0.0, -160.0, 0.0, scale, -140.0, 0.0, 0.0, 1.0)
    return GroundPlane("", Lens(camera), plane, width_mm, (800.0, 400.0), height)


class Robot:
    """A robot with its true drivetrain and pose."""

    def __init__(self, pose, train):
        self.x, self.y, self.heading = pose
        self.train = train
        self.command: WheelCommand | None = None
        self.linear = self.angular = 0.0
        self.seen, self.duplicate, self.battery, self.received = 0.0, False, 5.0, 0.0
        self.hidden = self.silent = False
        self.flags = 0  # of its reports

    def roll(self):
        goal = twist(self.train, *self.command) if self.command else (0.0, 0.0)
        share = 1.0 - exp(-STEP / self.train.lag)
        mean = 1.0 - share * self.train.lag / STEP  # mean share of the way to the goal speed in a step
        way = STEP * (self.linear + (goal[0] - self.linear) * mean)
        turn = STEP * (self.angular + (goal[1] - self.angular) * mean)
        self.x += way * cos(self.heading + 0.5 * turn)
        self.y += way * sin(self.heading + 0.5 * turn)
        self.heading += turn
        self.linear += (goal[0] - self.linear) * share
        self.angular += (goal[1] - self.angular) * share


NOMINAL_MM = 1.32  # per px, of an arena of 2112 mm


def rig_of(camera, mat, clock=None, **about) -> Rig:
    """The rig of a camera, and of the tracker and the link that a mat is."""
    return Rig(camera, mat, mat, clock or mat.clock, **about)


class Mat:
    """Camera, tracker and link in one; `rig` combines them."""

    def __init__(self, poses=STARTS, train=TRUE):
        self.now, self.dead_time, self.correction = 0.0, TRUE.dead_time, IDEAL
        self.robots = [Robot(pose, train) for pose in poses]
        self.blind, self.fault, self.closed = False, None, False
        self.last_captured = 0.0
        self.rejections = {}
        self.coming: deque[tuple[float, tuple[WheelCommand | None, ...]]] = deque()  # on the air
        self.radio = [0, 1, 2, 3]  # channel of each robot
        self.past: deque[tuple[float, list[tuple[float, float, float]]]] = deque()  # in the camera
        self.pictures = 0
        self.boards = {}
        self.misfits = {}
        self.rig = rig_of(self, self, mm=NOMINAL_MM)

    def clock(self):
        return self.now

    def pass_time(self, seconds=0.02):
        for _ in range(round(seconds / STEP)):
            while self.coming and self.coming[0][0] <= self.now + 1e-9:
                command = self.coming.popleft()[1]
                for robot, channel in zip(self.robots, self.radio, strict=True):
                    robot.command = command[channel]
            self.now += STEP
            for robot in self.robots:
                robot.roll()
                if not self.blind and not robot.hidden:
                    robot.seen = self.now
                if not robot.silent:
                    robot.received = self.now
            self.last_captured = self.last_captured if self.blind else self.now

            self.past.append((self.now, [(robot.x, robot.y, robot.heading) for robot in self.robots]))

    # camera: 33 pictures/s with a latency of LATE; the content is only a number
    def newest(self):
        if self.blind or self.now < self.pictures * 0.03 + LATE:
            return None
        while len(self.past) > 1 and self.past[0][0] < self.now - LATE - 1e-9:
            self.past.popleft()
        self.pictures += 1
        return CameraFrame(np.full((1, 1), self.pictures % 251, dtype=np.uint8), self.past[0][0], self.pictures)

    def close(self):
        self.closed = True

    # tracker
    def record_commands(self, time, twists):
        pass

    def process(self, frame):
        return [Fix(i, x, y, heading, frame.captured) for i, (x, y, heading) in enumerate(self.past[0][1])]

    def sense(self, now):
        ahead = now - self.now
        return [
            Sighting(
                robot.x + ahead * robot.linear * cos(robot.heading),
                robot.y + ahead * robot.linear * sin(robot.heading),
                robot.heading + ahead * robot.angular,
                now - robot.seen,
            )
            for robot in self.robots
        ]

    def predict(self, now, ahead):
        return self.sense(now), [self.sense(now + more)[i] for i, more in enumerate(ahead)]

    delay = wrong_size = None
    keystone = 0.0
    wait = 0.015

    def quality(self, robot):
        return LinkQuality(1.0, None, None)

    def duplicates(self):
        return {i for i, robot in enumerate(self.robots) if robot.duplicate}

    def wheel_correction(self, robot):
        return self.correction

    # link
    @property
    def telemetry(self):
        return {i: Telemetry(i, robot.battery, robot.flags, robot.received) for i, robot in enumerate(self.robots)}

    def misfit(self, robot):
        return self.misfits.get(robot)

    def send(self, wheels):
        self.coming.append((self.now + self.dead_time, tuple(wheels)))

    def pump(self):
        pass

    def start(self):
        return self
