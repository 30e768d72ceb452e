"""A table of scores: place, initials and value of each row, revealed one after the other."""

from collections.abc import Sequence
from dataclasses import dataclass

import pygame

from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, LINE, MIST, STEEL, SUB, THIN, GlowCanvas, cut_box
from pigaming_app.ui.draw.layers import LitImage, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import sign

ROWS = 8
HEAD_Y, TOP, PITCH = 314, 352, 66  # px
HEIGHT = 24 + PITCH * ROWS  # px, height of a table
APART, WIPE = 0.05, 0.25  # s: delay from row to row, wipe of one row


@dataclass(frozen=True)
class BoardRow:
    """One row. `note`: before the value, in smaller type; `fresh`: new, highlighted."""

    initials: str
    value: str
    fresh: bool = False
    note: str = ""


@dataclass(frozen=True)
class ScoreBoard:
    """A table below its title. `column`: the name of the values; `empty`: shown in place of rows."""

    title: str
    rows: Sequence[BoardRow]
    empty: str
    column: str = ""

    def draw(self, screen: pygame.Surface, x: int, w: int, age: float) -> None:
        """Draw it `w` px wide from `x`, `age` s after it was opened."""
        room = w
        if self.column:
            name = text(self.column, BODY, MIST, "body", "r", w // 2)
            name.draw(screen, x + w - 24, HEAD_Y)
            room -= name.image.get_width()
        text(self.title, LABEL, ICE, "head", "l", room).draw(screen, x, HEAD_Y)
        frame(w).draw(screen, x, TOP)
        if not self.rows:
            text(self.empty, LABEL, MIST, "head", "c", w - 96).draw(screen, x + w / 2, TOP + HEIGHT / 2)
        for i, row in enumerate(self.rows[:ROWS]):
            share = (age - APART * i) / WIPE
            if share > 0.0:
                draw_row(screen, row, i, x, w, 1 - (1 - min(1.0, share)) ** 2)


def draw_row(screen: pygame.Surface, row: BoardRow, i: int, x: int, w: int, share: float) -> None:
    """Draw the i-th row, clipped to `share` of the width."""
    y = TOP + 12 + PITCH * i + PITCH / 2
    color = FOCUS if row.fresh else ICE if i == 0 else MIST
    before = screen.get_clip()
    screen.set_clip(pygame.Rect(x, TOP, round(w * share), HEIGHT))
    text(str(i + 1), LABEL, color, "head", "r").draw(screen, x + 84, y)
    text(row.initials, SUB, color, "hero", "l").draw(screen, x + 150, y)
    text(row.value, SUB, color, "hero", "r").draw(screen, x + w - 48, y)
    if row.note:
        text(row.note, LABEL, color, "head", "r").draw(screen, x + w - 210, y)
    if row.fresh:
        sign("left", 20, FOCUS, LINE).draw(screen, x + 376, y)
    screen.set_clip(before)


@cached
def frame(w: int) -> LitImage:
    """Outline of a table; top left at (0, 0)."""
    canvas = GlowCanvas(w + 8, HEIGHT + 8).set_transform(4, 4)
    return LitImage(canvas.line(cut_box(0, 0, w, HEIGHT, 20), STEEL, THIN, True).plain(), (-4, -4))
