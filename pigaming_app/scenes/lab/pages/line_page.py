"""The reward as a line of code, typed or chosen letter by letter, and the names that it may use."""

from collections.abc import Callable

import pygame

from pigaming_app.ai.reward_line import LONGEST
from pigaming_app.ai.reward_quantities import QUANTITIES
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.pages.text_page import LINE_BOX, TextPage
from pigaming_app.ui.draw import BODY, FOCUS, MIST, text_width
from pigaming_app.ui.draw.layers import text

LETTERS = "abcdefghijklmnopqrstuvwxyz0123456789.+-*/()<>=!, "
NAMES_Y, PITCH = 486, 76  # px: first row, from row to row
COLUMNS = ((LINE_BOX.left, 820), (1100, LINE_BOX.right))  # px, edges; the picker stands between them
GAP = 24  # px between a name and its meaning


class LinePage(TextPage):
    """`accept`: rewards by a line, and returns the sentence why not, if it is none."""

    def __init__(self, context: Context, before: str, accept: Callable[[str], str]) -> None:
        super().__init__(context, context.words("lab.line_title"), before, LONGEST, accept, letters=LETTERS)

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the names, too, with what they count."""
        super().paint(screen)
        rows = len(QUANTITIES) // 2
        for i, name in enumerate(QUANTITIES):
            (x, right), y = COLUMNS[i // rows], NAMES_Y + PITCH * (i % rows)
            text(name, BODY, FOCUS, "body", "l").draw(screen, x, y)
            x += round(text_width(name, BODY, "body")) + GAP
            text(self.context.words(f"lab.{name}_means"), BODY, MIST, "body", "l", right - x).draw(screen, x, y)
