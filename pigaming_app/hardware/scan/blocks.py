"""Marker blocks: walls for a mat without a projector, seen by the camera 30 times a second.

A block is a piece of wood or card of the printed size, with a marker of 50 mm in the middle of its top (numbers 20 to
39, on the marker sheet). Its pose follows the hand that moves it; at rest it is smoothed. A hidden block stays where it
was for TIMEOUT. Two blocks with the same number are two walls.
"""

from dataclasses import dataclass
from math import atan2, cos, hypot, inf, sin

import numpy as np

from pigaming_app.hardware.calibration.ground_plane import MARKER, SIZE_TOLERANCE, SKEW_TOLERANCE, GroundPlane
from pigaming_app.hardware.control.moving_things import MovingThings, Things
from pigaming_app.hardware.scan.things import Outline, Thing, ThingKind
from pigaming_app.hardware.signals import CameraFrame, DetectedMarker
from pigaming_app.hardware.vision.markers import MarkerDetector, window_around
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.things.spec import MOST
from pigaming_app.sim.world import HEIGHT, WIDTH

BLOCK_HEIGHT = 50.0  # mm
SQUARE, LONG = (80.0, 80.0), (160.0, 70.0)  # mm: tops of blocks, along and across the upper edge of the marker
BLOCK_SIZES = {number: SQUARE if number < 32 else LONG for number in range(20, 40)}  # mm, by marker
TIMEOUT = 1.0  # s without sight, after which a block is gone
SEARCH = 0.1  # s between two searches of the whole picture
LOST = 0.25  # s for which a block that is out of sight is searched near its last place
STILL, TURN = 4.0, 0.06  # px, rad: smaller changes are noise, and are smoothed; larger ones are followed at once
SMOOTH = 0.15  # share of a small change that one picture contributes
MARGIN = 3.0  # mm
BEYOND = 100.0  # px from the arena, from which on blocks lie beside it


@dataclass
class Block:
    """A block in sight. `x`, `y`: arena px; `heading`: rad."""

    number: int
    x: float
    y: float
    heading: float
    mark: DetectedMarker
    seen: float  # s
    size: tuple[float, float]  # mm

    def outline(self, mm: float) -> Outline:
        """Its footprint, (4, 2) arena px; `mm`: of the mat per px."""
        c, s = cos(self.heading), sin(self.heading)
        along, across = np.array((c, s)) * self.size[0] / (2.0 * mm), np.array((-s, c)) * self.size[1] / (2.0 * mm)
        corners = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
        return np.array([np.array((self.x, self.y)) + u * along + v * across for u, v in corners])

    def follow(self, x: float, y: float, heading: float) -> None:
        """Move to a measured pose."""
        turn = turn_to(heading - self.heading)
        share = SMOOTH if hypot(x - self.x, y - self.y) < STILL and abs(turn) < TURN else 1.0
        self.x, self.y = self.x + share * (x - self.x), self.y + share * (y - self.y)
        self.heading += share * turn


class BlockTracker:
    """The blocks on one mat. `things` is what games get. Raises OpenCVMissing."""

    def __init__(self, ground: GroundPlane) -> None:
        self.ground = ground
        self.blocks: list[Block] = []
        self._markers = MarkerDetector(BLOCK_SIZES)
        self._searched = -inf
        middle = np.array([(WIDTH / 2.0, HEIGHT / 2.0), (WIDTH / 2.0 + MARKER / ground.mm, HEIGHT / 2.0)])
        self._edge = float(np.hypot(*np.diff(ground.to_camera(middle, BLOCK_HEIGHT), axis=0)[0]))  # px, expected

    @property
    def things(self) -> list[Thing]:
        """The blocks as walls, in the order of their numbers."""
        mm = self.ground.mm
        return [
            Thing(ThingKind.TALL, tuple((x, y) for x, y in block.outline(mm).tolist()), BLOCK_HEIGHT, MARGIN / mm)
            for block in sorted(self.blocks, key=lambda block: block.number)
        ]

    def process(self, frame: CameraFrame) -> None:
        """Follow the blocks in one more picture."""
        marks = self._near(frame)
        if frame.captured - self._searched >= SEARCH:
            self._searched = frame.captured
            marks += self._markers.detect_quickly(frame.image, self._edge, marks, dim=False)
        fixes = (self._fix(mark, frame.captured) for mark in self._markers.refine(frame.image, marks))
        self._match([fix for fix in fixes if fix])
        self.blocks = [block for block in self.blocks if frame.captured - block.seen < TIMEOUT]

    def _near(self, frame: CameraFrame) -> list[DetectedMarker]:
        """Known blocks, near their last places."""
        found = []
        for block in self.blocks:
            if frame.captured - block.seen < LOST:
                mark = self._markers.detect_in(frame.image, window_around(block.mark, 1.6), block.number)
                found += [mark] if mark is not None else []
        return found

    def _match(self, fixes: list[Block]) -> None:
        """Move each block to the nearest new sight of its number; what is left over is new."""
        pairs = [(block, fix) for block in self.blocks for fix in fixes if block.number == fix.number]
        for block, fix in sorted(pairs, key=lambda pair: _apart(*pair)):
            if block.seen < fix.seen and any(fix is other for other in fixes):
                block.follow(fix.x, fix.y, fix.heading)
                block.mark, block.seen = fix.mark, fix.seen
                fixes = [other for other in fixes if other is not fix]
        for fix in fixes:
            if all(fix.number != block.number or _apart(block, fix) * self.ground.mm > MARKER for block in self.blocks):
                self.blocks.append(fix)  # else its marker was found twice

    def _fix(self, mark: DetectedMarker, captured: float) -> Block | None:
        """The block under a marker, unless the marker is not on a block."""
        corners = self.ground.at_height(mark.corners, BLOCK_HEIGHT)
        sides = np.hypot(*(corners - np.roll(corners, 1, axis=0)).T) * self.ground.mm
        if sides.max() > SKEW_TOLERANCE * sides.min() or abs(sides.mean() / MARKER - 1.0) > SIZE_TOLERANCE:
            return None
        x, y = corners.mean(axis=0).tolist()
        right = corners[1] + corners[2] - corners[0] - corners[3]
        heading = atan2(right[1], right[0])
        return Block(mark.number, x, y, heading, mark, captured, BLOCK_SIZES[mark.number])


def _apart(one: Block, other: Block) -> float:
    """Distance of two blocks, px."""
    return hypot(one.x - other.x, one.y - other.y)


class BlockWalls:
    """Blocks as walls of a running match: a viewer of the rig.

    `things`: of the match; those it has already stay, and the blocks come and go.
    """

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
