"""The sign of an AI on cards and in rows: its icon, and the stars of its level, if it is one."""

from pigaming_app.ai.registry import level_of
from pigaming_app.scenes.flow.brain_names import LIT, lit_stars
from pigaming_app.ui.draw import WHITE, Color, GlowCanvas, cut_box, icon, mix, text_width

TAB = 30  # px, type size of the stars on a card's outline


def ai_tab(ink: GlowCanvas, brain: str, x: float, y: float, color: Color) -> None:
    """The sign on the upper line of a card, which it interrupts; x: its left edge. Nothing without a brain."""
    if brain:
        stars = lit_stars(brain)
        w = text_width(stars, TAB, "hero") if stars else 0.0
        ink.solid(cut_box(x, y - 18, 44 + w + (6 if stars else 0), 34, 4))
        icon(ink, "ai", x + 22, y, 17, mix(color, WHITE, 0.5), 3)
        ink.text(stars, TAB, x + 44, y, color, "hero")


def ai_mark(ink: GlowCanvas, brain: str, x: float, y: float, color: Color, r: int = 15) -> None:
    """The sign round (x, y): the icon of `r` px; under that of a level its number and a star."""
    level = level_of(brain)
    icon(ink, "ai", x, y - (0.9 * r if level else 0), r, color, 3)
    if level:
        ink.text(f"{level}{LIT}", 2 * r, x, y + 1.25 * r, color, "head", "c")


def ai_of(driver: str) -> str:
    """The AI on a seat, by its driver; empty: a person, or nobody."""
    return "" if driver in ("human", "off") else driver
