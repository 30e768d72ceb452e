"""The sign of an AI on cards and in rows: its icon, and its level, if it is one."""

from pigaming_app.ai.registry import level_of
from pigaming_app.scenes.flow.brain_names import LIT
from pigaming_app.ui.draw import WHITE, Color, GlowCanvas, cut_box, icon, mix, text_width

TAB = 32  # px, type size on a card's outline


def ai_tab(ink: GlowCanvas, brain: str, x: float, y: float, color: Color) -> None:
    """The sign on the upper line of a card, which it interrupts; x: its left edge. Nothing without a brain."""
    if brain:
        text = level_mark(brain)
        w = text_width(text, TAB, "hero") if text else 0.0
        ink.solid(cut_box(x, y - 18, 44 + w + (6 if text else 0), 34, 4))
        icon(ink, "ai", x + 22, y, 17, mix(color, WHITE, 0.5), 3)
        ink.text(text, TAB, x + 46, y, mix(color, WHITE, 0.8), "hero")


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
