"""What one robot's motors make of what they are told: its wheels, their lag, and how late it hears.

A command is a share of full speed for each wheel: `wheel_shares` finds them for a twist, `twist` is the inverse. The
numbers of a measured robot (job `fidelity`) stand in a file, one table for each robot:

[[robot]]
left = [757.6, 0.02]     # px/s at full share, and the share below which the wheel stands still
right = [741.0, 0.03]
base = 62.1              # px between the wheels
lag = 0.08               # s, time constant of the motors
dead_time = 0.06         # s from sending a command to the motors' answer
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import copysign

from pigaming_app.sim.robot import LAG
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import ROBOTS

MM = 1.32  # mm in an arena px on the nominal mat
FASTEST = 3000.0  # px/s, more than any such robot drives


@dataclass(frozen=True)
class Wheel:
    """One driven wheel: px/s at full share; the share, of [0, 1), below which it stands still."""

    speed: float
    deadband: float


@dataclass(frozen=True)
class Drivetrain:
    """Two wheels `base` px apart, motors with a lag (s), and a dead time (s) before they hear."""

    left: Wheel
    right: Wheel
    base: float
    lag: float
    dead_time: float


NOMINAL = Drivetrain(Wheel(1000.0 / MM, 0.0), Wheel(1000.0 / MM, 0.0), 82.0 / MM, LAG, 0.0)  # a 3pi, by its maker


class DrivetrainError(ValueError):
    """A file of robots that cannot be used: one line with file, key and reason."""


def wheel_shares(drivetrain: Drivetrain, linear: float, angular: float) -> tuple[float, float]:
    """What to tell (left, right) so that the robot drives at px/s and rad/s, clockwise positive.

    If a wheel would have to turn faster than it can, both are slowed alike: the way keeps its bend.
    """
    half = 0.5 * drivetrain.base * angular
    left, right = linear + half, linear - half
    over = max(1.0, abs(left) / drivetrain.left.speed, abs(right) / drivetrain.right.speed)
    return _share(drivetrain.left, left / over), _share(drivetrain.right, right / over)


def twist(drivetrain: Drivetrain, left: float, right: float) -> tuple[float, float]:
    """The speed, px/s and rad/s, at which a robot ends up that is told these shares."""
    fast, slow = _speed(drivetrain.left, left), _speed(drivetrain.right, right)
    return 0.5 * (fast + slow), (fast - slow) / drivetrain.base


def parse(text: str, file: str) -> tuple[Drivetrain, ...]:
    """The robots that a file tells of, at most one for each seat. Raises DrivetrainError."""
    try:
        table = TomlTable.parse(text)
        table.only("robot")
        found = tuple(_drivetrain(entry) for entry in table.tables("robot"))
        if not 1 <= len(found) <= ROBOTS:
            raise table.error("robot", f"{len(found)} robots, but 1 to {ROBOTS} are possible")
    except FieldError as wrong:
        raise DrivetrainError(f"{file}: {wrong}") from None
    return found


def to_toml(drivetrains: Sequence[Drivetrain]) -> str:
    """The text of a file that tells of these robots."""
    return "\n".join(
        f"[[robot]]\nleft = [{one.left.speed:.2f}, {one.left.deadband:.4f}]\n"
        f"right = [{one.right.speed:.2f}, {one.right.deadband:.4f}]\nbase = {one.base:.3f}\n"
        f"lag = {one.lag:.4f}\ndead_time = {one.dead_time:.4f}\n"
        for one in drivetrains
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
