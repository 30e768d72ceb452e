"""Marker blocks as walls of a running match: the camera follows them, the plant moves their walls."""

import logging

from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.control.moving_things import MovingThings, Things
from pigaming_app.hardware.scan.blocks import BlockTracker
from pigaming_app.hardware.signals import CameraFrame
from pigaming_app.sim.things.spec import MOST
from pigaming_app.sim.world import HEIGHT, WIDTH

BEYOND = 100.0  # px from the arena, from which on blocks lie beside it

log = logging.getLogger("pigaming")


class BlockWalls:
    """A viewer of the rig. `things`: of the match; those it has already stay, and the blocks come and go."""

    def __init__(self, ground: GroundPlane, things: MovingThings) -> None:
        self.tracker, self.things = BlockTracker(ground), things
        self._fixed: Things = things.wanted

    def process(self, frame: CameraFrame) -> None:
        """Follow the blocks in one more picture."""
        self.tracker.process(frame)
        blocks = [thing.spec for thing in self.tracker.things if _is_near(*thing.middle)]
        self.things.wanted = (*self._fixed, *blocks)[:MOST]


def _is_near(x: float, y: float) -> bool:
    return -BEYOND < x < WIDTH + BEYOND and -BEYOND < y < HEIGHT + BEYOND
