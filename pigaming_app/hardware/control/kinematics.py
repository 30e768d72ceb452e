"""Differential-drive kinematics of one robot: twist to wheel commands and back.

Wheels differ and weaken with the battery; the corrections that the tracker estimates are applied here. The radio
protocol has 63 speed levels each way, one level being 12 px/s of a 3pi: the rounding error is carried into the next
command, so the mean speed is exact.
"""

from math import copysign

from pigaming_app.hardware.signals import WheelCommand
from pigaming_app.hardware.tracking.motion_model import WheelCorrection
from pigaming_app.sim.drivetrain import NOMINAL, Drivetrain, twist, wheel_shares
from pigaming_app.sim.plant import Twist

LEVELS = 63  # of speed, each way: packets.STOP
IDEAL = WheelCorrection(1.0, 1.0, 1.0, 0.0, 0.0)
SPIN, STRONGEST_SPIN = 0.14, 0.9  # share of full speed at which a nominal robot spins at 2.5 rad/s; the most
WEAKEST, STRONGEST = 0.8, 1.25  # limits of corrected gains; beyond, the cause is another


class Kinematics:
    """Kinematics of one robot; `correction` is the estimated correction of its drivetrain.

    `levels`: of speed, each way; None: commands are not rounded.
    """

    def __init__(self, drivetrain: Drivetrain, levels: int | None = LEVELS) -> None:
        self.drivetrain, self.levels = drivetrain, levels
        self.correction = IDEAL
        self._carry = [0.0, 0.0]

    def wheels(self, desired: Twist) -> WheelCommand:
        """The wheel command for a twist (px/s, rad/s), rounded to the levels."""
        linear, half = desired[0], 0.5 * self.drivetrain.base * desired[1] / _plausible(self.correction.turning)
        left, right = (
            self._commanded(linear + half, self.correction.left),
            self._commanded(linear - half, self.correction.right),
        )
        shares = wheel_shares(self.drivetrain, 0.5 * (left + right), (left - right) / self.drivetrain.base)
        return WheelCommand(self._level(0, shares[0]), self._level(1, shares[1]))

    def stand(self) -> WheelCommand:
        """The wheel command of a robot at rest."""
        self._carry = [0.0, 0.0]
        return WheelCommand(0.0, 0.0)

    def nominal_twist(self, wheels: WheelCommand) -> Twist:
        """Steady-state twist of a command without wear: the tracker's input."""
        return twist(self.drivetrain, *wheels)

    def expected_twist(self, wheels: WheelCommand) -> Twist:
        """Steady-state twist of a command with the estimated wear."""
        linear, angular = self.nominal_twist(wheels)
        half = 0.5 * self.drivetrain.base * angular
        left, right = (
            self._actual(linear + half, self.correction.left),
            self._actual(linear - half, self.correction.right),
        )
        return 0.5 * (left + right), (left - right) * _plausible(self.correction.turning) / self.drivetrain.base

    def _commanded(self, speed: float, gain: float) -> float:
        """The nominal wheel speed to command for a true `speed`, px/s."""
        return copysign(max(0.0, abs(speed) / _plausible(gain) + self.correction.stiction), speed) if speed else 0.0

    def _actual(self, command: float, gain: float) -> float:
        return (
            copysign(max(0.0, abs(command) - self.correction.stiction) * _plausible(gain), command) if command else 0.0
        )

    def _level(self, wheel: int, share: float) -> float:
        if share == 0.0:
            self._carry[wheel] = 0.0
            return 0.0
        if self.levels is None:
            return max(-1.0, min(1.0, share))
        wanted, half = share + self._carry[wheel], 0.5 / self.levels
        level = max(-1.0, min(1.0, round(wanted * self.levels) / self.levels))
        self._carry[wheel] = max(-half, min(half, wanted - level))
        return level


def spin_share(drivetrain: Drivetrain) -> float:
    """Share of full speed, with wheels in opposite directions, at which a robot spins as fast as a nominal one."""
    quickness = (drivetrain.left.speed + drivetrain.right.speed) / drivetrain.base
    return min(STRONGEST_SPIN, SPIN * 2.0 * NOMINAL.left.speed / NOMINAL.base / quickness)


def _plausible(gain: float) -> float:
    return min(max(gain, WEAKEST), STRONGEST)
