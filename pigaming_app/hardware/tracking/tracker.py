"""Present poses of all robots, predicted from delayed camera fixes and the commands sent since.

Every frame corrects the robots' filters at its capture time; `sense` then replays the commands sent since. The tracker
never moves or stops a robot: `safety` judges ages, `duplicates` and `last_captured`.
"""

from collections import deque
from collections.abc import Sequence
from math import cos, inf, pi, sin, sqrt

import numpy as np

from pigaming_app.hardware.calibration.drift import DriftMonitor
from pigaming_app.hardware.calibration.ground_plane import MAX_SIZE_ERROR, GroundPlane, Points, keystone
from pigaming_app.hardware.signals import CameraFrame, Clock, DetectedMarker, Fix
from pigaming_app.hardware.tracking.camera_delay import CameraDelay
from pigaming_app.hardware.tracking.ekf import COAST
from pigaming_app.hardware.tracking.pose_filters import PoseFilters
from pigaming_app.hardware.vision.markers import (
    ROBOT_IDS,
    WEARERS,
    MarkerDetector,
    SearchWindow,
    is_known,
    mean_edge,
)
from pigaming_app.sim.drivetrain import Drivetrain
from pigaming_app.sim.plant import Sighting, Twist
from pigaming_app.sim.world import HEIGHT, RADIUS, ROBOTS, WIDTH

OUTSIDE = 3.0 * RADIUS  # px outside the arena within which a fix is accepted
GLANCE = 0.1  # s between quick searches of the whole image, for new robots and duplicate markers
SEARCH = 0.05  # the same while a robot is missing, s
THOROUGH = 1.0  # s between thorough searches while a robot is missing
SIZES = 60  # of markers, for their median
CELL, NEW = 200.0, 0.1  # arena px, edge of a cell in which sizes are averaged; weight of a new one
REMEMBERED = 0.5  # s for which a rejection is reported
MARGIN, ASTRAY = 6.0, 200.0  # search radius around a prediction: px, plus px/s of its age


