"""Identification of a drivetrain from a recording: wheel gains, deadbands, lag, dead time and wheel base.

Multiple shooting: the recording is cut into windows of one second, each with its own fitted start pose, so that noise
and slip do not accumulate; wheel speeds follow from the commands of the whole recording. Levenberg-Marquardt with the
start poses projected out (variable projection, Golub and Pereyra 1973), for each dead time of a grid.
"""

from dataclasses import replace
from math import exp
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.least_squares import least_squares
from pigaming_app.hardware.recordings import Floats, RobotRecording
from pigaming_app.sim.drivetrain import Drivetrain, Wheel

Index = NDArray[np.intp]

WINDOW = 1.0  # s
STEP = 0.005  # time step of the model, s
NOISE = np.array([0.8, 0.8, 0.012])  # standard deviations of a fix: px, px, rad
FEWEST = 8  # fixes needed in a window
HUBER = 3.0  # standard deviations beyond which a fix is down-weighted
LATEST, COARSE = 0.20, 0.02  # s, end and spacing of the grid of dead times
EARLY = 2.0  # s before the start from which commands still have an effect
ITERATIONS = 25  # iteration limit
TOLERANCE = 1e-5  # relative decrease of the cost at convergence
LATE = 6  # index of the dead time in the parameters: left, right, their deadbands, lag, base, dead time
STEPS = np.array([1.0, 1.0, 1e-3, 1e-3, 1e-3, 0.1, 1e-3])  # finite-difference steps of the parameters
LEAST = np.array([100.0, 100.0, 0.0, 0.0, 0.01, 20.0, 0.0])  # lower bounds
MOST = np.array([3000.0, 3000.0, 0.5, 0.5, 0.5, 300.0, 0.5])  # upper bounds


class Trajectory(NamedTuple):
    """A simulated path from (0, 0, 0) on an unbounded floor: times (n,) and poses (n, 3)."""

    times: Floats
    poses: Floats

    def at(self, times: Floats) -> Floats:
        """Poses (m, 3) interpolated at these times (m,)."""
        return np.column_stack([np.interp(times, self.times, self.poses[:, i]) for i in range(3)])


def track(course: RobotRecording, drivetrain: Drivetrain, begin: float, end: float) -> Trajectory:
    """Simulate the commands of a recording with this drivetrain from `begin` to `end`, s."""
    times = np.asarray(begin - EARLY + STEP * np.arange(int((end - begin + EARLY) / STEP) + 2), dtype=np.float64)
    acts = course.command_times + drivetrain.dead_time
    left, right = (
        _follow(_mean(acts, _speed(course.wheels[:, i], wheel), times), drivetrain.lag)
        for i, wheel in enumerate((drivetrain.left, drivetrain.right))
    )
    heading = np.concatenate(([0.0], np.cumsum((left - right) / drivetrain.base * STEP)))
    middle = 0.5 * (heading[1:] + heading[:-1])
    way = 0.5 * (left + right) * STEP
    x = np.concatenate(([0.0], np.cumsum(way * np.cos(middle))))
    y = np.concatenate(([0.0], np.cumsum(way * np.sin(middle))))
    return Trajectory(times, np.column_stack([x, y, heading]))


def fit_pieces(there: Floats, seen: Floats, firsts: Index) -> tuple[Floats, Floats]:
    """Move each piece of a track (m, 3) rigidly to its best fit with the fixes (m, 3); pieces start at `firsts` (w,).

    Returns the poses (m, 3) and the moves (w, 3): new position of each piece's first point, and the turn about it.
    """
    counts = np.diff(np.append(firsts, len(there)))
    move = seen[firsts].copy()
    move[:, 2] = np.add.reduceat(seen[:, 2] - there[:, 2], firsts) / counts
    for _ in range(3):
        moved = move_pieces(there, firsts, move)
        rest = (seen - moved) / NOISE**2
        dx, dy = (moved - np.repeat(move, counts, axis=0))[:, :2].T
        gradient = np.column_stack([rest[:, 0], rest[:, 1], rest[:, 2] + dx * rest[:, 1] - dy * rest[:, 0]])
        normal = np.zeros((len(firsts), 3, 3))
        near, turn = NOISE[0] ** -2, NOISE[2] ** -2
        normal[:, 0, 0] = normal[:, 1, 1] = near * counts
        normal[:, 0, 2] = normal[:, 2, 0] = -near * np.add.reduceat(dy, firsts)
        normal[:, 1, 2] = normal[:, 2, 1] = near * np.add.reduceat(dx, firsts)
        normal[:, 2, 2] = near * np.add.reduceat(dx * dx + dy * dy, firsts) + turn * counts
        move = move + np.linalg.solve(normal, np.add.reduceat(gradient, firsts)[:, :, None])[:, :, 0]
    return move_pieces(there, firsts, move), move


