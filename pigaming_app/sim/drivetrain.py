"""Differential-drive model of one robot: wheel speeds with deadband, motor lag, dead time.

A command is a share of full speed for each wheel: `wheel_shares` computes them from a twist, `twist` is the inverse.
The job `fidelity` writes the parameters of measured robots to a file, one table for each robot:

mm = 1.32                # of the mat they were measured on, per px; may be left out

[[robot]]
left = [757.6, 0.02]     # px/s at full share, and the deadband: the share below which the wheel stands still
right = [741.0, 0.03]
base = 62.1              # px between the wheels
lag = 0.08               # s, time constant of the motors
dead_time = 0.06         # s from sending a command to the motors' response
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import copysign

from pigaming_app.sim.robot import LAG
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import ROBOTS

MM = 1.32  # mm per arena px on the nominal mat
FASTEST = 3000.0  # px/s, upper limit of a plausible wheel speed


@dataclass(frozen=True)
class Wheel:
    """One driven wheel: px/s at full share; deadband, the share in [0, 1) below which it stands still."""

    speed: float
    deadband: float


@dataclass(frozen=True)
class Drivetrain:
    """Two wheels `base` px apart; time constant of the motors (s); dead time before they respond (s)."""

    left: Wheel
    right: Wheel
    base: float
    lag: float
    dead_time: float


NOMINAL = Drivetrain(Wheel(1000.0 / MM, 0.0), Wheel(1000.0 / MM, 0.0), 82.0 / MM, LAG, 0.0)  # Pololu 3pi data


class DrivetrainError(ValueError):
    """A file of robots is invalid: one line with file, key and reason."""


def wheel_shares(drivetrain: Drivetrain, linear: float, angular: float) -> tuple[float, float]:
    """Inverse kinematics: wheel shares (left, right) for a twist in px/s and rad/s, clockwise positive.

    If a wheel would exceed its top speed, both are scaled by the same factor, which keeps the curvature.
    """
    half = 0.5 * drivetrain.base * angular
    left, right = linear + half, linear - half
    over = max(1.0, abs(left) / drivetrain.left.speed, abs(right) / drivetrain.right.speed)
    return _share(drivetrain.left, left / over), _share(drivetrain.right, right / over)


def twist(drivetrain: Drivetrain, left: float, right: float) -> tuple[float, float]:
    """Forward kinematics: the steady-state speed, px/s and rad/s, for these wheel shares."""
    fast, slow = _speed(drivetrain.left, left), _speed(drivetrain.right, right)
    return 0.5 * (fast + slow), (fast - slow) / drivetrain.base


def parse(text: str, file: str, mm: float = MM) -> tuple[Drivetrain, ...]:
    """Parse a file of robots, at most one for each seat, for a mat of `mm` per arena px. Raises DrivetrainError."""
    try:
        table = TomlTable.parse(text)
        table.only("mm", "robot")
        scale = table.number("mm", MM, 0.1, 100.0, " mm") / mm
        drivetrains = tuple(scaled(_drivetrain(entry), scale) for entry in table.tables("robot"))
        if not 1 <= len(drivetrains) <= ROBOTS:
            raise table.error("robot", f"{len(drivetrains)} robots, but 1 to {ROBOTS} are possible")
    except FieldError as error:
        raise DrivetrainError(f"{file}: {error}") from None
    return drivetrains


def scaled(train: Drivetrain, scale: float) -> Drivetrain:
    """The same robot where arena px are that many times as many to the mm."""
    if scale == 1.0:
        return train
    left, right = (replace(wheel, speed=wheel.speed * scale) for wheel in (train.left, train.right))
    return replace(train, left=left, right=right, base=train.base * scale)


def to_toml(drivetrains: Sequence[Drivetrain], mm: float = MM) -> str:
    """The text of a file with these robots, as `parse` reads it. `mm`: of their mat per arena px."""
    return f"mm = {mm:.4f}\n\n" + "\n".join(
        f"[[robot]]\nleft = [{train.left.speed:.2f}, {train.left.deadband:.4f}]\n"
        f"right = [{train.right.speed:.2f}, {train.right.deadband:.4f}]\nbase = {train.base:.3f}\n"
        f"lag = {train.lag:.4f}\ndead_time = {train.dead_time:.4f}\n"
        for train in drivetrains
    )


def _share(wheel: Wheel, speed: float) -> float:
    share = wheel.deadband + abs(speed) / wheel.speed * (1.0 - wheel.deadband)
    return copysign(min(share, 1.0), speed) if speed else 0.0


def _speed(wheel: Wheel, share: float) -> float:
    over = min(abs(share), 1.0) - wheel.deadband
    return copysign(wheel.speed * over / (1.0 - wheel.deadband), share) if over > 0.0 else 0.0


def _drivetrain(entry: TomlTable) -> Drivetrain:
    entry.only("left", "right", "base", "lag", "dead_time")
    return Drivetrain(
        _wheel(entry, "left"),
        _wheel(entry, "right"),
        entry.number("base", None, 5.0, 500.0, " px"),
        entry.number("lag", None, 0.001, 2.0, " s"),
        entry.number("dead_time", None, 0.0, 1.0, " s"),
    )


def _wheel(entry: TomlTable, key: str) -> Wheel:
    speed, deadband = entry.numbers(key, 2, 0.0, FASTEST)
    if speed < 1.0 or deadband > 0.9:
        raise entry.error(key, "[px/s at full share, share below which it stands still] is needed")
    return Wheel(speed, deadband)
