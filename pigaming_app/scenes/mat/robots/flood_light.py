"""Uniform grey floodlight over the mat while a robot is searched for: in a dark room nothing else makes markers
visible.

A disc can only be projected below a robot with a known pose, and hard edges of light would hide the markers of the
others. Meanwhile only a line of black text is shown, above the arena.
"""

from collections.abc import Sequence

import pygame

from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.mat.session import session_if_any
from pigaming_app.ui.draw import BODY
from pigaming_app.ui.draw.layers import text
from pigaming_app.ui.i18n import Words

LIGHT = 128  # grey level: bright enough for markers in the dark, without dazzling
UNSEEN = 1.0  # s without a sighting after which a robot is searched for again
FADE = 0.4  # s, fade between grey and the page
TITLE_Y, LINE_Y = 38, 98  # px, above the arena


class FloodLight:
    """Fading floodlight. Call `update` every frame. Over a printed floor there is no projector: it stays off."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self.level = 0.0 if self._printed else 1.0  # 0..1

    @property
    def full(self) -> bool:
        """True at full grey."""
        return self.level >= 1.0

    def update(self, seconds: float, missing: bool) -> None:
        """Fade in while a robot is missing, out once all are seen."""
        change = seconds / FADE if missing and not self._printed else -seconds / FADE
        self.level = min(1.0, max(0.0, self.level + change))

    @property
    def _printed(self) -> bool:
        session = session_if_any(self._context)
        return session is not None and session.printed

    def draw(self, screen: pygame.Surface, title: str, line: str = "") -> None:
        """Draw the light over a page, and the texts at full grey."""
        if self.level <= 0.0:
            return
        if not self.full:
            veil = pygame.Surface(screen.get_size())
            veil.fill((LIGHT,) * 3)
            veil.set_alpha(round(255 * self.level))
            screen.blit(veil, (0, 0))
            return
        screen.fill((LIGHT,) * 3)
        for caption, size, y in ((title, BODY, TITLE_Y), (line, 34, LINE_Y)):
            if caption:
                dark_text(screen, caption, size, y)


def dark_text(screen: pygame.Surface, caption: str, size: int, y: int) -> None:
    """Draw black text by subtraction."""
    lit = text(caption, size, (LIGHT,) * 3, "body", "c", 1760)
    screen.blit(lit.image, (960 + lit.at[0], y + lit.at[1]), special_flags=pygame.BLEND_RGB_SUB)


def hint_line(labels: Sequence[tuple[str, str]]) -> str:
    """Buttons and their actions (`Prompts.labels`) in one line of text."""
    return "   ·   ".join(f"{label}: {action}" for label, action in labels)


def looking(words: Words, missing: Sequence[int]) -> str:
    """Names the robots being searched for, with advice."""
    return words("mat.looking", robots=", ".join(words("mat.robot", robot=robot + 1) for robot in missing))
