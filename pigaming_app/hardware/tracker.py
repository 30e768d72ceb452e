"""Where every robot is now: seen a while ago by the camera, predicted from there by the commands sent since.

Every picture corrects the filters of the robots at the time when it was taken; `sense` then replays what was sent
since that time. Nothing here moves a robot or stops one: `safety` judges `lost` and `doubled`.
"""

from collections.abc import Sequence
from math import inf

from pigaming_app.hardware.follower import Follower
from pigaming_app.hardware.ground import Ground
from pigaming_app.hardware.markers import ROBOT_IDS, Markers
from pigaming_app.hardware.signals import Clock, Fix, Frame, Mark
from pigaming_app.sim.drivetrain import NOMINAL, Drivetrain
from pigaming_app.sim.plant import Sighting, Twist
from pigaming_app.sim.robots import RADIUS
from pigaming_app.sim.world import HEIGHT, ROBOTS, WIDTH

OUTSIDE = 3.0 * RADIUS  # px outside the arena up to which a marker can be on a robot
DOUBLED = 0.5  # s for which a duplicate is remembered


class Tracker:
    """The robots 0 to 3. Times are of `clock`; poses in arena px and rad. Raises NoVision where OpenCV is missing."""

    def __init__(self, ground: Ground, clock: Clock, drivetrains: Sequence[Drivetrain] | None = None) -> None:
        self.ground, self.clock = ground, clock
        self._markers = Markers(ROBOT_IDS)
        trains = drivetrains or [NOMINAL] * ROBOTS
        self._followers = [Follower(train, ground.mm) for train in trains]
        self._doubled: dict[int, float] = {}
        self.looked = -inf  # s, when the newest picture was taken that was looked at
        self.refused: dict[int, str] = {}  # by robot: why a marker of the last picture is not on a robot

    def sent(self, time: float, twists: Sequence[Twist | None]) -> None:
        """Remember what was sent to the robots at a time: px/s and rad/s; None: it was told to stop."""
        told = tuple((0.0, 0.0) if twist is None else (twist[0], twist[1]) for twist in twists)
        for follower, twist in zip(self._followers, told, strict=True):
            follower.told(time, twist)

    def see(self, frame: Frame) -> list[Fix]:
        """Correct the robots by a picture; the fixes that were believed."""
        marks = self._markers.find(frame.image)
        return self.correct(marks, frame.captured)

    def correct(self, marks: Sequence[Mark], captured: float) -> list[Fix]:
        """Correct the robots by the markers of one picture; the fixes that were believed."""
        self.looked = -inf  # s, when the newest picture was taken that was looked at
        self.looked = captured
        self.refused = {}
        believed = []
        for robot, follower in enumerate(self._followers):
            fixes = self._credible(robot, marks, captured)
            if len(fixes) > 1:
                self._doubled[robot] = captured
                self.refused[robot] = "doubled"
            elif fixes and follower.correct(fixes[0]):
                believed.append(fixes[0])
        return believed

    def sense(self, now: float) -> list[Sighting]:
        """Where every robot is at a time, and how old its newest sight is then."""
        return [follower.at(now) for follower in self._followers]

    def lost(self, robot: int) -> float:
        """Seconds since a robot was seen; 1e9 if it never was."""
        return self._followers[robot].unseen(self.clock())

    def doubled(self) -> set[int]:
        """The robots whose marker was seen twice in one picture in the last half second."""
        now = self.clock()
        return {robot for robot, time in self._doubled.items() if now - time < DOUBLED}

    def _credible(self, robot: int, marks: Sequence[Mark], captured: float) -> list[Fix]:
        fixes = []
        for mark in marks:
            if mark.number != ROBOT_IDS[robot]:
                continue
            fix = self.ground.fix(mark, captured)
            if isinstance(fix, str):
                self.refused[robot] = fix
            elif not (-OUTSIDE < fix.x < WIDTH + OUTSIDE and -OUTSIDE < fix.y < HEIGHT + OUTSIDE):
                self.refused[robot] = "outside"
            else:
                fixes.append(fix)
        return fixes
