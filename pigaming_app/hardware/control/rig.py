"""Rig: camera, tracker and link of one arena on one clock.

`pump` processes the newest picture and runs the link. In the arena a thread does that (`start`); in simulated time the
owner of the clock calls it. All commands go through `send`, which also informs the tracker.
"""

import logging
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from math import inf
from typing import NamedTuple

import numpy as np

from pigaming_app.hardware.control.kinematics import Kinematics
from pigaming_app.hardware.control.motion_check import RobotMotionCheck
from pigaming_app.hardware.control.safety import Health
from pigaming_app.hardware.radio.link import CommandLink
from pigaming_app.hardware.radio.packets import DEADMAN, EMPTY, PARKED
from pigaming_app.hardware.robot_kinds import DEFAULT, RobotKind, robot_kind
from pigaming_app.hardware.run_writer import Recorder
from pigaming_app.hardware.signals import CameraFrame, CameraSource, Clock, Image, Telemetry, WheelCommand
from pigaming_app.hardware.tracking.motion_delay import DriveTrace, network_delay
from pigaming_app.hardware.tracking.pose_filters import PoseFilters
from pigaming_app.sim.drivetrain import MM, NOMINAL, Drivetrain
from pigaming_app.sim.plant import Sighting
from pigaming_app.sim.world import DT, RADIUS, ROBOTS

# A 3pi that was not measured: a typical deadband, and dead time (s) of tick, serial line and air.
UNMEASURED = replace(
    NOMINAL, left=replace(NOMINAL.left, deadband=0.03), right=replace(NOMINAL.right, deadband=0.03), dead_time=0.03
)
SURE = 0.9  # share of its nominal speed that every robot of a kind reaches
SPARSE = 24  # px between the samples of the quick comparison of two pictures
ROUNDING = 1.0  # px of a body's radius that the virtual walls' own margin covers
RETRY = 0.5  # s until the next try after an error
PERIOD = 0.005  # s between two polls of the camera
MUTE = 0.35  # s without a report after which commands may be lost, too
NOTABLE = 0.01  # s, a measured delay up to which none is expected
GREETING = 0.5  # s after which every robot in range has received a command and reported since

log = logging.getLogger("pigaming")


def unmeasured(kind: RobotKind, mm: float, dead_time: float) -> Drivetrain:
    """The drivetrain of a robot not yet identified. `mm`: of the mat per arena px; `dead_time`: its driver's, s."""
    speed = kind.wheel_mm / mm
    left, right = replace(UNMEASURED.left, speed=speed), replace(UNMEASURED.right, speed=speed)
    return Drivetrain(left, right, kind.base_mm / mm, UNMEASURED.lag, dead_time)


def in_play(widest: float) -> float:
    """The radius of all robots of a match in which the widest has this one, px."""
    return widest if widest > RADIUS + ROUNDING else RADIUS


class RobotSnapshot(NamedTuple):
    """Predicted poses of all robots now, and at the time when a command sent now acts."""

    time: float  # s
    last_captured: float  # s, exposure of the newest picture behind the prediction
    now: list[Sighting]
    later: list[Sighting]


