"""Pictures of the rows of the menu for robots."""

from pigaming_app.ui.draw import FOCUS, GREY, ICE, LINE, PLAYERS, STEEL, THIN, GlowCanvas, cut_box
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached


@cached
def sketch(name: str) -> LitImage:
    """Icon of a row, centred on (0, 0)."""
    ink = GlowCanvas(480, 340).set_transform(240, 170)
    if name == "robots":
        for x, y, player in ((-120, -70, 0), (120, -70, 1), (-120, 80, 2), (120, 80, 3)):
            ink.ring(x, y, 46, PLAYERS[player], LINE).disc(x, y, 34, GREY)
            ink.arc(x, y, 68, -0.5, 1.1, FOCUS, THIN).arc(x, y, 68, 2.6, 4.2, FOCUS, THIN)
    elif name == "board":
        ink.line(cut_box(-70, -60, 140, 190, 12), ICE, LINE, True)
        for y in range(-30, 120, 30):
            ink.line([(-92, y), (-70, y)], ICE, LINE).line([(70, y), (92, y)], ICE, LINE)
        ink.line(cut_box(-34, -14, 68, 68, 6), FOCUS, LINE, True)
        ink.line(cut_box(-26, -86, 52, 40, 6), FOCUS, LINE, True).line([(0, -86), (0, -150)], FOCUS, LINE)
    elif name == "radio":
        ink.line([(0, -10), (-50, 140), (50, 140)], ICE, LINE, True).disc(0, -34, 16, FOCUS)
        for radius in (60, 104, 148):
            ink.arc(0, -34, radius, -0.7, 0.7, FOCUS, THIN).arc(0, -34, radius, 2.44, 3.84, FOCUS, THIN)
    elif name == "calibrate":
        ink.line(cut_box(-46, -146, 92, 60, 12), ICE, LINE, True).ring(0, -84, 16, ICE, LINE)
        for x in (-150, 150):
            ink.dashes([(x * 0.16, -62), (x, 60)], FOCUS, THIN, 14, 10, False)
        ink.line([(-150, 60), (150, 60), (196, 146), (-196, 146)], ICE, LINE, True)
        for x, y in ((-90, 102), (0, 102), (90, 102)):
            ink.line(cut_box(x - 16, y - 14, 32, 28, 4), FOCUS, THIN, True)
    elif name == "check":
        ink.line(cut_box(-176, -110, 352, 220, 12), STEEL, THIN, True)
        for x, y in ((-140, -76), (140, -76), (140, 76), (-140, 76)):
            ink.line(cut_box(x - 22, y - 22, 44, 44, 4), FOCUS, LINE, True)
        ink.line([(-50, 4), (-14, 38), (56, -36)], ICE, 12)
    elif name == "things":
        from pigaming_app.scenes.mat.things.outlines import boxes

        ink.line(cut_box(-176, -120, 352, 240, 12), STEEL, THIN, True)
        boxes(ink, 0, 0, FOCUS)
    elif name == "blocks":
        for x, y, wide in ((-90, -60, 76), (90, 50, 130)):
            ink.line(cut_box(x - wide, y - 60, 2 * wide, 120, 6), ICE, LINE, True)
            _marker(ink, x, y)
    elif name == "pin":
        ink.line(cut_box(-170, -110, 340, 220, 12), STEEL, THIN, True)
        points = [(-150, -120), (176, -92), (150, 118), (-182, 96)]
        ink.line(points, FOCUS, LINE, True)
        for x, y in points:
            ink.solid(cut_box(x - 15, y - 15, 30, 30, 4)).line(cut_box(x - 15, y - 15, 30, 30, 4), ICE, LINE, True)
    elif name == "sheet":
        ink.line(cut_box(-108, -150, 216, 300, 14), ICE, LINE, True)
        for x, y in ((-50, -84), (50, -84), (-50, 20), (50, 20)):
            _marker(ink, x, y)
        ink.line([(-80, 112), (80, 112)], ICE, LINE).line([(-80, 98), (-80, 126)], ICE, LINE)
        ink.line([(80, 98), (80, 126)], ICE, LINE)
    elif name == "guide":
        for y, done in ((-96, True), (0, True), (96, False)):
            ink.line(cut_box(-140, y - 30, 60, 60, 8), FOCUS if done else STEEL, LINE, True)
            ink.line([(-44, y), (140, y)], ICE if done else STEEL, LINE)
            if done:
                ink.line([(-128, y), (-114, y + 16), (-86, y - 18)], ICE, LINE)
    else:
        raise KeyError(name)
    return LitImage(ink.lit(0.9), (-240, -170))


def _marker(ink: GlowCanvas, x: float, y: float) -> None:
    ink.line(cut_box(x - 36, y - 36, 72, 72, 4), FOCUS, THIN, True)
    ink.fill([(x - 20, y - 20), (x + 4, y - 20), (x + 4, y + 4), (x - 20, y + 4)], FOCUS)
    ink.fill([(x + 4, y + 4), (x + 20, y + 4), (x + 20, y + 20), (x + 4, y + 20)], FOCUS)
