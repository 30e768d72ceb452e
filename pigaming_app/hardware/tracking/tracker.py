"""Where every robot is now: seen a while ago by the camera, predicted from there by the commands sent since.

Every picture corrects the robots' filters at the time when it was taken; `sense` then replays what was sent since.
Nothing here moves a robot or stops one: `safety` judges ages, `doubled` and `looked`.
"""

from collections.abc import Sequence
from math import cos, hypot, inf, pi, sin, sqrt

import numpy as np

from pigaming_app.hardware.calibration.drift import DriftMonitor
from pigaming_app.hardware.calibration.ground_plane import GroundPlane, Points
from pigaming_app.hardware.control.motion_model import WheelCorrection
from pigaming_app.hardware.signals import CameraFrame, Clock, DetectedMarker, Fix
from pigaming_app.hardware.tracking.ekf import COAST, PoseFilter
from pigaming_app.hardware.vision.markers import ROBOT_IDS, MarkerDetector, SearchWindow, mean_edge, same
from pigaming_app.sim.drivetrain import NOMINAL, Drivetrain
from pigaming_app.sim.plant import Sighting, Twist
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.world import HEIGHT, ROBOTS, WIDTH

OUTSIDE = 3.0 * RADIUS  # px outside the arena up to which a marker can be on a robot
GLANCE = 0.1  # s between quick looks everywhere: robots that appear, markers that come twice
SEARCH = 0.05  # s between them while one is missing
THOROUGH = 1.0  # s between thorough looks while one is missing
REMEMBERED = 0.5  # s for which it is known why a marker was refused
MARGIN, ASTRAY = 6.0, 200.0  # how far from its prediction a marker is looked for: px, and px/s since it was seen


