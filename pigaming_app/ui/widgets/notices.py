"""Overlays on any scene: timed notices and the frame meter (F3)."""

from collections import deque

import pygame

from pigaming_app.ui.draw import BODY, FOCUS, ICE, font
from pigaming_app.ui.draw.layers import fit_size
from pigaming_app.ui.widgets.caption import caption

STAY = 5.0  # seconds
Y = 1040  # px, below the row of prompts
MAX_WIDTH = 1640  # px
READING_PERIOD = 0.25  # seconds between two readings of the frame meter


class Notices:
    """A queue of sentences, shown one at a time."""

    def __init__(self) -> None:
        self.waiting: deque[str] = deque()
        self.age = 0.0

    def add(self, sentence: str) -> None:
        """Queue a sentence, unless it is queued already."""
        if sentence not in self.waiting:
            self.waiting.append(sentence)

    def draw(self, screen: pygame.Surface, seconds: float) -> None:
        """Draw the current sentence, `seconds` after the previous frame."""
        if not self.waiting:
            return
        sentence = self.waiting[0]
        caption(sentence, FOCUS, ICE, fit_size(sentence, BODY, MAX_WIDTH, "body")).draw(screen, 960, Y)
        self.age += seconds
        if self.age > STAY:
            self.waiting.popleft()
            self.age = 0.0


class FrameMeter:
    """Frame rate, and the longest update and draw times since the last reading."""

    def __init__(self) -> None:
        self.visible, self.fps = False, 0.0
        self._age = self._update = self._draw = 0.0
        self._text: pygame.Surface | None = None

    def note(self, seconds: float, update: float, draw: float) -> None:
        """Record one frame; all times in seconds."""
        self._age += seconds
        self._update, self._draw = max(self._update, update), max(self._draw, draw)
        if self._age >= READING_PERIOD:
            line = f"{self.fps:3.0f} fps   move {1e3 * self._update:4.1f} ms   paint {1e3 * self._draw:4.1f} ms"
            self._text = font("head", 28).render(line, True, ICE, (0, 0, 0)) if self.visible else None
            self._age = self._update = self._draw = 0.0

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the last reading, if enabled."""
        if self.visible and self._text:
            screen.blit(self._text, (12, 1046))
