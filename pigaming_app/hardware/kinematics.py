"""From the speeds that a game asks for to what one robot's wheels are told, and what that comes to.

The radio knows 63 levels of speed each way, one of which is 12 px/s of a 3pi: what rounding leaves over is carried into
the next command, so that the speed is right on average; the motors smooth it.
"""

from pigaming_app.hardware.signals import Wheels
from pigaming_app.sim.drivetrain import Drivetrain, shares, twist
from pigaming_app.sim.plant import Twist

LEVELS = 63  # of speed, each way: packets.STOP


class Kinematics:
    """One robot's wheels."""

    def __init__(self, drivetrain: Drivetrain) -> None:
        self.drivetrain = drivetrain
        self._carry = [0.0, 0.0]

    def wheels(self, asked: Twist) -> Wheels:
        """What to tell the wheels, on the levels that the radio knows."""
        left, right = shares(self.drivetrain, *asked)
        return Wheels(self._level(0, left), self._level(1, right))

    def stand(self) -> Wheels:
        """What to tell the wheels so that they stand."""
        self._carry = [0.0, 0.0]
        return Wheels(0.0, 0.0)

    def comes_to(self, wheels: Wheels) -> Twist:
        """The speed at which a robot ends up that is told this."""
        return twist(self.drivetrain, *wheels)

    def _level(self, wheel: int, share: float) -> float:
        if share == 0.0:
            self._carry[wheel] = 0.0
            return 0.0
        wanted = share + self._carry[wheel]
        level = max(-1.0, min(1.0, round(wanted * LEVELS) / LEVELS))
        self._carry[wheel] = max(-0.5 / LEVELS, min(0.5 / LEVELS, wanted - level))
        return level
