"""The robot loop on the emulated arena without pictures: fixes come from true poses, with noise and late stamps."""

from math import hypot
from typing import Any, cast

import numpy as np

from pigaming_app.hardware.emulator.arena import STARTS
from pigaming_app.hardware.emulator.camera import FrameTiming
from pigaming_app.hardware.emulator.objects import LID_HEIGHT
from pigaming_app.hardware.emulator.renderer import SceneRenderer
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.signals import DetectedMarker
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.hardware.vision.markers import ROBOT_IDS
from pigaming_app.sim.world import HZ, ROBOTS
from tests.hardware.mat import nominal
from tests.hardware.pictures import square

TRUTH = nominal()
NOISE = 0.4  # px of the arena


class Poses:
    """In place of a renderer: a picture is the true poses in the middle of its exposure, and a number."""

    ambient, refresh = 1.0, 1

    def __init__(self, arena):
        self.arena = arena

    def paint(self, scene):
        lids = [thing for thing in scene.things if thing.height >= LID_HEIGHT]
        middles = np.array([lid.poses[len(lid.poses) // 2] for lid in lids])
        ahead = middles[:, :2] + np.column_stack([np.cos(middles[:, 2]), np.sin(middles[:, 2])])
        at, to = (self.arena.optics.canvas(points) - (160.0, 140.0) for points in (middles[:, :2], ahead))
        turned = np.arctan2(*(to - at).T[::-1])
        return np.column_stack([at, turned, np.full(len(at), scene.number)])


class BlindTracker(Tracker):
    """A tracker that is told the markers of such a picture."""

    def process(self, frame):
        random = np.random.default_rng(frame.number)
        marks = []
        for robot, (x, y, heading, _) in enumerate(frame.image):
            corners = square((x, y, heading), TRUTH.marker / TRUTH.mm) + random.normal(0.0, NOISE, (4, 2))
            marks.append(DetectedMarker(ROBOT_IDS[robot], TRUTH.to_camera(corners, TRUTH.lid)))
        return self.correct(marks, frame.captured)


class BlindBed:
    """Four robots that drive eights. `late`: s by which the camera's stamps are late; `dead`: s more a robot needs."""

    def __init__(self, late=0.0, seed=3, dead=(0.0,) * ROBOTS, ground=TRUTH):
        self.late = late
        timing = FrameTiming(30.0, 0.060)
        self.session = EmulatedSession(seed, False, timing=timing, ground=ground, tracker=BlindTracker)
        self.arena = self.session.arena
        self.arena.camera.painter = cast(SceneRenderer, Poses(self.arena))
        self.rig = self.session.open()
        delays(self.arena, dead)
        camera, newest = cast(Any, self.rig.camera), self.rig.camera.newest

        def stamped():
            frame = newest()
            return frame and frame._replace(captured=frame.captured + self.late)

        camera.newest = stamped
        self.ticks = 0

    def drive(self, seconds, speed=260.0):
        """Drive on; returns the errors of the predicted positions, mm, (ticks, robots)."""
        misses = []
        for _ in range(round(seconds * HZ)):
            self.ticks += 1
            wheels = []
            for robot in range(ROBOTS):
                time = self.ticks / HZ + 1.3 * robot
                home, seen = STARTS[robot], self.arena.poses()[robot]
                goal = home[0] + 130.0 * np.sin(1.1 * time), home[1] + 100.0 * np.sin(2.2 * time)
                astray = np.arctan2(goal[1] - seen[1], goal[0] - seen[0]) - seen[2]
                turn = 4.0 * ((astray + np.pi) % (2.0 * np.pi) - np.pi)
                fast = speed * (0.75 + 0.25 * np.sin(1.7 * time))
                wheels.append(self.rig.kinematics[robot].wheels((fast, min(4.0, max(-4.0, turn)))))
            self.session.tick()
            self.rig.send(wheels)
            pairs = zip(self.rig.sense(), self.arena.poses(), strict=True)
            misses.append([1.32 * hypot(seen.x - x, seen.y - y) for seen, (x, y, _) in pairs])
        return np.array(misses)


def delays(arena, dead):
    """Let the motors of these robots act later."""
    for robot, seconds in zip(arena.robots, dead, strict=True):
        steps, roll = round(seconds / 0.002), robot.roll
        queue = [(0.0, 0.0)] * steps

        def late(robot=robot, queue=queue, roll=roll):
            queue.append((robot.left, robot.right))
            robot.left, robot.right = queue.pop(0)
            roll()
            robot.left, robot.right = queue[-1] if queue else (robot.left, robot.right)

        if steps:
            robot.roll = late


def rms(misses):
    return float(np.sqrt(np.mean(np.square(misses))))
