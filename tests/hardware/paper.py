"""The emulated arena with a printed floor: the page of the program, as PDFium renders it, below its camera."""

from functools import cache

import numpy as np

from pigaming_app.games.arenas import load
from pigaming_app.hardware.calibration.floor_surface import FloorSurface
from pigaming_app.hardware.calibration.printed import PrintedCalibration
from pigaming_app.hardware.calibration.site import Measurements
from pigaming_app.hardware.calibration.solver import with_verification
from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.camera import CameraTraits, FrameTiming
from pigaming_app.hardware.emulator.optics import CANVAS, Optics
from pigaming_app.hardware.emulator.radio import MODERATE
from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.hardware.session.emulated import FPS, QUICK, EmulatedSession
from pigaming_app.scenes.mat.paper.floor_sheet import add_poster
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.pdf import PdfFile
from tests.scenes.mat.paper.rendered import pictures

SURFACE = FloorSurface(2540.0, 1430.0)
MM = SURFACE.mm
AMBIENT = 2.5  # room light, where no projector needs a dark room
RULER = (1.5, 8.0)  # mm, errors of the measured width and height


@cache
def floor_picture(game="pitanks", name="classic", surface=SURFACE):
    """The floor as printed, grey, a px a mm."""
    pdf = PdfFile()
    add_poster(pdf, surface, SCREENS[game], load(game, name), name, Words("en"))
    (picture,) = pictures(pdf.packed(), 1.0)
    return picture


def printed_arena(seed, traits=None, floor=None, surface=SURFACE, **about):
    """An arena whose floor is paper; no light is projected. Its poses are in px of the print."""
    w, h = (side * surface.mm / 2.0 for side in CANVAS)
    corners = np.array([(-w, -h), (w, -h), (w, h), (-w, h)])
    optics = Optics(traits.lens if traits else None, corners)
    arena = EmulatedArena(seed, FrameTiming(FPS), traits=traits, optics=optics, **about)
    arena.camera.painter.lay_paper(floor_picture(surface=surface) if floor is None else floor, 1.0)
    arena.camera.painter.ambient = AMBIENT
    return arena


def calibrate(arena, surface=SURFACE):
    """A calibration by the printed markers, as it ended."""
    site = EmulatedCalibrationSite(arena=arena)
    measures = Measurements(surface.field[0] + RULER[0], arena.optics.lens.eye[2] + RULER[1])
    work = PrintedCalibration(site, 0, measures)
    while not work.finished:
        site.advance(0.01)
        work.pump()
    work.close()
    return work


class PrintedSession(EmulatedSession):
    """Emulated robots on a printed floor. `lens`: None: that of the emulator."""

    surface, lens = SURFACE, None

    def _new_arena(self):
        traits = CameraTraits(lens=self.lens)
        arena = printed_arena(self.seed, traits, surface=self.surface, channel=MODERATE, refresh=QUICK)
        if self._made is None:
            work = calibrate(arena, self.surface)
            self._made = with_verification(work.ground, work.residuals)
        return arena
