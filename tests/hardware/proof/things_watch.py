"""The watch over things in a match on the emulated mat: no false alarm while robots drive, and an alarm after a move.

The scan gets its frames from the rig, as in the arcade; robots then drive figures of eight round the things, on a busy
floor, under wandering light and with steps of the exposure.
"""

from dataclasses import replace

from pigaming_app.hardware.emulator.arena import SHOWS_AFTER
from pigaming_app.hardware.emulator.things.prism import box, cylinder
from pigaming_app.hardware.proof.testbed import Testbed
from pigaming_app.hardware.proof.trials import FigureEight
from pigaming_app.hardware.scan.procedure import Scan
from pigaming_app.hardware.scan.things import ThingLayout
from pigaming_app.hardware.scan.watch import ThingsWatch
from pigaming_app.hardware.session.emulated import QUICK
from pigaming_app.hardware.signals import CameraFrame
from pigaming_app.sim.world import DT, HZ

BETWEEN = (
    box(20.0, -450.0, 120.0, 80.0, 90.0, 0.3, 0.45, "printed", 1),
    cylinder(15.0, 60.0, 42.0, 110.0, 0.3, "cloudy", 2),
    box(-980.0, 60.0, 90.0, 70.0, 60.0, 1.2, 0.08, "plain", 3),
    box(990.0, 60.0, 100.0, 80.0, 120.0, 0.7, 0.6, "striped", 4),
)  # mm, where no robot comes
PUSHED = 60.0  # mm


class WatchedMatch:
    """Robots that drive round things which are watched. Raises RuntimeError if the scan fails."""

    def __init__(self, seed: int, fps: float = 30.0) -> None:
        self.bed = Testbed(seed, fps)
        self.arena = self.bed.arena
        self.trail = FigureEight(self.bed)
        self.arena.furnish(BETWEEN)
        self.scan = scanned(self.bed)
        assert self.scan.expected is not None
        self.watch = ThingsWatch(self.scan.expected, self.arena.clock)
        self.bed.rig.viewers.append(self._view)

    def drive(self, seconds: float) -> bool:
        """Drive until an alarm, at most `seconds`; True if there was one."""
        for _ in range(round(seconds * HZ)):
            self.arena.camera.painter.refresh = 1 if self.watch.looks else QUICK
            picture = self.bed.lighting.picture(self.bed.rig.sense(SHOWS_AFTER))
            self.watch.note_canvas(lambda picture=picture: picture, self.arena.clock())  # type: ignore[misc]
            self.trail.tick()
            if self.watch.changed:
                return True
        return False

    def push(self, number: int) -> None:
        """Somebody pushes a thing aside."""
        things = list(self.arena.things)
        outline = tuple((x + PUSHED, y + PUSHED) for x, y in things[number].outline)
        things[number] = replace(things[number], outline=outline)
        self.arena.furnish(things)

    def _view(self, frame: CameraFrame) -> None:
        self.watch.process(frame, [(seen.x, seen.y) for seen in self.bed.rig.tracker.sense(frame.captured)])


def layout_of(scan: Scan) -> ThingLayout:
    """The layout that a scan must have found."""
    assert scan.layout is not None, scan.fault
    return scan.layout


def scanned(bed: Testbed) -> Scan:
    """Scan the mat with the rig's frames, while the robots stand. Raises RuntimeError."""
    arena, rig = bed.arena, bed.rig
    arena.camera.painter.refresh = 1  # the scan looks at the whole mat
    for _ in range(HZ):
        rig.send([None] * 4)
        arena.advance(DT)
    scan = Scan(bed.ground, arena.clock)
    rig.viewers.append(scan.process)
    while (pattern := scan.pattern) is not None:
        arena.project(pattern.picture())
        scan.mark_shown(pattern)
        arena.advance(DT)
        rig.pump()
    rig.viewers.remove(scan.process)
    arena.camera.painter.refresh = QUICK
    while scan.computing:
        scan.compute()
    if scan.layout is None:
        raise RuntimeError(f"the scan failed: {scan.fault}")
    return scan