class Tracker(PoseFilters):
    """Tracker of the robots 0 to 3. Times are those of `clock`; poses in arena px and rad. Raises OpenCVMissing."""

    delay: CameraDelay
    ahead = 0.0  # px by which the middle of a marker lies ahead of that between the wheels

    def __init__(
        self,
        ground: GroundPlane,
        clock: Clock,
        drivetrains: Sequence[Drivetrain] | None = None,
        drift: DriftMonitor | None = None,
    ) -> None:
        super().__init__(drivetrains, ground.mm)
        self.ground, self.clock = ground, clock
        self.delay = CameraDelay(self.filters)
        self.drift = drift  # gets the same frames, for the corner markers
        self._markers = MarkerDetector(WEARERS)
        self._rejections: dict[tuple[int, str], float] = {}  # s, by robot and reason
        self._sizes: deque[float] = deque(maxlen=SIZES)  # mm
        self._sizes_at: dict[tuple[int, int], float] = {}  # mm, mean, by CELL of the arena
        self._glanced = self._searched = self._sized = -inf
        self._dim = False  # mode of the last quick search
        self._edge = self._expected_edge()

    def process(self, frame: CameraFrame) -> list[Fix]:
        if self.drift is not None:
            self.drift.process(frame)
        return self.correct(self._markers.refine(frame.image, self._find(frame)), frame.captured)

    def correct(self, marks: Sequence[DetectedMarker], captured: float) -> list[Fix]:
        """Correct the filters with the markers of a frame with this stamp; returns the accepted fixes."""
        captured -= self.delay.seconds
        if captured <= self.last_captured:
            return []
        self.last_captured = captured
        accepted = []
        credible = self._credible(marks, captured)
        for robot, (pose_filter, fixes) in enumerate(zip(self.filters, credible, strict=True)):
            if len(fixes) > 1:
                self._rejections[robot, "duplicate"] = captured
            elif fixes and pose_filter.correct(fixes[0]):
                accepted.append(fixes[0])
                self.delay.record_fix(fixes[0])
        return accepted

    @property
    def wrong_size(self) -> float | None:
        size = float(np.median(self._sizes)) if len(self._sizes) == SIZES else self.ground.marker
        return size if abs(size / self.ground.marker - 1.0) > MAX_SIZE_ERROR else None

    @property
    def keystone(self) -> float:
        places = (np.array([*self._sizes_at]).reshape(-1, 2) + 0.5) * CELL
        if not len(places) or (np.ptp(places, axis=0) < (WIDTH / 2.0, HEIGHT / 2.0)).any():
            return 0.0
        return keystone(places, [*self._sizes_at.values()])

    def duplicates(self) -> set[int]:
        """Robots whose marker was seen twice in one frame within the last REMEMBERED s."""
        return {robot for robot, reason in self._lately() if reason == "duplicate"}

    @property
    def rejections(self) -> dict[int, str]:
        """Reason for the latest rejection of each robot's marker.

        `duplicate`: seen twice; `size`: too near or too far, as in a hand; `tilted`; `outside` of the mat.
        """
        return dict(self._lately())

    def record_commands(self, time: float, twists: Sequence[Twist | None]) -> None:
        super().record_commands(time, twists)
        self.delay.record_commands(time, twists)

    def _lately(self) -> list[tuple[int, str]]:
        now = self.clock()
        return [key for key, time in self._rejections.items() if now - time < REMEMBERED]

    def _find(self, frame: CameraFrame) -> list[DetectedMarker]:
        """Search near predictions, and the whole image periodically, more often while a robot is missing."""
        marks = []
        for robot, spot in self._spots(frame.captured - self.delay.seconds).items():
            mark = self._markers.detect_in(frame.image, spot, ROBOT_IDS[robot])
            if mark is not None:
                marks.append(mark)
        seen = {WEARERS[mark.number] for mark in marks}
        missing = not self.expected <= seen
        if frame.captured - self._glanced > (SEARCH if missing else GLANCE):
            self._glanced = frame.captured
            marks += self._wide(frame, missing, marks)
        return marks

    def _wide(self, frame: CameraFrame, missing: bool, known: list[DetectedMarker]) -> list[DetectedMarker]:
        """Search the whole image for markers that are not in `known`."""
        if missing and frame.captured - self._searched > THOROUGH:
            self._searched = frame.captured
            return [mark for mark in self._markers.detect(frame.image) if not is_known(mark, known)]
        self._dim = not self._dim
        return self._markers.detect_quickly(frame.image, self._edge, known, self._dim)

    def _spots(self, time: float) -> dict[int, SearchWindow]:
        """Search windows of the robots' markers in a frame captured at `time`."""
        poses = {robot: pose_filter.at(time) for robot, pose_filter in enumerate(self.filters)}
        poses = {robot: pose for robot, pose in poses.items() if pose.age < COAST}
        if not poses:
            return {}
        corners = np.array([_outline(pose, self.ground.marker / self.ground.mm, self.ahead) for pose in poses.values()])
        seen = self.ground.to_camera(corners.reshape(-1, 2), self.ground.lid).reshape(-1, 4, 2)
        spots = {}
        for (robot, pose), square in zip(poses.items(), seen, strict=True):
            (x, y), edge = square.mean(axis=0).tolist(), mean_edge(square)
            away = MARGIN + ASTRAY * min(pose.age, 0.3) * edge * self.ground.mm / self.ground.marker
            spots[robot] = SearchWindow(x, y, 1.1 * edge + away, edge)
        return spots

    def _expected_edge(self) -> float:
        """Edge of a marker in the middle of the arena, camera px."""
        middle = Sighting(WIDTH / 2.0, HEIGHT / 2.0, 0.0, 0.0)
        return mean_edge(self.ground.to_camera(_outline(middle, self.ground.marker / self.ground.mm), self.ground.lid))

    def _credible(self, marks: Sequence[DetectedMarker], captured: float) -> list[list[Fix]]:
        """Plausible fixes by robot; rejections are recorded with their reason."""
        fixes: list[list[Fix]] = [[] for _ in range(ROBOTS)]
        if due := captured - self._sized > GLANCE:
            self._sized = captured
        for mark, fix in zip(marks, self.ground.fixes(marks, captured), strict=True):
            robot = WEARERS[mark.number]
            if isinstance(fix, str):
                self._rejections[robot, fix] = captured
                continue
            fix = self._between_wheels(fix)
            if not (-OUTSIDE < fix.x < WIDTH + OUTSIDE and -OUTSIDE < fix.y < HEIGHT + OUTSIDE):
                self._rejections[robot, "outside"] = captured
            else:
                fixes[robot].append(fix)
                if due:
                    self._note_size(fix, self.ground.edge_mm(mark))
        return fixes

    def _between_wheels(self, fix: Fix) -> Fix:
        """The pose of a robot by that of its marker."""
        return fix._replace(x=fix.x - self.ahead * cos(fix.heading), y=fix.y - self.ahead * sin(fix.heading))

    def _note_size(self, fix: Fix, mm: float) -> None:
        """Note the size of a marker at its place."""
        self._sizes.append(mm)
        cell = int(fix.x // CELL), int(fix.y // CELL)
        before = self._sizes_at.get(cell, mm)
        self._sizes_at[cell] = before + NEW * (mm - before)


def _outline(pose: Sighting, edge: float, ahead: float = 0.0) -> Points:
    """Corners of a marker on a robot, arena px, (4, 2), in ArUco's order. `ahead`: of the middle between the wheels."""
    reach = edge / sqrt(2.0)
    turns = [pose.heading + k * pi / 2.0 for k in (-0.5, 0.5, 1.5, 2.5)]
    x, y = pose.x + ahead * cos(pose.heading), pose.y + ahead * sin(pose.heading)
    return np.array([(x + reach * cos(turn), y + reach * sin(turn)) for turn in turns])
