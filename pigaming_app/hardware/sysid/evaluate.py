"""Fidelity of the simulator: prediction errors before and after identification, and open-loop replays.

A model predicts a robot's pose one, two and five seconds ahead from its commands and its fixes of the last half second.
Predictions are evaluated on the part of the recording that was held out from identification.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from pigaming_app.hardware.recordings import Floats, Recording, RobotRecording
from pigaming_app.hardware.sysid.identify import fit_pieces, identify, move_pieces, track
from pigaming_app.sim.drivetrain import MM, NOMINAL, Drivetrain, scaled, twist
from pigaming_app.sim.plant import SimPlant
from pigaming_app.sim.world import DT, HEIGHT, RADIUS, ROBOTS, WIDTH, World
from pigaming_app.storage.messages import OperatorError, OperatorMessage

HORIZONS = (1.0, 2.0, 5.0)  # s
BEFORE = 0.5  # s of fixes that place the start of a prediction
EVERY = 0.5  # s between predictions
HELD_OUT = 0.35  # share at the end of a recording that is held out from identification
FEWEST = 6  # fixes needed to place a start
SHORTEST = 20.0  # s, shortest usable recording
WAY, TURN = 1500.0, 3.0  # px and rad of motion needed for identification
ODD = 2.0  # largest plausible ratio of a parameter to its nominal value


class RecordingTooShort(OperatorError):
    """No robot can be identified from a recording."""


class PredictionErrors(NamedTuple):
    """Root mean square errors of a model's predictions at each of HORIZONS."""

    mm: tuple[float, ...]
    degrees: tuple[float, ...]


class Identification(NamedTuple):
    """Result for one robot."""

    robot: int
    drivetrain: Drivetrain
    before: PredictionErrors  # of the nominal drivetrain
    after: PredictionErrors  # of the identified drivetrain


class Prediction(NamedTuple):
    """One prediction: times (m,), observed poses (m, 3) and predicted poses (m, 3) at the same times."""

    pose_times: Floats
    seen: Floats
    predicted: Floats


def nominal_train(run: Recording) -> Drivetrain:
    """The nominal robot on the mat of a recording."""
    return scaled(NOMINAL, MM / run.mm)


def measure(run: Recording) -> list[Identification]:
    """Identify every robot of a recording and evaluate both models. Raises RecordingTooShort.

    Robots that hardly moved, or whose parameters are implausible, are left out.
    """
    verdicts, nominal = [], nominal_train(run)
    for robot, course in run.courses.items():
        begin, end = course.pose_times[0], course.pose_times[-1]
        if end - begin < SHORTEST:
            lengths = {"seconds": f"{end - begin:.0f}", "needed": f"{SHORTEST:.0f}"}
            raise RecordingTooShort(OperatorMessage("run_short", robot=robot + 1, **lengths))
        cut = end - HELD_OUT * (end - begin)
        identified = identify(course.between(begin, cut), nominal) if has_moved(course) else None
        if identified is None or not is_plausible(identified, nominal):
            continue
        rest = course.between(cut, end + 1.0)
        before, after = errors(rest, nominal, run.mm), errors(rest, identified, run.mm)
        verdicts.append(Identification(robot, identified, before, after))
    if not verdicts:
        raise RecordingTooShort(OperatorMessage("run_still"))
    return verdicts


def has_moved(course: RobotRecording) -> bool:
    """True if a robot moved and turned enough for its wheels to be identified."""
    way = np.hypot(*np.diff(course.poses[::10, :2], axis=0).T).sum()
    return bool(way > WAY and np.ptp(course.poses[:, 2]) > TURN)


def is_plausible(drivetrain: Drivetrain, nominal: Drivetrain) -> bool:
    """True if the parameters are plausible for a robot."""
    left, right = drivetrain.left, drivetrain.right
    ratios = left.speed / nominal.left.speed, right.speed / nominal.right.speed, drivetrain.base / nominal.base
    return all(1.0 / ODD < ratio < ODD for ratio in ratios) and max(left.deadband, right.deadband) < 0.3


