"""The emulated arena with a printed floor: the page of the program, as PDFium renders it, below its camera."""

from functools import cache

from pigaming_app.games.arenas import load
from pigaming_app.hardware.calibration.floor_surface import FloorSurface
from pigaming_app.hardware.emulator.camera import CameraTraits
from pigaming_app.hardware.emulator.optics import CANVAS, TrueLens
from pigaming_app.hardware.proof.showings import LENS, Showing, corners_of
from pigaming_app.scenes.mat.paper.floor_sheet import add_poster
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.pdf import PdfFile
from tests.scenes.mat.paper.rendered import pictures

SURFACE = FloorSurface(2540.0, 1430.0)
MM = SURFACE.mm
AMBIENT = 2.5  # room light, where no projector needs a dark room


@cache
def floor_picture(game="pitanks", name="classic", surface=SURFACE):
    """The floor as printed, grey, a px a mm."""
    pdf = PdfFile()
    add_poster(pdf, surface, SCREENS[game], load(game, name), name, Words("en"))
    (picture,) = pictures(pdf.packed(), 1.0)
    return picture


def printed(surface: FloorSurface = SURFACE, lens: TrueLens = LENS, floor=None) -> Showing:
    """A printed floor as a way of showing."""
    corners = corners_of(CANVAS[0] * surface.mm, CANVAS[1] * surface.mm)
    picture = floor_picture(surface=surface) if floor is None else floor
    return Showing(lens, corners, ambient=AMBIENT, paper=lambda seed: picture, sheet=surface.width)


def printed_arena(seed, traits: CameraTraits | None = None, floor=None):
    """An arena whose floor is paper; no light is projected. Its poses are in px of the print."""
    return printed(floor=floor).arena(seed, traits=traits)