class Rig:
    """Robot i wears marker i; `channels[i]` is the index of its radio in the packets of the link (see pairing).

    `mm`: mm of the mat per arena px. `kinds[i]` is the key of the kind of the robot on radio i; empty: as its board
    announces, else the `usual` one.
    """

    def __init__(
        self,
        camera: CameraSource,
        tracker: PoseFilters,
        link: CommandLink,
        clock: Clock,
        drivetrains: Sequence[Drivetrain] = (UNMEASURED,) * ROBOTS,
        drift: Callable[[], float] = lambda: 0.0,
        mm: float = MM,
        kinds: Sequence[str] = ("",) * ROBOTS,
        usual: RobotKind = DEFAULT,
    ) -> None:
        self.mm, self._kinds, self._usual = mm, kinds, usual
        self.tops = [inf] * ROBOTS  # px/s, top speed of a wheel of each robot, as found by a test drive
        self.camera, self.tracker, self.link, self.clock = camera, tracker, link, clock
        self.kinematics = [Kinematics(drivetrain) for drivetrain in drivetrains]
        self.motion_checks = [RobotMotionCheck(drivetrain) for drivetrain in drivetrains]
        self._channels: Sequence[int] = tuple(range(ROBOTS))
        self.drift = drift  # drift of the corner markers, mm
        self.remote = False  # True: poses and robots are those of a network
        self.recorder: Recorder | None = None
        self.viewers: list[Callable[[CameraFrame], None]] = []  # also get every new picture, in the rig's thread
        self._begun = clock()
        self._unreached: set[int] = set()
        self._deaf_since: dict[int, float] = {}  # s, by robot
        self._image: Image | None = None  # the newest
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._closing = threading.Event()

    @property
    def image(self) -> Image | None:
        """The newest picture, grey, (height, width), as long as there is one."""
        return self._image

    @property
    def channels(self) -> Sequence[int]:
        """Index of each robot's radio in the packets of the link."""
        return self._channels

    @channels.setter
    def channels(self, channels: Sequence[int]) -> None:
        self._channels = channels
        self.forget()

    def pump(self) -> None:
        """Process a new picture, if any, and run the link. No effect while a thread does."""
        if self._thread is None:
            self._look()
            self.link.pump()

    def snapshot(self) -> RobotSnapshot:
        """One prediction of all robots for one tick, shared by safety, clipping and steering."""
        with self._lock:
            now = self.clock()
            ahead = [kinematics.drivetrain.dead_time + _late(kinematics) for kinematics in self.kinematics]
            self.tracker.radii = [self.radius(robot) for robot in range(ROBOTS)]
            return RobotSnapshot(now, self.tracker.last_captured, *self.tracker.predict(now, ahead))

    def sense(self, ahead: float = 0.0) -> list[Sighting]:
        """Poses of the robots, predicted `ahead` s with the commands in force."""
        with self._lock:
            return self.tracker.sense(self.clock() + ahead)

    def send(self, wheels: Sequence[WheelCommand | None]) -> None:
        """Send the commands of all robots; None: motors off."""
        sent: list[WheelCommand | None] = [None] * ROBOTS
        for robot, command in enumerate(wheels):
            sent[self.channels[robot]] = command
        twists = [command and self.kinematics[i].nominal_twist(command) for i, command in enumerate(wheels)]
        now = self.clock()
        with self._lock:
            self.tracker.record_commands(now, twists)
            for check, twist in zip(self.motion_checks, twists, strict=True):
                check.record_command(now, twist)
            for check in self.motion_checks:
                check.compare_commands(self.motion_checks)
            if self.recorder:
                self.recorder.record_commands(now, wheels)
                self.recorder.record_estimates(now, self.tracker.sense(now))
        self.link.send(sent)
        self.pump()

    def send_to_channel(self, channel: int, wheels: WheelCommand) -> None:
        """Command the robot on one radio channel, regardless of its marker; the others are off."""
        sent: list[WheelCommand | None] = [None] * ROBOTS
        sent[channel] = wheels
        self.forget()
        self.link.send(sent)
        self.pump()

    def forget(self, robot: int | None = None) -> None:
        """Reset the motion check of a robot, or of all."""
        with self._lock:
            for check in self.motion_checks if robot is None else [self.motion_checks[robot]]:
                check.forget()

    def kind(self, robot: int) -> RobotKind:
        """The kind of a robot."""
        channel = self.channels[robot]
        return robot_kind(self._kinds[channel], self.link.boards.get(channel), self._usual)

    def radius(self, robot: int) -> float:
        """Radius of the body of a robot, px."""
        return self.kind(robot).radius_mm / self.mm

    def radius_in_play(self, robots: Iterable[int]) -> float:
        """The radius of robots in a match with these, px: that of the widest, at least the usual."""
        return in_play(max((self.radius(robot) for robot in robots), default=0.0))

    def margin(self, robot: int, usual: float) -> float:
        """Length by which the body of a robot is wider than the `usual` radius of a match, px; 0 if it is not."""
        return max(0.0, self.radius(robot) - usual - ROUNDING)

    def telemetry(self, robot: int) -> Telemetry | None:
        """The latest report of a robot, or None."""
        return self.link.telemetry.get(self.channels[robot])

    def begin_camera_delay(self, seconds: float) -> None:
        """Begin with a delay of the camera that was kept, s."""
        with self._lock:
            if self.tracker.delay is not None:
                self.tracker.delay.begin(seconds)

    def measure_camera_delay(self, delays: Mapping[int, float]) -> None:
        """Set the camera's delay by the delays of these robots from commands to seen motion, s, less the network's."""
        with self._lock:
            if self.tracker.delay is not None:
                self.tracker.delay.measured(delays, self.clock())

    @property
    def camera_delay(self) -> float:
        """Time by which the camera's stamps are later than the exposure, s."""
        return self.tracker.delay.seconds if self.tracker.delay is not None else 0.0

    def network_delay(self, robot: int, channel: int | None = None) -> float:
        """Time by which commands reach a robot later than its dead time accounts for, s. `channel`: not its own."""
        echo = self.link.quality(self.channels[robot] if channel is None else channel).echo
        accounted = self.kinematics[robot].drivetrain.dead_time - UNMEASURED.dead_time
        return network_delay(echo, self.link.wait, max(0.0, accounted))

    def pace(self, robots: Iterable[int]) -> tuple[float, float]:
        """Speed of a wheel that each of these robots reaches, px/s, and the widest half base, px."""
        robots = [*robots]
        trains = [self.kinematics[robot].drivetrain for robot in robots]
        tops = [SURE * min(train.left.speed, train.right.speed) for train in trains]
        tops += [self.tops[robot] for robot in robots]
        return min(tops, default=inf), max((0.5 * train.base for train in trains), default=0.0)

    def health(self, outside: Mapping[int, float], seen: RobotSnapshot) -> dict[int, Health]:
        """Health of the robots in `outside` (s outside the arena, by robot).

        A verdict lasts one tick, so ages are extrapolated by one tick.
        """
        now, gone, drift = self.clock(), self.link.fault is not None, self.drift()
        reached = {robot for robot in outside if self._reached(robot, now)}
        with self._lock:
            last_captured, duplicates, rejections = (
                self.tracker.last_captured,
                self.tracker.duplicates(),
                self.tracker.rejections,
            )
            contradictions = [check.contradiction for check in self.motion_checks]
        health = {}
        for robot, seconds in outside.items():
            report, age, kind = self.telemetry(robot), seen.now[robot].age, self.kind(robot)
            misfit = self.link.misfit(self.channels[robot])
            health[robot] = Health(
                picture_age=now - max(last_captured, self._begun) + DT,
                unseen=age + DT if seen.last_captured > seen.time - age + 1e-6 else 0.0,
                rejection=rejections.get(robot, ""),
                duplicate=robot in duplicates,
                outside=seconds,
                silence=self._silence(report, now),
                misfit=misfit.reason if misfit else "",
                battery=(report.battery if report else 0.0) or Health().battery,  # 0: it is not measured
                battery_low=kind.warn_mv / 1000,
                battery_empty=kind.stop_mv / 1000,
                undervoltage=report is not None and bool(report.flags & EMPTY),
                parked=report is not None and bool(report.flags & PARKED),
                deadman_seconds=self._deaf(robot, report),
                astray=contradictions[robot].astray,
                stuck=contradictions[robot].stuck if robot in reached else 0.0,
                leaving=contradictions[robot].leaving,
                unlinked=gone,
                drift=drift,
            )
        return health

    def _silence(self, report: Telemetry | None, now: float) -> float:
        """Seconds since a robot's last report, or since the start."""
        return now - (report.received if report else self._begun)

    def _reached(self, robot: int, now: float) -> bool:
        """True if commands reach a robot. When they do so again, those lost explain nothing: its check starts anew."""
        report = self.telemetry(robot)
        reached = report is not None and self._silence(report, now) < MUTE and not report.flags & DEADMAN
        if reached and robot in self._unreached:
            self.forget(robot)
        (self._unreached.discard if reached else self._unreached.add)(robot)
        return reached

    def _deaf(self, robot: int, report: Telemetry | None) -> float:
        """Seconds from the first to the latest of consecutive reports of a tripped deadman.

        A deadman that tripped before this rig was in contact is not counted.
        """
        if report is None or not report.flags & DEADMAN or report.received < self._begun + GREETING:
            self._deaf_since.pop(robot, None)
            return 0.0
        return max(1e-3, report.received - self._deaf_since.setdefault(robot, report.received))

    def start(self) -> "Rig":
        """Process pictures and run the link in threads until `close`. Requires a real-time clock."""
        self.link.start()
        self._thread = threading.Thread(target=self._run, name="rig", daemon=True)
        self._thread.start()
        return self

    def close(self) -> None:
        """Stop the robots and release camera and radio. Idempotent."""
        self.link.close()
        self._closing.set()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join(timeout=1.0)
        self.camera.close()

    def _run(self) -> None:
        pause = PERIOD
        while not self._closing.wait(pause):
            try:
                self._look()
                pause = PERIOD
            except Exception:  # the age of the picture stops the robots; the next one may be usable
                log.exception("a picture could not be used")
                pause = RETRY

    def _look(self) -> None:
        frame = self.camera.newest()
        if frame is None:
            return
        before, self._image = self._image, frame.image
        if before is not None and _same(before, frame.image):
            return  # a driver that repeats a picture: real ones differ by noise
        with self._lock:
            fixes = self.tracker.process(frame)
            for fix in fixes:
                self.motion_checks[fix.robot].record_fix(fix)
            for robot, (kinematics, check) in enumerate(zip(self.kinematics, self.motion_checks, strict=True)):
                kinematics.correction = self.tracker.wheel_correction(robot)
                check.radius = self.radius(robot)
                check.expect_lateness(_late(kinematics))
            if self.recorder:
                self.recorder.record_fixes(self.clock(), frame.captured, fixes)
            motion = self.tracker.delay.due(self.clock()) if self.tracker.delay is not None else None
        for view in tuple(self.viewers):
            view(frame)
        if motion is None:
            return
        if self._thread is None:
            self._learn_delay(motion)
        else:  # on a busy computer it takes so long that the next picture would be late
            threading.Thread(target=self._learn_delay, args=(motion,), name="camera delay", daemon=True).start()

    def _learn_delay(self, motion: DriveTrace) -> None:
        """Correct the camera's delay by the motion of a robot."""
        delay = motion.delay()
        with self._lock:
            if delay is not None and self.tracker.delay is not None:
                self.tracker.delay.learn(motion.robot, delay, self.network_delay(motion.robot), self.clock())


def _late(kinematics: Kinematics) -> float:
    """Delay that was measured on top of a robot's dead time, s, if it is notable: as in a slow network."""
    return kinematics.correction.late if kinematics.correction.late > NOTABLE else 0.0


def _same(one: Image, other: Image) -> bool:
    """True if two pictures are equal; a sparse comparison settles most cases. Empty ones are never equal."""
    alike = one.size > 0 and np.array_equal(one[::SPARSE, ::SPARSE], other[::SPARSE, ::SPARSE])
    return alike and np.array_equal(one, other)
