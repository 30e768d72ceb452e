"""Real things on the emulated mat: random scenes, scanned and compared with the truth.

Outlines are compared every millimetre, in both directions.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import hypot
from threading import Thread
from time import perf_counter, sleep
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.camera import FrameTiming
from pigaming_app.hardware.emulator.optics import Optics, TrueLens
from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.hardware.emulator.things.prism import Prism
from pigaming_app.hardware.emulator.things.random_scene import scene
from pigaming_app.hardware.scan.procedure import Scan
from pigaming_app.hardware.scan.things import Outline, Thing, ThingKind, ThingLayout
from pigaming_app.hardware.session.emulated import calibrated
from pigaming_app.hardware.signals import CameraFrame, CameraSource, ExposureState
from pigaming_app.storage.messages import OperatorMessage

TILTED = TrueLens(eye=(150.0, 1150.0, 2400.0), aim=(25.0, 50.0), focal=1830.0)  # 25 degrees off the vertical
SMALL = (1280, 720)  # px
GRAIN = 2.0  # grey levels, noise of the small camera
NEAR = 45.0  # mm between the middles of a found thing and a true one
POLL = 0.005  # s between two looks at the camera


class SmallCamera:
    """The emulated camera with 1280 x 720 px."""

    fault: OperatorMessage | None = None

    def __init__(self, camera: CameraSource) -> None:
        self._camera = camera

    @property
    def exposure(self) -> ExposureState:
        return self._camera.exposure

    def newest(self) -> CameraFrame | None:
        import cv2

        frame = self._camera.newest()
        if frame is None:
            return None
        small = np.asarray(cv2.resize(frame.image, SMALL, interpolation=cv2.INTER_AREA), dtype=np.float32)
        small += np.random.default_rng(frame.number).normal(0.0, GRAIN, small.shape).astype(np.float32)
        return CameraFrame(np.rint(small.clip(0, 255)).astype(np.uint8), frame.captured, frame.number)

    def close(self) -> None:
        self._camera.close()


class SmallSite(EmulatedCalibrationSite):
    """The calibration site of an arena with the small camera."""

    def open(self, *args: Any, **kwargs: Any) -> SmallCamera:  # type: ignore[override]
        return SmallCamera(super().open(*args, **kwargs))


class ThingsBed:
    """A calibrated arena for scans. `tilted`: 720p, from 25 degrees; else 1080p, from above."""

    def __init__(self, seed: int, tilted: bool = False) -> None:
        self.arena = EmulatedArena(seed, FrameTiming(30.0), optics=Optics(TILTED) if tilted else None)
        site = (SmallSite if tilted else EmulatedCalibrationSite)(arena=self.arena)
        self.camera: CameraSource = site.open(0)
        self.ground: GroundPlane = calibrated(self.arena, site)
        self.arena.camera.painter.refresh = 1
        self.pictures = 0.0  # s of the arena's clock, of the last scan
        self.seconds = 0.0  # of its computation
        self.stall = 0.0  # s for which that held up the main thread at most

    def furnish(self, things: Sequence[Prism], robots: Sequence[tuple[float, float, float]]) -> None:
        """Put things on the mat, and robots, in arena px and rad; fewer than four: the others are taken away."""
        self.arena.furnish(things)
        for robot in range(len(self.arena.robots)):
            away = robots[robot] if robot < len(robots) else (-3000.0, -3000.0 + 400.0 * robot, 0.0)
            self.arena.place(robot, away)

    def scan(self, before: ThingLayout | None = None) -> Scan:
        """Scan the mat: the projected pictures, the camera's frames, and the computation."""
        scan, arena = Scan(self.ground, self.arena.clock, before), self.arena
        began = arena.clock()
        while (pattern := scan.pattern) is not None:
            arena.project(pattern.picture())
            scan.mark_shown(pattern)
            arena.advance(0.08)
            self.camera.newest()
            while scan.pattern is pattern:
                arena.advance(POLL)
                if (frame := self.camera.newest()) is not None:
                    scan.process(frame)
        self.pictures = arena.clock() - began
        self._compute(scan)
        return scan

    def _compute(self, scan: Scan) -> None:
        """Compute in a thread, as the arcade does, and see how long it keeps the main thread from running."""

        def work() -> None:
            while scan.computing:
                scan.compute()

        thread = Thread(target=work)
        began = last = perf_counter()
        self.stall = 0.0
        thread.start()
        while thread.is_alive():
            sleep(POLL)
            now = perf_counter()
            self.stall, last = max(self.stall, now - last - POLL), now
        self.seconds = perf_counter() - began


