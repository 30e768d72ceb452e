"""Driving styles of people: from a stick to the linear and angular values of an action, in [-1, 1].

*Turn and drive*: up and down drive, left and right turn, as seen by the robot. *Point where to go*: the robot drives in
the direction of the stick, as seen on the screen. Both depend on the present state alone.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import atan2, cos
from typing import Any, Protocol

from pigaming_app.games.simple import MatchState
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel

TURN_GAIN = 6.0  # rad/s for each rad between heading and stick
FORESIGHT = 0.1  # s by which the heading is predicted: motor lag, and the age of a camera picture


class Controller(Protocol):
    """State of an input device: stick axes in [-1, 1] and two buttons."""

    @property
    def linear(self) -> float: ...

    @property
    def angular(self) -> float: ...

    @property
    def fire(self) -> bool: ...

    @property
    def turbo(self) -> bool: ...


Driving = Callable[[Any, int, Controller], tuple[float, float]]
"""(match state, seat, device) to (linear, angular)."""
Help = Callable[[Any, int, float, float], tuple[float, float]]
"""(match state, seat, linear, angular) to (linear, angular), with steering help."""


@dataclass(frozen=True)
class SteeringHelp:
    """Steering help for models of people. `steer`: a kernel, a Help with a record `memory` of the seat besides."""

    memory: type
    steer: Callable[[Any, int, float, float, Any], tuple[float, float]]


def helped(driving: Driving, help_steer: Help) -> Driving:
    """A driving style with steering help."""

    def drive(state: Any, seat: int, stick: Controller) -> tuple[float, float]:
        return help_steer(state, seat, *driving(state, seat, stick))

    return drive


def turn_and_drive(state: MatchState, seat: int, stick: Controller) -> tuple[float, float]:
    """The stick as it is."""
    return stick.linear, stick.angular


def point_where_to_go(state: MatchState, seat: int, stick: Controller) -> tuple[float, float]:
    """Drive in the direction of the stick on the screen, as fast as it is deflected."""
    robot = state.robots[seat]
    return pointed(stick.angular, -stick.linear, robot.heading, robot.angular, state.rules.turn_rate)


@kernel
def pointed(x: float, y: float, heading: float, angular: float, turn_rate: float) -> tuple[float, float]:
    """Linear and angular values that drive in the direction (x, y), y down, each in [-1, 1].

    `heading` in rad, `angular` and `turn_rate` in rad/s. The robot turns the short way, and drives with the cosine of
    the angle still to turn: it backs up as long as (x, y) is behind it. The prediction by `FORESIGHT` prevents
    overshoot.
    """
    reach = max(abs(x), abs(y))
    if reach == 0.0:
        return 0.0, 0.0
    angle = turn_to(atan2(y, x) - heading - FORESIGHT * angular)
    return min(1.0, reach) * cos(angle), max(-1.0, min(1.0, TURN_GAIN * angle / turn_rate))
