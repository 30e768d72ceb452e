"""The whole robot loop on the emulated arena, to be measured against what is true there.

Here stands what every proof needs: an arena with moderate noise, a calibration as an operator makes it, the rig on top
of both, and what is projected. What is proven with it is in `proving`.
"""

from time import thread_time

import numpy as np

from pigaming_app.hardware.calibration.boards import BOARD, HELD_OUT
from pigaming_app.hardware.calibration.drift import Drift, corner_markers
from pigaming_app.hardware.calibration.ground_plane import Ground, NoGround
from pigaming_app.hardware.calibration.procedure import Calibration
from pigaming_app.hardware.calibration.solver import verified
from pigaming_app.hardware.control.rig import UNMEASURED, Rig
from pigaming_app.hardware.emulator.arena import ARENA_AT, SHOWS_AFTER, EmulatedArena
from pigaming_app.hardware.emulator.camera import Pace
from pigaming_app.hardware.emulator.optics import CANVAS
from pigaming_app.hardware.emulator.radio import Air
from pigaming_app.hardware.emulator.site import EmulatedSite
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.signals import Fix, Frame, Image
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.sim.plant import Sighting
from pigaming_app.sim.world import DT, HZ, ROBOTS

MODERATE = Air(loss=0.005, doubled=0.005, broken=0.002)
UNREST = 0.15  # size of the exposure steps
DELAY = 0.060  # s that pictures are late; with tick, line and air that is 80 ms of dead time
DISC = 72.0  # px: 95 mm; light from the side falls on a lid 70 mm up as much as 40 mm beside where it would on the mat
GREY = 128
QUICK = 30  # pictures between two that are painted whole


class Watched(Tracker):
    """A tracker of which it is noted how long it takes and what it finds."""

    seconds = 0.0
    pictures = complete = 0

    def see(self, frame: Frame) -> list[Fix]:
        """Correct the robots by a picture; the fixes that were believed."""
        began = thread_time()
        fixes = super().see(frame)
        self.seconds += thread_time() - began
        self.pictures += 1
        self.complete += len({fix.robot for fix in fixes}) == ROBOTS
        return fixes


class Bed:
    """A calibrated arena with a rig on it; `tick` lets 1/50 s pass. A `ground` that is known need not be found."""

    def __init__(
        self, seed: int, fps: float, drops: float = 0.0, air: Air = MODERATE, ground: Ground | None = None
    ) -> None:
        self.arena = EmulatedArena(seed, Pace(fps, DELAY, drops=drops), air, QUICK, UNREST)
        self.ground = ground or calibrated(self.arena)
        self.tracker = Watched(self.ground, self.arena.clock, [UNMEASURED] * ROBOTS)
        self.link = Link(self.arena.radio.open, self.arena.clock)
        self.tracker.drift = drift = Drift(self.ground)
        self.rig = Rig(self.arena.camera, self.tracker, self.link, self.arena.clock, drift=lambda: drift.mm)
        self._busy, self._dark = busy_floor(seed), np.zeros((CANVAS[1], CANVAS[0]), np.uint8)
        for left, top, marker in corner_markers():
            for floor in (self._busy, self._dark):
                floor[top : top + len(marker), left : left + len(marker)] = marker
        self.show(busy=False)

    def find(self) -> None:
        """Let the tracker find the robots on a dark mat, as while places are taken; then show a busy one.

        Raises RuntimeError if that takes more than 10 s.
        """
        for _ in range(10 * HZ):
            self.tick()
            if all(seen.age < 0.2 for seen in self.rig.sense()):
                self.show(busy=True)
                return
        raise RuntimeError("the tracker does not find all robots")

    def show(self, busy: bool) -> None:
        """Show a floor as games have them, or a dark one."""
        self.floor = self._busy if busy else self._dark

    def count(self) -> None:
        """Count pictures anew."""
        self.tracker.seconds, self.tracker.pictures, self.tracker.complete = 0.0, 0, 0

    def tick(self) -> None:
        """Project what the game would: its floor, and a grey disc under every robot where it will be by then."""
        self.arena.project(lit(self.floor, self.rig.sense(SHOWS_AFTER)))
        for _ in range(2):
            self.arena.advance(DT / 2)
            self.rig.pump()

    def misses(self) -> list[tuple[float, float]]:
        """For every robot: how far what the rig says is from where it is now, in mm, and by how much turned, in rad."""
        pairs = zip(self.rig.sense(), self.arena.poses(), strict=True)
        mm = self.ground.mm
        return [
            (mm * float(np.hypot(seen.x - x, seen.y - y)), abs(float(np.angle(np.exp(1j * (seen.heading - heading))))))
            for seen, (x, y, heading) in pairs
        ]


def calibrated(arena: EmulatedArena) -> Ground:
    """The ground of an arena, found and verified as the wizard does it. Raises NoGround."""
    site = EmulatedSite(arena=arena)
    work = Calibration(site, 0, site.measures, "emulated")
    pictures = {board: board.picture() for board in (BOARD, HELD_OUT)}
    while not work.over:
        if work.board is not None:
            arena.project(pictures[work.board])
            work.shown(work.board)
        site.advance(DT)
        work.pump()
    work.close()
    if work.ground is None or work.residuals is None:
        raise NoGround(work.trouble)
    return verified(work.ground, work.residuals)


def busy_floor(seed: int) -> Image:
    """A floor as games have them, with hard edges: dark, with bright walls, lines and texts."""
    import cv2

    random = np.random.default_rng(seed)
    page = np.full((CANVAS[1], CANVAS[0]), 12, np.uint8)
    for _ in range(60):
        (x, y), (wide, high) = random.integers((0, 0), CANVAS), random.integers(8, 180, 2)
        shade = int(random.integers(40, 255))
        cv2.rectangle(page, (int(x), int(y)), (int(x + wide), int(y + high)), shade, int(random.choice([-1, 3])))
    return page


def lit(floor: Image, robots: list[Sighting]) -> Image:
    """The floor with a grey disc under every robot."""
    import cv2

    page = floor.copy()
    for robot in robots:
        if abs(robot.x) < 5000 and abs(robot.y) < 5000:
            middle = (round(robot.x + ARENA_AT[0]), round(robot.y + ARENA_AT[1]))
            cv2.circle(page, middle, round(DISC), GREY, -1)
    return page


def one_core() -> None:
    """Let OpenCV use no more than one core, as is measured."""
    import cv2

    cv2.setNumThreads(1)
