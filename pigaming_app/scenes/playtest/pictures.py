"""The pictures of play tests: beside the operator's rows, and the row of the age on a player's card."""

from pigaming_app.scenes.lobby import seat_card
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LINE, STEEL, GlowCanvas, cut_box, icon
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached


@cached
def drawn(name: str) -> LitImage:
    """The picture of a row of the operator's page, centred on (0, 0)."""
    ink = GlowCanvas(480, 340).set_transform(240, 170)
    if name == "begin":
        presses(ink, FOCUS)
    elif name == "game":
        icon(ink, "pad", 0, 10, 130, FOCUS, LINE)
    else:
        sheets = (-60, 0, 60) if name == "all" else (0,)
        for x in sheets:
            ink.line(cut_box(x - 70, -90 + x // 3, 140, 180, 14), STEEL if x < sheets[-1] else ICE, LINE, True)
        icon(ink, "cross", sheets[-1], sheets[-1] // 3, 44, ALARM, LINE)
    return LitImage(ink.lit(), (-240, -170))


def presses(ink: GlowCanvas, color: kit.Color) -> None:
    """Draw presses of two keys over time, round (0, 0)."""
    for y, spans in ((-44, ((-140, -70), (-10, 50))), (44, ((-90, -30), (20, 130)))):
        ink.line([(-150, y + 34), (150, y + 34)], STEEL, LINE)
        for start, end in spans:
            ink.line(cut_box(start, y - 26, end - start, 52, 8), color, LINE, True)


@cached
def age(text: str, color: kit.Color | None) -> LitImage:
    """The age band between the arrows that change it, outlined in a colour while it can be changed."""
    layer, x, size = seat_card.choice_row(text, seat_card.DRIVE_Y, color, 0)
    layer.canvas.crisp.text(text, size, x, seat_card.DRIVE_Y, kit.ICE, "head")
    return layer.render()
