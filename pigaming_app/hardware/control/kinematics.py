"""From the speeds that a game asks for to what one robot's wheels are told, and what that comes to.

Wheels are not alike, and weaken with their batteries: what the tracker learns of them on the way is made up for, so
that a robot goes straight that is asked to. The radio knows 63 levels of speed each way, one of which is 12 px/s of a
3pi: what rounding leaves over is carried into the next command, so that the speed is right on average.
"""

from math import copysign

from pigaming_app.hardware.control.motion_model import WheelCorrection
from pigaming_app.hardware.signals import WheelCommand
from pigaming_app.sim.drivetrain import Drivetrain, twist, wheel_shares
from pigaming_app.sim.plant import Twist

LEVELS = 63  # of speed, each way: packets.STOP
NEW = WheelCorrection(1.0, 1.0, 1.0, 0.0, 0.0)  # wheels that do as they are told
WEAKEST, STRONGEST = 0.8, 1.25  # gains that are made up for; beyond, something else is wrong


class Kinematics:
    """One robot's wheels; `wear` is what is learnt of them besides their drivetrain."""

    def __init__(self, drivetrain: Drivetrain) -> None:
        self.drivetrain = drivetrain
        self.wear = NEW
        self._carry = [0.0, 0.0]

    def wheels(self, asked: Twist) -> WheelCommand:
        """What to tell the wheels, on the levels that the radio knows."""
        linear, half = asked[0], 0.5 * self.drivetrain.base * asked[1] / _kept(self.wear.turning)
        left, right = self._told(linear + half, self.wear.left), self._told(linear - half, self.wear.right)
        told = wheel_shares(self.drivetrain, 0.5 * (left + right), (left - right) / self.drivetrain.base)
        return WheelCommand(self._level(0, told[0]), self._level(1, told[1]))

    def stand(self) -> WheelCommand:
        """What to tell the wheels so that they stand."""
        self._carry = [0.0, 0.0]
        return WheelCommand(0.0, 0.0)

    def comes_to(self, wheels: WheelCommand) -> Twist:
        """The speed at which wheels without wear end up that are told this: what the tracker starts from."""
        return twist(self.drivetrain, *wheels)

    def goes(self, wheels: WheelCommand) -> Twist:
        """The speed at which these wheels end up that are told this."""
        linear, angular = self.comes_to(wheels)
        half = 0.5 * self.drivetrain.base * angular
        left, right = self._runs(linear + half, self.wear.left), self._runs(linear - half, self.wear.right)
        return 0.5 * (left + right), (left - right) * _kept(self.wear.turning) / self.drivetrain.base

    def _told(self, speed: float, gain: float) -> float:
        """The speed to ask of a wheel so that it runs at `speed`."""
        return copysign(max(0.0, abs(speed) / _kept(gain) + self.wear.stiction), speed) if speed else 0.0

    def _runs(self, told: float, gain: float) -> float:
        return copysign(max(0.0, abs(told) - self.wear.stiction) * _kept(gain), told) if told else 0.0

    def _level(self, wheel: int, share: float) -> float:
        if share == 0.0:
            self._carry[wheel] = 0.0
            return 0.0
        wanted = share + self._carry[wheel]
        level = max(-1.0, min(1.0, round(wanted * LEVELS) / LEVELS))
        self._carry[wheel] = max(-0.5 / LEVELS, min(0.5 / LEVELS, wanted - level))
        return level


def _kept(gain: float) -> float:
    return min(max(gain, WEAKEST), STRONGEST)
