"""Who drives, on cards and in rows: the icon of an AI with its level, if it is one, and names of an event."""

from collections.abc import Sequence

from pigaming_app.ai.registry import level_of
from pigaming_app.scenes.flow.match_words import LIT
from pigaming_app.ui.draw import WHITE, Color, GlowCanvas, cut_box, icon, mix, text_width
from pigaming_app.ui.draw.layers import fit_text

TAB = 34  # px, type size on a card's outline


def driver_tab(ink: GlowCanvas, brain: str, name: str, x: float, y: float, room: float, color: Color) -> None:
    """Who drives, on the upper line of a card, which it interrupts, within `room` px from x: the sign of an AI, and the
    name of an entrant, or else the level of the AI. Nothing without either. A long name takes the room of the sign.
    """
    if name and text_width(name, TAB, "hero") > room - 50:
        brain = ""
    lead = 46 if brain else 4
    text, size = fit_text(name, TAB, room - lead - 4, "hero", TAB) if name else (level_mark(brain), TAB)
    w = text_width(text, size, "hero") + 6 if text else 0.0
    if brain or text:
        ink.solid(cut_box(x, y - 18, lead + w - 2, 34, 4))
    if brain:
        icon(ink, "ai", x + 22, y, 17, mix(color, WHITE, 0.5), 3)
    ink.text(text, size, x + lead, y, mix(color, WHITE, 0.8), "hero")


def level_mark(brain: str) -> str:
    """A level in little room: its number and a star; empty if it is none."""
    return f"{level}{LIT}" if (level := level_of(brain)) else ""


def ai_mark(ink: GlowCanvas, brain: str, x: float, y: float, color: Color, r: int = 15) -> None:
    """The sign round (x, y): the icon of `r` px; under that of a level its number and a star."""
    text = level_mark(brain)
    icon(ink, "ai", x, y - (0.9 * r if text else 0), r, color, 3)
    ink.text(text, 2 * r, x, y + 1.25 * r, color, "head", "c")


def ai_of(driver: str) -> str:
    """The AI on a seat, by its driver; empty: a person, or nobody."""
    return "" if driver in ("human", "off") else driver


def name_of(names: Sequence[str], seat: int) -> str:
    """The name on a seat; empty if there is none."""
    return names[seat] if seat < len(names) else ""
