"""Robots of the emulated arena: motors with individual gains, deadband and lag, on a mat with some slip.

Lengths are mm on the mat, x right and y down from the centre of the projected image; heading clockwise, as in the
games. The tracker has no access to these parameters; the job `fidelity` identifies them.
"""

from dataclasses import dataclass
from math import cos, exp, hypot, sin
from random import Random

STEP = 0.002  # s
RADIUS = 47.5  # mm, Pololu 3pi
FULL_SPEED = 1000.0  # mm/s of a wheel, nominal
BASE = 82.0  # mm between the wheels, nominal
DEAD_CELL = 3.6  # V, below which the regulator cuts out


@dataclass(frozen=True)
class RobotParameters:
    """True parameters of one robot."""

    left_gain: float  # true over nominal speed
    right_gain: float
    deadband: float  # shares of full speed below which a motor does not turn
    lag: float  # s, time constant of the motors
    base: float  # mm between the wheels
    slip: float  # standard deviation, as a share of the speed
    battery: float  # V at the start
    drain: float  # V/s at full speed


def random_parameters(random: Random, speed: float = FULL_SPEED, base: float = BASE) -> RobotParameters:
    """Parameters of a typical robot: gains within 8 % of a wheel's nominal `speed`, mm/s. `base`: mm between wheels."""
    slow, wide = speed / FULL_SPEED, base / BASE
    return RobotParameters(
        left_gain=slow * random.uniform(0.92, 1.06),
        right_gain=slow * random.uniform(0.92, 1.06),
        deadband=random.uniform(0.02, 0.05),
        lag=random.uniform(0.06, 0.10),
        base=wide * random.uniform(80.0, 85.0),
        slip=0.01,
        battery=random.uniform(5.0, 5.3),
        drain=random.uniform(0.0002, 0.0004),
    )


class EmulatedRobot:
    """One robot on the mat. Its firmware sets `left` and `right`, the motors' shares of full speed."""

    def __init__(self, body: RobotParameters, x: float, y: float, heading: float, random: Random) -> None:
        self.body = body
        self.x, self.y, self.heading = x, y, heading
        self.left = self.right = 0.0
        self.left_speed = self.right_speed = 0.0  # mm/s, of the wheels
        self.battery = body.battery
        self.height = 0.0  # mm above the mat; positive while it is carried
        self.powered = True
        self.pinned = False  # True if a hand holds it down on the mat
        self.swapped = False  # True if the motors are connected to each other's outputs
        self.polarity = [1.0, 1.0]  # of the motors; -1.0: reversed
        self._random = random
        self._slip = [0.0, 0.0]

    @property
    def alive(self) -> bool:
        """True if it is switched on and its battery suffices."""
        return self.powered and self.battery > DEAD_CELL

    def roll(self) -> None:
        """Advance by STEP: motors follow their voltage; the robot follows its wheels unless it is held."""
        body = self.body
        if not self.alive:
            self.left = self.right = 0.0
        follow = 1.0 - exp(-STEP / body.lag)
        left, right = (self.right, self.left) if self.swapped else (self.left, self.right)
        self.left_speed += (self._target(self.polarity[0] * left, body.left_gain) - self.left_speed) * follow
        self.right_speed += (self._target(self.polarity[1] * right, body.right_gain) - self.right_speed) * follow
        self.battery -= body.drain * STEP * (abs(self.left) + abs(self.right))
        if self.pinned or self.height > 0.0 or not (self.left_speed or self.right_speed):
            return
        left, right = self.left_speed * (1.0 + self._slips(0)), self.right_speed * (1.0 + self._slips(1))
        turn = STEP * (left - right) / body.base  # y down: the left wheel turns it clockwise
        middle, way = self.heading + 0.5 * turn, 0.5 * STEP * (left + right)
        self.x += way * cos(middle)
        self.y += way * sin(middle)
        self.heading += turn

    def _target(self, share: float, gain: float) -> float:
        band = self.body.deadband
        if abs(share) <= band:
            return 0.0
        beyond = (abs(share) - band) / (1.0 - band)
        return gain * FULL_SPEED * (beyond if share > 0.0 else -beyond)

    def _slips(self, wheel: int) -> float:
        """Slip as an autoregressive process with a time constant of about 0.2 s."""
        keep = 0.99
        spread = self.body.slip * (1.0 - keep * keep) ** 0.5
        self._slip[wheel] = keep * self._slip[wheel] + spread * self._random.gauss(0.0, 1.0)
        return self._slip[wheel]


def push_apart(robots: list[EmulatedRobot]) -> None:
    """Resolve overlaps of robots on the mat, half by each."""
    for i, one in enumerate(robots):
        for other in robots[i + 1 :]:
            dx, dy = other.x - one.x, other.y - one.y
            gap = hypot(dx, dy)
            if gap >= 2.0 * RADIUS or one.height > 0.0 or other.height > 0.0:
                continue
            nx, ny = (dx / gap, dy / gap) if gap > 1e-6 else (1.0, 0.0)
            push = 0.5 * (2.0 * RADIUS - gap)
            one.x, one.y = one.x - push * nx, one.y - push * ny
            other.x, other.y = other.x + push * nx, other.y + push * ny
