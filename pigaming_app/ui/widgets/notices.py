"""Overlays on any scene: timed notices and the frame meter (F3)."""

from collections import deque

import pygame

from pigaming_app.ui.draw import BODY, FOCUS, ICE, font
from pigaming_app.ui.draw.text import fit_size
from pigaming_app.ui.widgets.caption import caption

STAY = 5.0  # seconds
Y = 1040  # px, below the row of prompts
ROOM = 1640  # px
EVERY = 0.25  # seconds between two readings of the frame meter


class Notices:
    """A queue of sentences, shown one at a time."""

    def __init__(self) -> None:
        self.waiting: deque[str] = deque()
        self.age = 0.0

    def say(self, sentence: str) -> None:
        """Queue a sentence, unless it is queued already."""
        if sentence not in self.waiting:
            self.waiting.append(sentence)

    def draw(self, screen: pygame.Surface, seconds: float) -> None:
        """Draw the current sentence, `seconds` after the previous frame."""
        if not self.waiting:
            return
        said = self.waiting[0]
        caption(said, FOCUS, ICE, fit_size(said, BODY, ROOM, "body")).draw(screen, 960, Y)
        self.age += seconds
        if self.age > STAY:
            self.waiting.popleft()
            self.age = 0.0


class FrameMeter:
    """Frame rate, and the longest update and draw times since the last reading."""

    def __init__(self) -> None:
        self.shown, self.fps = False, 0.0
        self._age = self._moved = self._painted = 0.0
        self._text: pygame.Surface | None = None

    def note(self, seconds: float, moved: float, painted: float) -> None:
        """Record one frame; all times in seconds."""
        self._age += seconds
        self._moved, self._painted = max(self._moved, moved), max(self._painted, painted)
        if self._age >= EVERY:
            said = f"{self.fps:3.0f} fps   move {1e3 * self._moved:4.1f} ms   paint {1e3 * self._painted:4.1f} ms"
            self._text = font("head", 28).render(said, True, ICE, (0, 0, 0)) if self.shown else None
            self._age = self._moved = self._painted = 0.0

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the last reading, if enabled."""
        if self.shown and self._text:
            screen.blit(self._text, (12, 1046))
