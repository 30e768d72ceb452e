"""Ways of showing a game on the emulated arena, each with its own light, optics and calibration.

A projector above the mat; one that stands aside, or shines by a mirror; a television that lies flat; a printed floor
with a screen beside it.
"""

from collections.abc import Callable, Sequence
from math import hypot
from typing import Any, NamedTuple

import numpy as np

from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane
from pigaming_app.hardware.calibration.printed import PrintedCalibration
from pigaming_app.hardware.calibration.site import Measurements
from pigaming_app.hardware.calibration.solver import with_verification
from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.camera import CameraTraits
from pigaming_app.hardware.emulator.optics import CANVAS, CORNERS, LAMP, Floats, Optics, TrueLens
from pigaming_app.hardware.emulator.site import RULER, EmulatedCalibrationSite
from pigaming_app.hardware.emulator.television import MirroredLamp, Television
from pigaming_app.hardware.session.emulated import EmulatedSession, calibrated
from pigaming_app.hardware.session.lighting import Lighting
from pigaming_app.hardware.signals import Image
from pigaming_app.sim.plant import Sighting
from pigaming_app.sim.world import DT
from pigaming_app.storage.messages import OperatorMessage

SPEED = 350.0  # mm/s, of robots that are followed
DARK: Image = np.zeros((CANVAS[1], CANVAS[0]), np.uint8)
# A printed floor, mm: docs/hardware.md says where the middles of its corner markers lie, seen from the field's edges.
SHEET, CORNER, FIELD = (2540, 1430), (212.3, 186.5), (2116.7, 1190.6)  # its size; the field's upper left corner, size
BESIDE, ABOVE, WITHIN, EDGE = 106.0, 75.0, 59.0, 111
FINE = 2  # px of the print in a mm
INK, WALLS = 40, 24  # grey level of ink; bars on the floor


LENS = TrueLens()


def corners_of(width: float, height: float) -> Floats:
    """The corners of an upright picture of this size in the middle of the mat, mm, (4, 2)."""
    return np.array([(-width, -height), (width, -height), (width, height), (-width, height)]) / 2.0


def diagonal(inches: float) -> tuple[float, float]:
    """Width and height of a picture of 16:9, mm."""
    return (inches * 25.4 * 16.0 / hypot(16.0, 9.0), inches * 25.4 * 9.0 / hypot(16.0, 9.0))


class Showing(NamedTuple):
    """A way of showing. `lamp`: place of the projector, mm; `ambient`: share of the usual room light; `readout`: of the
    camera, s; `speed`: of robots that are followed, mm/s; `paper`: draws what is printed, grey, on a `sheet` of this
    width, mm.
    """

    lens: TrueLens = LENS
    corners: Floats = CORNERS
    lamp: Floats = LAMP
    ambient: float = 1.0
    television: Television | None = None
    readout: float = 0.0
    speed: float = SPEED
    paper: Callable[[int], Image] | None = None
    sheet: float = SHEET[0]

    def arena(self, seed: int, traits: CameraTraits | None = None, **about: Any) -> EmulatedArena:
        """An arena that is shown so; `traits`: of another camera; `about`: see EmulatedArena."""
        traits = traits or CameraTraits(lens=self.lens, readout=self.readout)
        optics = Optics(traits.lens or self.lens, self.corners, self.lamp)
        arena = EmulatedArena(seed, traits=traits, optics=optics, **about)
        arena.camera.painter.ambient = self.ambient
        if self.television:
            arena.lay_television(self.television)
        if self.paper:
            self.lay(arena, self.paper(seed))
        return arena

    def lay(self, arena: EmulatedArena, paper: Image) -> None:
        """Print this on the floor, in place of what was, as wide as the sheet."""
        arena.camera.painter.lay_paper(paper, self.sheet / paper.shape[1])


def printed_floor(seed: int) -> Image:
    """A floor with bars and the corner markers of a printed arena, (2860, 5080), FINE px a mm."""
    import cv2

    random, floor = np.random.default_rng(seed), np.full((FINE * SHEET[1], FINE * SHEET[0]), 255, np.uint8)
    for _ in range(WALLS):
        (x, y), (wide, high) = random.integers((600, 400), (4200, 2200)), random.integers(24, 320, 2)
        cv2.rectangle(floor, (int(x), int(y)), (int(x + wide), int(y + high)), INK, int(random.choice([-1, 8])))
    words, edge = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50), FINE * EDGE
    (left, top), (wide, high) = CORNER, FIELD
    columns, rows = (left - BESIDE, left + wide + BESIDE), (top - ABOVE, top + high - WITHIN)
    places = [(columns[0], rows[0]), (columns[1], rows[0]), (columns[1], rows[1]), (columns[0], rows[1])]
    for number, (x, y) in enumerate(places, 10):
        across, down = round(FINE * x - edge / 2), round(FINE * y - edge / 2)
        floor[down : down + edge, across : across + edge] = cv2.aruco.generateImageMarker(words, number, edge)
    return floor


LAMPS = MirroredLamp(-300.0, 120.0, 1200.0, 90.0, 300.0), MirroredLamp(420.0, 60.0, 1200.0, 70.0, 220.0)
SHOWINGS = {
    "projector": Showing(),
    "projector_aside": Showing(corners=corners_of(2540.0, 1428.75), lamp=np.array([-120.0, -1000.0, 2400.0])),
    "television": Showing(  # 65 inches, a backlight that flickers, lamps in the glass, a camera 33 degrees aslant
        lens=TrueLens((40.0, 900.0, 1350.0), (5.0, 40.0), 0.021),
        corners=corners_of(*diagonal(65.0)),
        ambient=2.0,  # the lids have no other light
        television=Television(lamps=LAMPS, hertz=240.0, duty=0.5),
        readout=1 / 40,
        speed=200.0,  # as fast in px as on the mat
    ),
    "printed": Showing(corners=corners_of(2540.0, 1428.75), ambient=2.5, paper=printed_floor),
}


class ShowingSession(EmulatedSession):
    """Emulated robots on a floor that is shown in one of these ways."""

    def __init__(self, showing: Showing, *args: Any, **about: Any) -> None:
        super().__init__(*args, **about)
        self.showing = showing

    def _bare_arena(self, **about: Any) -> EmulatedArena:
        return self.showing.arena(self.seed, **about)

    def _calibrated(self, arena: EmulatedArena) -> GroundPlane:
        return by_print(arena, self.showing.sheet) if self.showing.paper else calibrated(arena)


def by_print(arena: EmulatedArena, sheet: float) -> GroundPlane:
    """Calibrate an arena by its printed markers; `sheet`: width of the paper, mm. Raises CalibrationError."""
    work = print_calibration(arena, sheet)
    if work.ground is None or work.residuals is None or not work.residuals.accepted:
        raise CalibrationError(work.fault or OperatorMessage("slow"))
    return with_verification(work.ground, work.residuals)


def print_calibration(arena: EmulatedArena, sheet: float = SHEET[0]) -> PrintedCalibration:
    """A calibration by printed markers, as it ended; see `by_print`."""
    site = EmulatedCalibrationSite(arena=arena)
    width = sheet * 5.0 / 6.0 + RULER[0]  # of the field
    work = PrintedCalibration(site, 0, Measurements(width, arena.optics.lens.eye[2] + RULER[1]))
    while not work.finished:
        site.advance(DT)
        work.pump()
    work.close()
    return work


class NoLight(Lighting):
    """In place of a projector's light: nothing but room light falls on paper."""

    def picture(self, robots: Sequence[Sighting]) -> Image:
        return DARK
