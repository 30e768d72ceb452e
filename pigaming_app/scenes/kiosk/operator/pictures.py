"""The picture beside the operator's rows."""

import math

from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LABEL, LINE, STEEL, TITLE, Color, GlowCanvas, cut_box, dim, icon
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached


@cached
def drawn(name: str, chosen: int) -> LitImage:
    """The picture of a row, centred on (0, 0)."""
    ink = GlowCanvas(480, 340).set_transform(240, 170)
    if name == "figures":
        for i, high in enumerate((60, 130, 190, 110)):
            ink.line(cut_box(-134 + 70 * i, 100 - high, 48, high, 8), FOCUS if high == 190 else ICE, LINE, True)
        ink.line([(-160, 112), (160, 112)], STEEL, LINE)
    elif name in ("quiet", "quiet_from", "quiet_until"):
        ink.ring(0, 0, 104, ICE, LINE).line([(0, 0), (0, -66)], ICE, LINE)
        angle = math.tau * chosen / 24 - math.pi / 2
        ink.line([(0, 0), (52 * math.cos(angle), 52 * math.sin(angle))], FOCUS, LINE)
    elif name == "volume_cap":
        ink.line([(-92, -26), (-56, -26), (-10, -68), (-10, 68), (-56, 26), (-92, 26)], ICE, LINE, True)
        for i, r in enumerate((46, 82, 118)):
            lit: Color = FOCUS if i < (chosen + 3) // 4 else dim(STEEL, 0.8)
            ink.arc(-10, 0, r, -0.62, 0.62, lit, LINE)
        ink.line([(124, -90), (124, 90)], ALARM, LINE)
    elif name == "group_minutes":
        ink.line([(-70, -104), (70, -104), (0, 0)], ICE, LINE, True).line(
            [(-70, 104), (70, 104), (0, 0)], ICE, LINE, True
        )
        ink.fill([(-34, 92), (34, 92), (0, 54)], FOCUS)
    elif name == "keep_choices":
        ink.line([(-130, -4), (0, -116), (130, -4)], ICE, LINE)
        ink.line([(-92, -36), (-92, 108), (92, 108), (92, -36)], ICE, LINE)
        icon(ink, "check" if chosen else "turn_left", 0, 28, 44, FOCUS, LINE)
    elif name == "safe_start":
        ink.line(
            [(0, -116), (92, -84), (92, 10), (52, 78), (0, 116), (-52, 78), (-92, 10), (-92, -84)], ICE, LINE, True
        )
        icon(ink, "check", 0, 0, 44, FOCUS, LINE)
    elif name in ("scoreboard", "board"):
        on = chosen > 0 or name == "board"
        ink.line(cut_box(-196, -84, 176, 116, 12), STEEL, LINE, True).line([(-138, 66), (-78, 66)], STEEL, LINE)
        ink.line(cut_box(20, -84, 176, 116, 12), FOCUS if on else STEEL, LINE, True)
        ink.line([(78, 66), (138, 66)], FOCUS if on else STEEL, LINE)
        if on and (name == "scoreboard" or chosen == 1):
            ink.text("3:2", TITLE - 24, 108, -26, ICE, "hero", "c")
        elif on:
            icon(ink, "crown", 108, -26, 40, ICE, LINE)
    elif name == "trash":
        ink.line([(-72, -64), (-56, 108), (56, 108), (72, -64)], ICE, LINE).line([(-100, -64), (100, -64)], ICE, LINE)
        ink.line([(-28, -64), (-28, -92), (28, -92), (28, -64)], ICE, LINE)
        icon(ink, "turn_left", 0, 22, 40, FOCUS, LINE)
    elif name == "pin":
        ink.line(cut_box(-84, -20, 168, 128, 20), ICE, LINE, True).arc(0, -20, 54, math.pi, math.tau, ICE, LINE)
        for x in (-48, -16, 16, 48):
            ink.disc(x, 44, 9, FOCUS)
    elif name == "end_all":
        ink.line(cut_box(-96, -96, 192, 192, 56), ALARM, LINE, True)
        ink.text("0:00", LABEL, 0, 0, ICE, "hero", "c")
    else:
        raise KeyError(name)
    return LitImage(ink.lit(0.9), (-240, -170))
