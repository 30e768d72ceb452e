"""Robots that differ from episode to episode within the range of measured real ones (domain randomisation).

The model is that of `sim/plant.py`: limits of the wheels, lag of the motors, dead time. It runs inside compiled loops,
where a command in flight lies in a ring as long as the dead time.
"""

from collections.abc import Sequence
from math import exp
from pathlib import Path
from typing import Any

import numpy as np

from pigaming_app.sim.drivetrain import Drivetrain, parse
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import DT, ROBOTS, Robot
from pigaming_app.storage.parsing import read_text

LONGEST = 51  # ticks of dead time, of at most a second
LEFT, LEFT_DEADBAND, RIGHT, RIGHT_DEADBAND, BASE, GAIN, DEAD_TICKS, PARAMETERS = range(8)  # in a row of numbers


def read_robots(path: str | Path) -> tuple[Drivetrain, ...]:
    """The robots of a file that `fidelity` has written. Raises OSError, ParseError, DrivetrainError."""
    return parse(read_text(Path(path)), Path(path).name)


def drawn_robots(measured: Sequence[Drivetrain], random: np.random.Generator) -> Any:
    """A robot for each seat (4, PARAMETERS): every parameter anywhere between the least and the greatest measured."""
    rows = np.array(
        [
            (train.left.speed, train.left.deadband, train.right.speed, train.right.deadband, train.base, train.lag,
             train.dead_time)
            for train in measured
        ]
    )  # fmt: skip
    found = random.uniform(rows.min(0), rows.max(0), (ROBOTS, PARAMETERS))
    for row in found:
        row[GAIN], row[DEAD_TICKS] = 1.0 - exp(-DT / row[GAIN]), round(row[DEAD_TICKS] / DT)
    return found


@kernel
def hold_back(tick: int, robots: Any, trains: Any, in_flight: Any) -> None:
    """Replace the requested speeds of the robots (4) by those that reach their motors in this tick.

    `trains` (4, PARAMETERS), `in_flight` (4, LONGEST, 2): requests of the last ticks, zero at first.
    """
    for seat in range(ROBOTS):
        robot, train, ring = robots[seat], trains[seat], in_flight[seat]
        limit(robot, train)
        waits = int(train[DEAD_TICKS])
        if waits > 0:
            k = tick % waits
            linear, angular = ring[k, 0], ring[k, 1]
            ring[k, 0], ring[k, 1] = robot.requested_linear, robot.requested_angular
            robot.requested_linear, robot.requested_angular = linear, angular


@kernel
def limit(robot: Robot, train: Any) -> None:
    """The speeds that the wheels can reach: `wheel_shares`, then `twist`, of sim/drivetrain.py."""
    half = 0.5 * train[BASE] * robot.requested_angular
    left, right = robot.requested_linear + half, robot.requested_linear - half
    over = max(1.0, abs(left) / train[LEFT], abs(right) / train[RIGHT])
    fast = reached(left / over, train[LEFT], train[LEFT_DEADBAND])
    slow = reached(right / over, train[RIGHT], train[RIGHT_DEADBAND])
    robot.requested_linear, robot.requested_angular = 0.5 * (fast + slow), (fast - slow) / train[BASE]


@kernel
def reached(wanted: float, fastest: float, deadband: float) -> float:
    """The speed of a wheel, px/s, by way of the share that stands for it."""
    if wanted == 0.0:
        return 0.0
    share = min(deadband + abs(wanted) / fastest * (1.0 - deadband), 1.0)
    over = share - deadband
    if over <= 0.0:
        return 0.0
    speed = float(fastest * over / (1.0 - deadband))
    return speed if wanted > 0.0 else -speed
