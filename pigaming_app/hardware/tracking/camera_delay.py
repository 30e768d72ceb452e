"""Delay of the camera's stamps, by the delay from commands to the motion that is seen.

Only the sum is seen: a robot's own dead time, the network's, and the lateness of the stamps. What exceeds the dead time
of a drivetrain and the measured echo of the radio belongs to the camera as far as robots have it in common, and to the
robot beyond that. Pairing measures it by correlation, to 5 ms. While robots drive, their filters estimate it, to 15 ms
only: they take motors that are quicker or slower than usual for early or late. Once it was measured, only what changes
from then on counts.
"""

from collections.abc import Sequence

from pigaming_app.hardware.control.motion_delay import common_delay
from pigaming_app.hardware.tracking.ekf import PoseFilter

LONGEST = 0.12  # s
MOTORS = 0.020  # s by which the motors of a robot may be quicker or slower than usual
SURE = 0.006  # s, standard deviation of an estimate that counts
NEGLIGIBLE = 0.010  # s, a delay that counts as none: robots' own delays differ as much
NOTABLE = 0.003  # s, least correction of a delay
PERIOD, SHARE = 0.5, 0.4  # s between two corrections, and the share of the difference in each


class CameraDelay:
    """The delay, s, by which stamps are later than the exposure: slowly corrected while robots drive."""

    def __init__(self) -> None:
        self.seconds, self._next = 0.0, 0.0
        self._usual: dict[int, float] | None = None  # s, lateness of robots when the delay was right; None: never yet

    def learn(self, filters: Sequence[PoseFilter], networks: Sequence[float], now: float) -> None:
        """Move what robots have in common from their filters to the camera; `networks`: s, by robot."""
        if now < self._next:
            return
        self._next = now + PERIOD
        pairs = enumerate(zip(filters, networks, strict=True))
        late = {i: one.correction.late - network for i, (one, network) in pairs if one.lateness_error < SURE}
        if self._usual is not None:
            self._usual = {i: max(-MOTORS, min(MOTORS, seconds)) for i, seconds in late.items()} | self._usual
            late = {i: seconds - self._usual[i] for i, seconds in late.items()}
        common = common_delay(late.values(), MOTORS)
        if abs(common) > (NOTABLE if self.seconds else NEGLIGIBLE):
            change = self.add(SHARE * common, filters)
            for one in filters:
                one.add_lateness(-change)

    def measured(self, seconds: float, filters: Sequence[PoseFilter]) -> None:
        """Correct the delay by a measurement."""
        self.add(seconds if self.seconds + seconds > NEGLIGIBLE else -self.seconds, filters)
        self._usual = {}

    def add(self, seconds: float, filters: Sequence[PoseFilter]) -> float:
        """Lengthen the delay, within its limits, of all fixes so far, too; returns the change, s."""
        change = min(LONGEST, max(0.0, self.seconds + seconds)) - self.seconds
        self.seconds += change
        for one in filters:
            one.shift(-change)
        return change
