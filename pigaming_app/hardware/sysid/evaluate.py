"""How true the simulator is to the real robots: horizon errors before and after they were measured, and replays.

A model is asked where a robot will be in one, two and five seconds, knowing only what it will be told and where it was
seen in the half second before. What is asked lies in the part of the run that was not used to identify the robot.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from pigaming_app.hardware.messages import OperatorError, OperatorMessage
from pigaming_app.hardware.recordings import Floats, Recording, RobotRecording
from pigaming_app.hardware.sysid.identify import identify, placed, shifted, track
from pigaming_app.sim.drivetrain import NOMINAL, Drivetrain, twist
from pigaming_app.sim.plant import SimPlant
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.world import DT, HEIGHT, ROBOTS, WIDTH, World

HORIZONS = (1.0, 2.0, 5.0)  # s
BEFORE = 0.5  # s in which the robot is watched before a prediction
EVERY = 0.5  # s between predictions
HELD_OUT = 0.35  # share of a run, its end, that is not used to identify
FEWEST = 6  # fixes in the half second before
SHORTEST = 20.0  # s
WAY, TURN = 1500.0, 3.0  # px and rad that a robot must have driven and turned
ODD = 2.0  # times a number may differ from the nominal one


class RecordingTooShort(OperatorError):
    """A run from which no robot can be identified."""


class PredictionErrors(NamedTuple):
    """Root mean squares of a model's predictions at each of HORIZONS."""

    mm: tuple[float, ...]
    degrees: tuple[float, ...]


class Identification(NamedTuple):
    """What came out for one robot."""

    robot: int
    drivetrain: Drivetrain
    before: PredictionErrors  # by the nominal drivetrain
    after: PredictionErrors


class Prediction(NamedTuple):
    """One look ahead: where the robot was seen (m, 3), and where the model has it at the same times."""

    seen_at: Floats
    seen: Floats
    predicted: Floats


def measure(run: Recording, nominal: Drivetrain = NOMINAL) -> list[Identification]:
    """Identify every robot of a run that drove about, and say how good the model was and is. Raises RecordingTooShort.

    Robots that hardly moved, or whose numbers make no sense, are left out.
    """
    verdicts = []
    for robot, course in run.courses.items():
        begin, end = course.seen_at[0], course.seen_at[-1]
        if end - begin < SHORTEST:
            watched = {"seconds": f"{end - begin:.0f}", "needed": f"{SHORTEST:.0f}"}
            raise RecordingTooShort(OperatorMessage("run_short", robot=robot + 1, **watched))
        cut = end - HELD_OUT * (end - begin)
        found = identify(course.between(begin, cut), nominal) if drove(course) else None
        if found is None or not sensible(found, nominal):
            continue
        rest = course.between(cut, end + 1.0)
        verdicts.append(Identification(robot, found, errors(rest, nominal, run.mm), errors(rest, found, run.mm)))
    if not verdicts:
        raise RecordingTooShort(OperatorMessage("run_still"))
    return verdicts


def drove(course: RobotRecording) -> bool:
    """Whether a robot went and turned so much that its wheels can be known from it."""
    way = np.hypot(*np.diff(course.poses[::10, :2], axis=0).T).sum()
    return bool(way > WAY and np.ptp(course.poses[:, 2]) > TURN)


def sensible(found: Drivetrain, nominal: Drivetrain) -> bool:
    """Whether a robot can be like that."""
    ratios = (found.left.speed / nominal.left.speed, found.right.speed / nominal.right.speed, found.base / nominal.base)
    bands = max(found.left.deadband, found.right.deadband)
    return all(1.0 / ODD < ratio < ODD for ratio in ratios) and bands < 0.3


def errors(course: RobotRecording, drivetrain: Drivetrain, mm: float) -> PredictionErrors:
    """How far off predictions over this course are."""
    lengths, angles = [], []
    for horizon in HORIZONS:
        misses = [
            (one.seen - one.predicted)[-1] for one in predictions(course, drivetrain, horizon) if len(one.seen_at)
        ]
        miss = np.array(misses) if misses else np.full((1, 3), np.nan)
        lengths.append(float(np.sqrt(np.mean(miss[:, 0] ** 2 + miss[:, 1] ** 2)) * mm))
        angles.append(float(np.degrees(np.sqrt(np.mean(miss[:, 2] ** 2)))))
    return PredictionErrors(tuple(lengths), tuple(angles))


def predictions(course: RobotRecording, drivetrain: Drivetrain, horizon: float) -> list[Prediction]:
    """Looks `horizon` s ahead, one every EVERY s; each holds the fixes from its beginning to its end."""
    times = course.seen_at
    there = track(course, drivetrain, times[0], times[-1]).at(times)
    found = []
    for now in np.arange(times[0] + BEFORE, times[-1] - horizon + 1e-9, EVERY):
        first, middle, last = np.searchsorted(times, (now - BEFORE, now, now + horizon + 1e-6))
        if middle - first < FEWEST or last <= middle or times[last - 1] < now + horizon - 0.1:
            continue
        one = np.array([0])
        _, move = placed(there[first:middle], course.poses[first:middle], one)
        predicted = shifted(there[first:last], one, move)[middle - first :]
        found.append(Prediction(times[middle:last], course.poses[middle:last], predicted))
    return found


def replay(run: Recording, drivetrains: Sequence[Drivetrain]) -> dict[int, Prediction]:
    """Play a run again in the simulator: robots with these drivetrains are told what the real ones were told.

    They begin where the real ones were first seen and never hear of them again; what comes back is where they were
    when the real ones were seen.
    """
    world: Any = World()
    for robot, course in run.courses.items():
        record = world.robots[robot]
        x, y, heading = course.poses[0]
        record.present, record.x, record.y, record.heading = 1, float(x), float(y), float(heading % (2.0 * np.pi))
        record.x, record.y = min(max(record.x, RADIUS), WIDTH - RADIUS), min(max(record.y, RADIUS), HEIGHT - RADIUS)
    plant = SimPlant(world, drivetrains)
    begin = min(course.seen_at[0] for course in run.courses.values())
    end = max(course.seen_at[-1] for course in run.courses.values())
    times = np.arange(begin, end, DT)
    ways = np.zeros((len(times), ROBOTS, 3))
    asked = {robot: _asked(course, drivetrains[robot], times) for robot, course in run.courses.items()}
    for tick in range(len(times)):
        ways[tick] = [(one.x, one.y, one.heading) for one in world.robots]
        plant.drive([asked[i][tick] if i in asked else (0.0, 0.0) for i in range(ROBOTS)], DT)
    ways[:, :, 2] = np.unwrap(ways[:, :, 2], axis=0)
    return {robot: _seen_along(course, times, ways[:, robot]) for robot, course in run.courses.items()}


def _asked(course: RobotRecording, drivetrain: Drivetrain, times: Floats) -> list[tuple[float, float]]:
    """The twist that was in force at each time."""
    acting = np.searchsorted(course.told_at, times + 0.5 * DT, side="right") - 1
    return [twist(drivetrain, *course.wheels[i]) if i >= 0 else (0.0, 0.0) for i in acting]


def _seen_along(course: RobotRecording, times: Floats, way: Floats) -> Prediction:
    kept = course.seen_at <= times[-1]
    at = course.seen_at[kept]
    return Prediction(at, course.poses[kept], np.column_stack([np.interp(at, times, way[:, i]) for i in range(3)]))