def errors(course: RobotRecording, drivetrain: Drivetrain, mm: float) -> PredictionErrors:
    """Errors of the predictions over this recording; NaN at horizons without any."""
    lengths, angles = [], []
    for horizon in HORIZONS:
        misses = [
            (ahead.seen - ahead.predicted)[-1]
            for ahead in predictions(course, drivetrain, horizon)
            if len(ahead.pose_times)
        ]
        miss = np.array(misses) if misses else np.full((1, 3), np.nan)
        lengths.append(float(np.sqrt(np.mean(miss[:, 0] ** 2 + miss[:, 1] ** 2)) * mm))
        angles.append(float(np.degrees(np.sqrt(np.mean(miss[:, 2] ** 2)))))
    return PredictionErrors(tuple(lengths), tuple(angles))


def predictions(course: RobotRecording, drivetrain: Drivetrain, horizon: float) -> list[Prediction]:
    """Predictions over `horizon` s, one every EVERY s, each at the times of its fixes."""
    times = course.pose_times
    there = track(course, drivetrain, times[0], times[-1]).at(times)
    ahead = []
    for now in np.arange(times[0] + BEFORE, times[-1] - horizon + 1e-9, EVERY):
        first, middle, last = np.searchsorted(times, (now - BEFORE, now, now + horizon + 1e-6))
        if middle - first < FEWEST or last <= middle or times[last - 1] < now + horizon - 0.1:
            continue
        only = np.array([0])  # a single piece
        _, move = fit_pieces(there[first:middle], course.poses[first:middle], only)
        predicted = move_pieces(there[first:last], only, move)[middle - first :]
        ahead.append(Prediction(times[middle:last], course.poses[middle:last], predicted))
    return ahead


def replay(run: Recording, drivetrains: Sequence[Drivetrain]) -> dict[int, Prediction]:
    """Replay the commands of a recording in the simulator, with these drivetrains; predictions by robot.

    Robots start at the first fix of the real ones and run open loop from there.
    """
    world: Any = World()
    for robot, course in run.courses.items():
        record = world.robots[robot]
        x, y, heading = course.poses[0]
        record.present, record.x, record.y, record.heading = 1, float(x), float(y), float(heading % (2.0 * np.pi))
        record.x, record.y = min(max(record.x, RADIUS), WIDTH - RADIUS), min(max(record.y, RADIUS), HEIGHT - RADIUS)
    plant = SimPlant(world, drivetrains)
    begin = min(course.pose_times[0] for course in run.courses.values())
    end = max(course.pose_times[-1] for course in run.courses.values())
    times = np.arange(begin, end, DT)
    ways = np.zeros((len(times), ROBOTS, 3))
    twists = {robot: _commanded(course, drivetrains[robot], times) for robot, course in run.courses.items()}
    for tick in range(len(times)):
        ways[tick] = [(simulated.x, simulated.y, simulated.heading) for simulated in world.robots]
        plant.drive([twists[i][tick] if i in twists else (0.0, 0.0) for i in range(ROBOTS)], DT)
    ways[:, :, 2] = np.unwrap(ways[:, :, 2], axis=0)
    return {robot: _seen_along(course, times, ways[:, robot]) for robot, course in run.courses.items()}


def _commanded(course: RobotRecording, drivetrain: Drivetrain, times: Floats) -> list[tuple[float, float]]:
    """Commanded twist at each time."""
    acting = np.searchsorted(course.command_times, times + 0.5 * DT, side="right") - 1
    return [twist(drivetrain, *course.wheels[i]) if i >= 0 else (0.0, 0.0) for i in acting]


def _seen_along(course: RobotRecording, times: Floats, way: Floats) -> Prediction:
    """Simulated poses `way` (n, 3) at `times` (n,), interpolated at the times of the fixes."""
    covered = course.pose_times <= times[-1]
    at = course.pose_times[covered]
    return Prediction(at, course.poses[covered], np.column_stack([np.interp(at, times, way[:, i]) for i in range(3)]))
