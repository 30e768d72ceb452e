"""Delay of the camera's stamps, by the delay from commands to the motion that is seen.

Only the sum is seen: a robot's own dead time, the network's, and the lateness of the stamps. What exceeds the dead time
of a drivetrain and the measured echo of the radio belongs to the camera as far as robots have it in common, and to the
robot beyond that. Each robot is measured by correlation over the last WINDOW s in which it drove. When those that
drive become later or earlier, so do those that stand.
"""

from collections import deque
from collections.abc import Mapping, Sequence

from pigaming_app.hardware.signals import Fix
from pigaming_app.hardware.tracking.ekf import PoseFilter
from pigaming_app.hardware.tracking.motion_delay import DriveTrace, common_delay
from pigaming_app.sim.plant import Twist

LONGEST = 0.12  # s
OWN = 0.004  # s by which a robot is likely to be later than its dead time
MEASURED, NEGLIGIBLE = 0.011, 0.012  # s, a delay in common that is the robots' own: by pairing, and while they drive
NOTICED = 0.017  # s, least delay that is noticed while robots drive: measured with larger errors than by pairing
NOTABLE = 0.002  # s, least correction of a delay
STEP = 0.010  # s, largest correction at once: predicted places jump by as much
PERIOD, WINDOW, LEAD = 0.5, 8.0, 0.6  # s between two measurements; s of fixes in one, and of commands before them
APART = 0.025  # s between two fixes that are used
FEW, MANY = 2, 8  # measurements of a robot from which it counts, and over which they are averaged
JUMP = 0.020  # s, a difference after which the mean begins anew
STALE = 6.0  # s after which a robot has not driven lately


class CameraDelay:
    """The delay, s, by which stamps are later than the exposure: slowly corrected while robots drive."""

    def __init__(self, filters: Sequence[PoseFilter]) -> None:
        self.seconds = 0.0
        self._filters = filters
        self._sent = [deque[tuple[float, float, float]]() for _ in filters]
        self._seen = [deque[Fix]() for _ in filters]
        self._late: dict[int, float] = {}  # s, of camera and robot together
        self._driven: dict[int, float] = {}  # s, when that was measured
        self._count = [0] * len(filters)  # of measurements in that mean
        self._next, self._turn = 0.0, 0

    def record_commands(self, time: float, twists: Sequence[Twist | None]) -> None:
        """Record commands, px/s and rad/s; None: stop."""
        for one, sent, (linear, angular) in zip(
            self._filters, self._sent, (each or (0.0, 0.0) for each in twists), strict=True
        ):
            turn = 0.5 * one.drivetrain.base * angular
            sent.append((time, linear + turn, linear - turn))
            while sent[0][0] < time - WINDOW - LEAD:
                sent.popleft()

    def record_fix(self, fix: Fix) -> None:
        """Record a fix, whose stamp is corrected."""
        seen, captured = self._seen[fix.robot], fix.captured + self.seconds
        if not seen or captured - seen[-1].captured >= APART:
            seen.append(fix._replace(captured=captured))
        while seen[0].captured < captured - WINDOW:
            seen.popleft()

    def due(self, now: float) -> DriveTrace | None:
        """Motion of the next robot to be measured, or None if it is not yet time."""
        if now < self._next:
            return None
        self._next, self._turn = now + PERIOD, (self._turn + 1) % len(self._filters)
        robot = self._turn
        return DriveTrace(
            robot, tuple(self._sent[robot]), tuple(self._seen[robot]), self._filters[robot].drivetrain.base
        )

    def learn(self, robot: int, delay: float, network: float, now: float) -> None:
        """Use a measurement of a robot that drives; `network`: s by which commands reach it later than usual."""
        late = delay - self._filters[robot].drivetrain.dead_time - network
        difference = late - self._late.get(robot, late)
        self._count[robot] = 1 if abs(difference) > JUMP else min(MANY, self._count[robot] + 1)
        change = difference / self._count[robot]
        self._late[robot] = self._late.get(robot, late) + change
        self._driven[robot] = now
        standing = [other for other, time in self._driven.items() if now - time > STALE]
        for other in standing:
            self._late[other] += change / (len(self._driven) - len(standing))
        wanted = self._common(NEGLIGIBLE if self.seconds else NOTICED) - self.seconds
        sure = all(self._count[other] >= FEW for other in self._driven.keys() - set(standing))
        if sure and abs(wanted) > NOTABLE:
            self._add(min(STEP, max(-STEP, wanted)))

    def measured(self, delays: Mapping[int, float], now: float) -> None:
        """Set the delay by measurements of these robots at once: s from commands to motion by corrected stamps."""
        for robot, delay in delays.items():
            self._late[robot] = delay + self.seconds - self._filters[robot].drivetrain.dead_time
            self._driven[robot], self._count[robot] = now, FEW
        self._add(self._common(MEASURED) - self.seconds)

    def begin(self, seconds: float) -> None:
        """Begin with the delay of an earlier session."""
        self._add(seconds - self.seconds)

    def _common(self, least: float) -> float:
        """The delay by all measurements, s; 0 if it is less than `least`."""
        common = common_delay(self._late.values())
        return common - OWN if common > least else 0.0

    def _add(self, seconds: float) -> None:
        """Lengthen the delay, within its limits, of all fixes so far, too; robots then act so much sooner."""
        change = min(LONGEST, max(0.0, self.seconds + seconds)) - self.seconds
        self.seconds += change
        for one in self._filters:
            one.shift(-change)
            one.add_lateness(-change)
