"""Projected light for an emulated mat without a window: a floor like a game's, and a grey disc under every robot."""

from collections.abc import Sequence

import numpy as np

from pigaming_app.hardware.calibration.boards import ARENA_AT, CANVAS
from pigaming_app.hardware.calibration.drift import corner_markers
from pigaming_app.hardware.signals import Image
from pigaming_app.hardware.vision.markers import opencv
from pigaming_app.sim.plant import Sighting

DISC = 72.0  # px radius: 95 mm; oblique light is displaced by up to 40 mm on a lid 70 mm above the mat
GREY = 128
FARTHEST = 5000.0  # px; positions beyond are placeholders of robots that were never seen


class Lighting:
    """A dark floor and a busy one with hard edges, both with the corner markers. Raises OpenCVMissing."""

    def __init__(self, seed: int) -> None:
        self._busy, self._dark = busy_floor(seed), np.zeros((CANVAS[1], CANVAS[0]), np.uint8)
        for left, top, marker in corner_markers():
            for floor in (self._busy, self._dark):
                floor[top : top + len(marker), left : left + len(marker)] = marker
        self.show(busy=False)

    def show(self, busy: bool) -> None:
        """Select the busy floor or the dark one."""
        self.floor = self._busy if busy else self._dark

    def picture(self, robots: Sequence[Sighting]) -> Image:
        """The floor with a disc under each of these robots, grey, (1080, 1920)."""
        cv, page = opencv(), self.floor.copy()
        for robot in robots:
            if abs(robot.x) < FARTHEST and abs(robot.y) < FARTHEST:
                middle = (round(robot.x + ARENA_AT[0]), round(robot.y + ARENA_AT[1]))
                cv.circle(page, middle, round(DISC), GREY, -1)
        return page


def busy_floor(seed: int) -> Image:
    """A dark floor with 60 random bright bars and frames, grey, (1080, 1920)."""
    cv, random = opencv(), np.random.default_rng(seed)
    page = np.full((CANVAS[1], CANVAS[0]), 12, np.uint8)
    for _ in range(60):
        (x, y), (wide, high) = random.integers((0, 0), CANVAS), random.integers(8, 180, 2)
        shade = int(random.integers(40, 255))
        cv.rectangle(page, (int(x), int(y)), (int(x + wide), int(y + high)), shade, int(random.choice([-1, 3])))
    return page