@dataclass(frozen=True)
class ThingsResult:
    """Comparison of a scan with the truth; mm."""

    means: tuple[float, ...]  # of the outlines, one for each thing found
    worsts: tuple[float, ...]
    heights: tuple[float, ...]  # errors
    missed: int
    false: int
    seconds: float = 0.0  # of the computation
    stall: float = 0.0  # s for which that held up the main thread at most


def trial(seeds: Sequence[int], tilted: bool = False) -> ThingsResult:
    """Scan random scenes. Times are the best of all: other programs can only add to them. Raises RuntimeError."""
    bed, results = ThingsBed(seeds[0], tilted), []
    for seed in seeds:
        things, robots = scene(seed, bed.arena.optics)
        bed.furnish(things, robots)
        scan = bed.scan()
        if scan.layout is None:
            raise RuntimeError(f"the scan of scene {seed} failed: {scan.fault}")
        results.append(replace(compare(scan.layout.things, things, bed), seconds=bed.seconds, stall=bed.stall))
    return ThingsResult(
        tuple(mm for one in results for mm in one.means),
        tuple(mm for one in results for mm in one.worsts),
        tuple(mm for one in results for mm in one.heights),
        sum(one.missed for one in results),
        sum(one.false for one in results),
        min(one.seconds for one in results),
        min(one.stall for one in results),
    )


def compare(found: Sequence[Thing], true: Sequence[Prism], bed: ThingsBed) -> ThingsResult:
    """Compare found things with the true ones, each found thing with the nearest true one."""
    mm, left = bed.ground.mm, list(found)
    means, worsts, heights, missed = [], [], [], 0
    for thing in true:
        outline = bed.arena.outline(thing)
        kind = ThingKind.TALL if thing.height > 5.0 else ThingKind.FLAT
        near = [(hypot(*(_centre(one.points) - _centre(outline))), i) for i, one in enumerate(left) if one.kind == kind]
        if not near or min(near)[0] * mm > NEAR:
            missed += 1
            continue
        match = left.pop(min(near)[1])
        pairs = ((match.points, outline), (outline, match.points))
        misses = np.concatenate([distances(line, other, 1.0 / mm) for line, other in pairs])
        means.append(mm * float(misses.mean()))
        worsts.append(mm * float(misses.max()))
        heights.append(match.height_mm - (thing.height if kind == ThingKind.TALL else 0.0))
    return ThingsResult(tuple(means), tuple(worsts), tuple(heights), missed, len(left))


def distances(line: Outline, other: Outline, step: float) -> NDArray[np.float64]:
    """Distances of points every `step` along one closed outline from another one, (n,)."""
    after = np.roll(line, -1, axis=0)
    points = np.concatenate(
        [
            a + (b - a) * np.arange(0.0, 1.0, step / max(step, float(np.hypot(*(b - a)))))[:, None]
            for a, b in zip(line, after, strict=True)
        ]
    )
    ways = np.roll(other, -1, axis=0) - other
    away = points[:, None] - other
    share = ((away * ways).sum(axis=2) / (ways * ways).sum(axis=1)).clip(0.0, 1.0)
    return np.asarray(np.sqrt(((away - share[..., None] * ways) ** 2).sum(axis=2)).min(axis=1))


def _centre(outline: Outline) -> NDArray[np.float64]:
    """Centre of the area of an outline."""
    after = np.roll(outline, -1, axis=0)
    weight = outline[:, 0] * after[:, 1] - after[:, 0] * outline[:, 1]
    return np.asarray(((outline + after) * weight[:, None]).sum(axis=0) / (3.0 * weight.sum()))