class Tracker:
    """The robots 0 to 3. Times are of `clock`; poses in arena px and rad. Raises OpenCVMissing."""

    def __init__(
        self,
        ground: GroundPlane,
        clock: Clock,
        drivetrains: Sequence[Drivetrain] | None = None,
        drift: DriftMonitor | None = None,
    ) -> None:
        self.ground, self.clock = ground, clock
        self.expected = set(range(ROBOTS))  # which robots are worth searching for; others are taken if they are seen
        self.looked = -inf  # s, when the newest picture was taken that was looked at
        self.drift = drift  # watches the same pictures for the corner markers
        self._markers = MarkerDetector(ROBOT_IDS)
        self._followers = [PoseFilter(one, ground.mm) for one in drivetrains or [NOMINAL] * ROBOTS]
        self._refused: dict[tuple[int, str], float] = {}
        self._glanced = self._searched = -inf
        self._dim = False  # how it looked everywhere the last time
        self._edge = self._expected_edge()

    def sent(self, time: float, twists: Sequence[Twist | None]) -> None:
        """Remember what was sent to the robots at a time: px/s and rad/s; None: it was told to stop."""
        for follower, twist in zip(self._followers, twists, strict=True):
            follower.told(time, (0.0, 0.0) if twist is None else twist)

    def see(self, frame: CameraFrame) -> list[Fix]:
        """Correct the robots by a picture; the fixes that were believed."""
        if self.drift is not None:
            self.drift.see(frame)
        return self.correct(self._markers.exact(frame.image, self._find(frame)), frame.captured)

    def correct(self, marks: Sequence[DetectedMarker], captured: float) -> list[Fix]:
        """Correct the robots by the markers of one picture; the fixes that were believed."""
        if captured <= self.looked:
            return []
        self.looked = captured
        believed = []
        credible = self._credible(marks, captured)
        for robot, (follower, fixes) in enumerate(zip(self._followers, credible, strict=True)):
            if len(fixes) > 1:
                self._refused[robot, "doubled"] = captured
            elif fixes and follower.correct(fixes[0]):
                believed.append(fixes[0])
        return believed

    def sense(self, now: float) -> list[Sighting]:
        """Where every robot is at a time, and how old its newest sight is then."""
        return _apart([follower.at(now) for follower in self._followers])

    def predict(self, now: float, ahead: Sequence[float]) -> tuple[list[Sighting], list[Sighting]]:
        """Where every robot is at a time, and where robot i is `ahead[i]` s later."""
        both = [one.along((now, now + more)) for one, more in zip(self._followers, ahead, strict=True)]
        return _apart([at for at, _ in both]), _apart([later for _, later in both])

    def wear(self, robot: int) -> WheelCorrection:
        """What has been learnt of a robot's wheels."""
        return self._followers[robot].wear

    def doubled(self) -> set[int]:
        """The robots whose marker was lately seen twice in one picture."""
        return {robot for robot, reason in self._lately() if reason == "doubled"}

    @property
    def refused(self) -> dict[int, str]:
        """By robot: why a marker with its number was lately not believed to be on it.

        `doubled`: there are two; `size`: it is too near or too far, as in a hand; `tilted`; `outside` of the mat.
        """
        return dict(self._lately())

    def _lately(self) -> list[tuple[int, str]]:
        now = self.clock()
        return [key for key, time in self._refused.items() if now - time < REMEMBERED]

    def _find(self, frame: CameraFrame) -> list[DetectedMarker]:
        """Every robot near where it must be; everywhere from time to time, and more often while one is missing."""
        marks = []
        for robot, spot in self._spots(frame.captured).items():
            mark = self._markers.near(frame.image, spot, ROBOT_IDS[robot])
            if mark is not None:
                marks.append(mark)
        found = {ROBOT_IDS.index(mark.number) for mark in marks}
        missing = not self.expected <= found
        if frame.captured - self._glanced > (SEARCH if missing else GLANCE):
            self._glanced = frame.captured
            marks += self._wide(frame, missing, marks)
        return marks

    def _wide(self, frame: CameraFrame, missing: bool, known: list[DetectedMarker]) -> list[DetectedMarker]:
        """What is in the picture besides what is known."""
        if missing and frame.captured - self._searched > THOROUGH:
            self._searched = frame.captured
            return [mark for mark in self._markers.everywhere(frame.image) if not same(mark, known)]
        self._dim = not self._dim
        return self._markers.glance(frame.image, self._edge, known, self._dim)

    def _spots(self, time: float) -> dict[int, SearchWindow]:
        """Where in a picture taken then the robots' markers must be, and how large."""
        poses = {robot: follower.at(time) for robot, follower in enumerate(self._followers)}
        poses = {robot: pose for robot, pose in poses.items() if pose.age < COAST}
        if not poses:
            return {}
        corners = np.array([_outline(pose, self.ground.marker / self.ground.mm) for pose in poses.values()])
        seen = self.ground.seen_at(corners.reshape(-1, 2), self.ground.lid).reshape(-1, 4, 2)
        spots = {}
        for (robot, pose), square in zip(poses.items(), seen, strict=True):
            (x, y), edge = square.mean(axis=0).tolist(), mean_edge(square)
            away = MARGIN + ASTRAY * min(pose.age, 0.3) * edge * self.ground.mm / self.ground.marker
            spots[robot] = SearchWindow(x, y, 1.1 * edge + away, edge)
        return spots

    def _expected_edge(self) -> float:
        """The edge of a marker in the middle of the arena, camera px."""
        middle = Sighting(WIDTH / 2.0, HEIGHT / 2.0, 0.0, 0.0)
        return mean_edge(self.ground.seen_at(_outline(middle, self.ground.marker / self.ground.mm), self.ground.lid))

    def _credible(self, marks: Sequence[DetectedMarker], captured: float) -> list[list[Fix]]:
        """By robot: where its markers say that it is, but for those that cannot be on a robot."""
        fixes: list[list[Fix]] = [[] for _ in range(ROBOTS)]
        for mark, fix in zip(marks, self.ground.fixes(marks, captured), strict=True):
            robot = ROBOT_IDS.index(mark.number)
            if isinstance(fix, str):
                self._refused[robot, fix] = captured
            elif not (-OUTSIDE < fix.x < WIDTH + OUTSIDE and -OUTSIDE < fix.y < HEIGHT + OUTSIDE):
                self._refused[robot, "outside"] = captured
            else:
                fixes[robot].append(fix)
        return fixes


def _apart(sights: list[Sighting]) -> list[Sighting]:
    """Predictions that overlap, half the way back each: robots push each other, and do not drive through."""
    for i, one in enumerate(sights):
        for j in range(i + 1, len(sights)):
            other = sights[j]
            dx, dy = other.x - one.x, other.y - one.y
            gap = hypot(dx, dy)
            if 1e-6 < gap < 2.0 * RADIUS and max(one.age, other.age) < COAST:
                push = 0.5 * (2.0 * RADIUS - gap) / gap
                one = sights[i] = one._replace(x=one.x - push * dx, y=one.y - push * dy)
                sights[j] = other._replace(x=other.x + push * dx, y=other.y + push * dy)
    return sights


def _outline(pose: Sighting, edge: float) -> Points:
    """The corners of a marker on a robot, arena px, (4, 2), in ArUco's order."""
    reach = edge / sqrt(2.0)
    turns = [pose.heading + k * pi / 2.0 for k in (-0.5, 0.5, 1.5, 2.5)]
    return np.array([(pose.x + reach * cos(turn), pose.y + reach * sin(turn)) for turn in turns])