def move_pieces(there: Floats, firsts: Index, move: Floats) -> Floats:
    """Pieces of a track (m, 3) that start at `firsts` (w,), moved by `move` (w, 3) as in `fit_pieces`."""
    counts = np.diff(np.append(firsts, len(there)))
    begin, to = np.repeat(there[firsts], counts, axis=0), np.repeat(move, counts, axis=0)
    c, s = np.cos(to[:, 2]), np.sin(to[:, 2])
    x, y = (there - begin)[:, :2].T
    return np.column_stack([to[:, 0] + c * x - s * y, to[:, 1] + s * x + c * y, there[:, 2] + to[:, 2]])


def identify(course: RobotRecording, start: Drivetrain) -> Drivetrain:
    """The drivetrain that fits a recording best, searched from `start`."""
    grid = np.arange(0.0, LATEST + 1e-9, COARSE)
    fits = [_fitted(course, replace(start, dead_time=float(dead)), LATE) for dead in grid]
    return _fitted(course, min(fits, key=lambda fit: fit[0])[1], LATE + 1)[1]


def _fitted(course: RobotRecording, start: Drivetrain, free: int) -> tuple[float, Drivetrain]:
    """Fit the first `free` parameters of the drivetrain; returns the cost and the drivetrain."""
    fixed = _vector(start)[free:]

    def residual(numbers: Floats) -> Floats:
        """Residuals with the start poses refitted for each drivetrain, which projects them out."""
        return _residual(course, _drivetrain(np.concatenate([numbers, fixed])))

    bounds = LEAST[:free], MOST[:free]
    solution = least_squares(residual, _vector(start)[:free], ITERATIONS, STEPS[:free], bounds, HUBER, TOLERANCE)
    return solution.cost, _drivetrain(np.concatenate([solution.at, fixed]))


def _residual(course: RobotRecording, drivetrain: Drivetrain) -> Floats:
    """Residuals of all windows in standard deviations, each window placed at its best fit."""
    whole = track(course, drivetrain, course.pose_times[0], course.pose_times[-1])
    window = ((course.pose_times - course.pose_times[0]) / WINDOW).astype(int)
    usable = np.bincount(window)[window] >= FEWEST
    seen, window = course.poses[usable], window[usable]
    if not len(seen):
        return np.zeros(1)
    firsts = np.flatnonzero(np.diff(window, prepend=-1))
    fitted, _ = fit_pieces(whole.at(course.pose_times[usable]), seen, firsts)
    return np.asarray(((seen - fitted) / NOISE).ravel())


def _vector(drivetrain: Drivetrain) -> Floats:
    left, right = drivetrain.left, drivetrain.right
    numbers = (left.speed, right.speed, left.deadband, right.deadband, drivetrain.lag, drivetrain.base)
    return np.array([*numbers, drivetrain.dead_time])


def _drivetrain(vector: Floats) -> Drivetrain:
    """The drivetrain of a parameter vector, clipped to its bounds."""
    left, right, left_band, right_band, lag, base, dead = np.clip(vector, LEAST, MOST).tolist()
    return Drivetrain(Wheel(left, left_band), Wheel(right, right_band), base, lag, dead)


def _speed(shares: Floats, wheel: Wheel) -> Floats:
    over = np.maximum(np.minimum(np.abs(shares), 1.0) - wheel.deadband, 0.0)
    return np.asarray(np.sign(shares) * wheel.speed * over / (1.0 - wheel.deadband))


def _mean(acts: Floats, speeds: Floats, times: Floats) -> Floats:
    """Mean over each step of `times` of a piecewise constant speed that changes at `acts`."""
    way = np.concatenate(([0.0], np.cumsum(speeds[:-1] * np.diff(acts))))  # up to each command
    acts, way = np.append(acts, times[-1] + 1.0), np.append(way, way[-1] + speeds[-1] * (times[-1] + 1.0 - acts[-1]))
    return np.asarray(np.diff(np.interp(times, acts, way)) / STEP)


def _follow(target: Floats, lag: float) -> Floats:
    """Mean speed over each step of first-order motors, exact for piecewise constant targets."""
    decay = exp(-STEP / lag)
    count = min(len(target), int(12.0 * lag / STEP) + 1)
    response = (1.0 - decay) * decay ** np.arange(count)
    reached = np.concatenate(([0.0], np.convolve(target, response)[: len(target)]))
    mean = (1.0 - decay) * lag / STEP
    return np.asarray(target + (reached[:-1] - target) * mean)
