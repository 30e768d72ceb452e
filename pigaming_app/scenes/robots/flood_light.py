"""Even grey light over the whole mat while a robot is looked for: in a dark room markers are seen by nothing else.

A disc can only be projected under a robot whose place is known; hard edges of light would hide the markers of the
others. So nothing else is shown meanwhile but a line of black text above the arena.
"""

from collections.abc import Sequence

import pygame

from pigaming_app.ui.draw import BODY
from pigaming_app.ui.draw.text import text
from pigaming_app.ui.i18n import Words

LIGHT = 128  # grey level: bright enough for markers in the dark, and not dazzling
UNSEEN = 1.0  # s after which a robot that was seen is looked for again
FADE = 0.4  # s from grey to the page and back
TITLE_Y, LINE_Y = 38, 98  # px: above the arena


class FloodLight:
    """How much of the grey light is on. `update` in every frame."""

    def __init__(self) -> None:
        self.level = 1.0  # share

    @property
    def whole(self) -> bool:
        """Whether there is nothing but grey light."""
        return self.level >= 1.0

    def update(self, seconds: float, missing: bool) -> None:
        """Fade in while a robot is missing, and out once all are seen."""
        change = seconds / FADE
        self.level = min(1.0, self.level + change) if missing else max(0.0, self.level - change)

    def draw(self, screen: pygame.Surface, title: str, line: str = "") -> None:
        """Paint it over a page; the texts when it is whole."""
        if self.level <= 0.0:
            return
        if not self.whole:
            veil = pygame.Surface(screen.get_size())
            veil.fill((LIGHT,) * 3)
            veil.set_alpha(round(255 * self.level))
            screen.blit(veil, (0, 0))
            return
        screen.fill((LIGHT,) * 3)
        for said, size, y in ((title, BODY, TITLE_Y), (line, 34, LINE_Y)):
            if said:
                written(screen, said, size, y)


def written(screen: pygame.Surface, said: str, size: int, y: int) -> None:
    """Black text, taken out of the light."""
    lit = text(said, size, (LIGHT,) * 3, "body", "c", 1760)
    screen.blit(lit.image, (960 + lit.at[0], y + lit.at[1]), special_flags=pygame.BLEND_RGB_SUB)


def looking(words: Words, missing: Sequence[int]) -> str:
    """Which robots are looked for, and what to do about it."""
    return words("mat.looking", robots=", ".join(words("mat.robot", robot=robot + 1) for robot in missing))
