"""The drawing kit in one place: colours and type, the canvas that glows, icons and small parts.

Scenes import from here; theme, glow, icons and parts hold the parts.
"""

from pigaming_app.ui.draw.glow import ADD, MULT, NEAR, PRE, WIDE, Halos, Ink, Page
from pigaming_app.ui.draw.icons import ICONS, icon
from pigaming_app.ui.draw.parts import ARROWS, SIGNS, badge, brackets, button, button_width, hints, panel
from pigaming_app.ui.draw.theme import (
    ALARM,
    BLACK,
    BLUE,
    BODY,
    BOLD,
    FOCUS,
    GREEN,
    GREY,
    HAIR,
    HERO,
    ICE,
    LABEL,
    LINE,
    MIST,
    ORANGE,
    PLAYERS,
    PURPLE,
    STEEL,
    SUB,
    THIN,
    TITLE,
    WALL,
    WHITE,
    Color,
    Point,
    Points,
    cut,
    dim,
    font,
    mix,
    regular,
    shape_points,
    text_width,
)

__all__ = [
    "ADD", "ALARM", "ARROWS", "BLACK", "BLUE", "BODY", "BOLD", "FOCUS", "GREEN", "GREY", "HAIR", "HERO", "ICE",
    "ICONS", "LABEL", "LINE", "MIST", "MULT", "NEAR", "ORANGE", "PLAYERS", "PRE", "PURPLE", "SIGNS", "STEEL", "SUB",
    "THIN", "TITLE", "WALL", "WHITE", "WIDE", "Color", "Halos", "Ink", "Page", "Point", "Points", "badge", "brackets",
    "button", "button_width", "cut", "dim", "font", "hints", "icon", "mix", "panel", "regular", "shape_points",
    "text_width",
]  # fmt: skip
