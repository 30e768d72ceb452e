"""The emulated arena with a printed floor: the page of the program, as PDFium renders it, below its camera."""

from functools import cache

import numpy as np

from pigaming_app.games.arenas import load
from pigaming_app.hardware.calibration.floor_surface import FloorSurface
from pigaming_app.hardware.calibration.printed import PrintedCalibration
from pigaming_app.hardware.calibration.site import Measurements
from pigaming_app.hardware.calibration.solver import with_verification
from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.camera import FrameTiming
from pigaming_app.hardware.emulator.optics import CANVAS, Optics
from pigaming_app.hardware.emulator.radio import MODERATE
from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.hardware.session.emulated import FPS, QUICK, EmulatedSession
from pigaming_app.scenes.mat.paper.floor_sheet import add_poster
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.pdf import PdfFile
from tests.scenes.mat.paper.rendered import pictures

SIZE = (2540.0, 1430.0)  # mm
MM = SIZE[0] / CANVAS[0]  # of an arena px
AMBIENT = 2.5  # room light, where no projector needs a dark room
RULER = (1.5, 8.0)  # mm, errors of the measured width and height


@cache
def floor_picture(game="pitanks", name="classic"):
    """The floor as printed, grey, a px a mm."""
    pdf = PdfFile()
    add_poster(pdf, FloorSurface(*SIZE), SCREENS[game], load(game, name), name, Words("en"))
    (picture,) = pictures(pdf.packed(), 1.0)
    return picture


def printed_arena(seed, traits=None, floor=None, **about):
    """An arena whose floor is paper; no light is projected. Its poses are in px of the print."""
    w, h = (side * MM / 2.0 for side in CANVAS)
    corners = np.array([(-w, -h), (w, -h), (w, h), (-w, h)])
    optics = Optics(traits.lens if traits else None, corners)
    arena = EmulatedArena(seed, FrameTiming(FPS), traits=traits, optics=optics, **about)
    arena.camera.painter.lay_paper(floor_picture() if floor is None else floor, 1.0)
    arena.camera.painter.ambient = AMBIENT
    return arena


def calibrate(arena):
    """A calibration by the printed markers, as it ended."""
    site = EmulatedCalibrationSite(arena=arena)
    measures = Measurements(1600.0 * MM + RULER[0], arena.optics.lens.eye[2] + RULER[1])
    work = PrintedCalibration(site, 0, measures)
    while not work.finished:
        site.advance(0.01)
        work.pump()
    work.close()
    return work


class PrintedSession(EmulatedSession):
    """Emulated robots on a printed floor."""

    def _new_arena(self):
        arena = printed_arena(self.seed, channel=MODERATE, refresh=QUICK)
        if self._made is None:
            work = calibrate(arena)
            self._made = with_verification(work.ground, work.residuals)
        return arena
