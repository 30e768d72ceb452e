"""Camera height by two heights of one marker: on a robot, and with its lid flat on the mat.

A marker `lid` mm above the mat looks larger by H / (H - lid) than on it, whatever its true size and the mat's width.
"""

from collections import deque

import numpy as np

from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.signals import DetectedMarker

PICTURES = 6  # of a marker at rest
STEADY = 0.004  # relative spread of its size in them
LEAST, MOST = 0.006, 0.20  # relative differences of two heights
MAX_HEIGHT_ERROR = 0.15  # tolerated relative error of the measured height


class TwoHeights:
    """Collects sights of a marker near one place of the mat."""

    def __init__(self, ground: GroundPlane) -> None:
        self.ground = ground
        self._number: int | None = None
        self._recent: deque[float] = deque(maxlen=PICTURES)  # mm, on the mat
        self._low = self._high = 0.0

    def add(self, mark: DetectedMarker | None) -> None:
        """Add a sight with exact corners; None: the marker is not there."""
        if mark is None or mark.number != self._number:
            self._recent.clear()
        if mark is None:
            return
        if mark.number != self._number:
            self._number, self._low, self._high = mark.number, 0.0, 0.0
        corners = self.ground.on_mat(mark.corners)
        self._recent.append(float(np.hypot(*(corners - np.roll(corners, 1, axis=0)).T).mean()) * self.ground.mm)
        if len(self._recent) == PICTURES and np.ptp(self._recent) < STEADY * self._recent[0]:
            size = float(np.mean(self._recent))
            self._low, self._high = min(self._low or size, size), max(self._high, size)

    @property
    def seen(self) -> bool:
        """True once the marker was at rest."""
        return self._high > 0.0

    @property
    def height(self) -> float | None:
        """The camera's height above the mat, mm; None until the marker was seen at two heights."""
        larger = self._high / self._low - 1.0 if self._low else 0.0
        return self.ground.lid * (1.0 + larger) / larger if LEAST < larger < MOST else None

    @property
    def wrong(self) -> bool:
        """True if the height that was measured with a ruler is far off."""
        return self.height is not None and abs(self.ground.height / self.height - 1.0) > MAX_HEIGHT_ERROR
