"""Icons of the rows of the radio page."""

from pigaming_app.ui.draw import FOCUS, GREY, ICE, LINE, PLAYERS, STEEL, THIN, GlowCanvas, cut_box
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached


@cached
def sketch(name: str, robot: int) -> LitImage:
    """Icon of a row, centred on (0, 0); `robot`: the one concerned, or -1 for the computer."""
    ink = GlowCanvas(480, 340).set_transform(240, 170)
    if name == "arena":
        _arena(ink)
    elif name == "channel":
        _channels(ink)
    elif name in ("robot", "kind"):
        _kind(ink, robot)
    elif name in ("module", "write"):
        _module(ink, robot, writing=name == "write")
    else:
        raise KeyError(name)
    return LitImage(ink.lit(0.9), (-240, -170))


def _arena(ink: GlowCanvas) -> None:
    """A mat with its robots inside one frame; the neighbour's frame, dim, beside it."""
    ink.line(cut_box(-206, -126, 300, 252, 16), ICE, LINE, True)
    ink.line(cut_box(118, -126, 90, 252, 16), STEEL, THIN, True)
    for i, (x, y) in enumerate(((-120, -56), (10, -56), (-120, 60), (10, 60))):
        ink.ring(x, y, 34, PLAYERS[i], LINE).disc(x, y, 24, GREY)
    for y in (-56, 60):
        ink.ring(163, y, 26, STEEL, THIN)


def _channels(ink: GlowCanvas) -> None:
    """Bars of a band, one of them lit."""
    for i in range(8):
        x, high = -182 + 52 * i, 90 + 22 * (i % 3)
        box = cut_box(x - 16, 110 - high, 32, high, 6)
        ink.line(box, FOCUS if i == 4 else STEEL, LINE if i == 4 else THIN, True)
        if i == 4:
            ink.fill(box, FOCUS)
    ink.line([(-206, 124), (206, 124)], ICE, THIN)
    ink.arc(26, -20, 60, -2.4, -0.74, FOCUS, THIN).arc(26, -20, 92, -2.4, -0.74, FOCUS, THIN)


def _module(ink: GlowCanvas, robot: int, writing: bool) -> None:
    """A radio with its pins in a carrier with a USB plug; an arrow while it is written."""
    color = ICE if robot < 0 else PLAYERS[robot]
    ink.line(cut_box(-190, -100, 300, 200, 12), STEEL, THIN, True)
    ink.line(cut_box(110, -38, 66, 76, 6), STEEL, LINE, True)
    ink.line([(-110, -70), (30, -70), (72, -26), (72, 70), (-110, 70)], color, LINE, True)
    for i in range(5):
        for y in (-84, 84):
            ink.line([(-96 + 34 * i, y - 6), (-96 + 34 * i, y + 6)], color, THIN)
    ink.ring(-24, 0, 20, color, THIN)
    if writing:
        ink.line([(216, -76), (216, 10)], FOCUS, LINE).line([(194, -14), (216, 12), (238, -14)], FOCUS, LINE)


def _kind(ink: GlowCanvas, robot: int) -> None:
    """A robot from above with its wheels, its circle, and the measure of its diameter."""
    assert robot >= 0
    ink.ring(0, -20, 104, PLAYERS[robot], LINE)
    for x in (-84, 64):
        ink.line(cut_box(x, -54, 20, 68, 4), ICE, THIN, True)
    ink.line(cut_box(-34, -54, 68, 68, 4), GREY, LINE, True).line([(-16, -70), (0, -86), (16, -70)], ICE, LINE)
    ink.line([(-104, 126), (104, 126)], FOCUS, THIN)
    for x in (-104, 104):
        ink.line([(x, 112), (x, 140)], FOCUS, THIN)
