"""One pose filter for each robot, corrected by whatever sees the robots."""

from collections.abc import Mapping, Sequence
from math import hypot, inf

from pigaming_app.hardware.signals import CameraFrame, Fix
from pigaming_app.hardware.tracking.camera_delay import CameraDelay
from pigaming_app.hardware.tracking.ekf import COAST, PoseFilter
from pigaming_app.hardware.tracking.motion_model import WheelCorrection
from pigaming_app.sim.drivetrain import NOMINAL, Drivetrain
from pigaming_app.sim.plant import Sighting, Twist
from pigaming_app.sim.world import RADIUS, ROBOTS


class PoseFilters:
    """Filters of the robots 0 to 3: what a rig knows of their poses. `mm`: mm of the mat per arena px."""

    delay: CameraDelay | None = None  # of the camera; None: its stamps are right

    def __init__(self, drivetrains: Sequence[Drivetrain] | None, mm: float) -> None:
        self.expected = set(range(ROBOTS))  # robots to search for; others are tracked when seen
        self.radii = [RADIUS] * ROBOTS  # px, of their bodies
        self.last_captured = -inf  # s, capture time of the newest processed frame
        self.filters = [PoseFilter(drivetrain, mm) for drivetrain in drivetrains or [NOMINAL] * ROBOTS]

    @property
    def rejections(self) -> Mapping[int, str]:
        """Reason for the latest rejection of each robot's marker."""
        return {}

    @property
    def wrong_size(self) -> float | None:
        """Size of the robots' markers, mm, if it is so far from the true one that the arena's width is in doubt."""
        return None

    @property
    def keystone(self) -> float:
        """By how much markers look larger at one side of the arena than at the other, as a share; 0: unknown."""
        return 0.0

    def duplicates(self) -> set[int]:
        """Robots that were lately seen twice in one frame."""
        return set()

    def process(self, frame: CameraFrame) -> list[Fix]:
        """Correct the filters by a frame; returns the accepted fixes."""
        raise NotImplementedError

    def record_commands(self, time: float, twists: Sequence[Twist | None]) -> None:
        """Record the twists sent to the robots at a time, px/s and rad/s; None: stop."""
        for pose_filter, twist in zip(self.filters, twists, strict=True):
            pose_filter.record_command(time, (0.0, 0.0) if twist is None else twist)

    def sense(self, now: float) -> list[Sighting]:
        """Pose of every robot at a time, with the age of its newest fix."""
        return self._apart([pose_filter.at(now) for pose_filter in self.filters])

    def predict(self, now: float, ahead: Sequence[float]) -> tuple[list[Sighting], list[Sighting]]:
        """Pose of every robot at a time, and that of robot i `ahead[i]` s later."""
        both = [robot.along((now, now + more)) for robot, more in zip(self.filters, ahead, strict=True)]
        return self._apart([at for at, _ in both]), self._apart([later for _, later in both])

    def wheel_correction(self, robot: int) -> WheelCorrection:
        """Estimated wheel correction of a robot."""
        return self.filters[robot].correction

    def _apart(self, sights: list[Sighting]) -> list[Sighting]:
        """Separate overlapping predictions, each by half the overlap: robots push each other apart."""
        for i, first in enumerate(sights):
            for j in range(i + 1, len(sights)):
                other, wide = sights[j], self.radii[i] + self.radii[j]
                dx, dy = other.x - first.x, other.y - first.y
                gap = hypot(dx, dy)
                if 1e-6 < gap < wide and max(first.age, other.age) < COAST:
                    push = 0.5 * (wide - gap) / gap
                    first = sights[i] = first._replace(x=first.x - push * dx, y=first.y - push * dy)
                    sights[j] = other._replace(x=other.x + push * dx, y=other.y + push * dy)
        return sights
