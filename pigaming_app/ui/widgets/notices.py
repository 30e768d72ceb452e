"""What is painted over any scene: a sentence that stays for a while, and the numbers that F3 shows."""

from collections import deque

import pygame

from pigaming_app.ui.draw import BODY, FOCUS, ICE, font
from pigaming_app.ui.draw.text import fit_size
from pigaming_app.ui.widgets.caption import caption

STAY = 5.0  # seconds
Y = 1040  # px, below the row of hints
ROOM = 1640  # px
EVERY = 0.25  # seconds between two readings of the gauge


class Notices:
    """One sentence after the other."""

    def __init__(self) -> None:
        self.waiting: deque[str] = deque()
        self.age = 0.0

    def say(self, sentence: str) -> None:
        """Show a sentence, after those that wait already; the same one waits only once."""
        if sentence not in self.waiting:
            self.waiting.append(sentence)

    def draw(self, screen: pygame.Surface, seconds: float) -> None:
        """Paint the sentence of the moment, `seconds` after the frame before."""
        if not self.waiting:
            return
        said = self.waiting[0]
        caption(said, FOCUS, ICE, fit_size(said, BODY, ROOM, "body")).draw(screen, 960, Y)
        self.age += seconds
        if self.age > STAY:
            self.waiting.popleft()
            self.age = 0.0


class FrameMeter:
    """Frames a second, and the longest that scenes took to move and to paint since the last reading, ms."""

    def __init__(self) -> None:
        self.shown, self.fps = False, 0.0
        self._age = self._moved = self._painted = 0.0
        self._text: pygame.Surface | None = None

    def note(self, seconds: float, moved: float, painted: float) -> None:
        """Take down one frame; all in seconds."""
        self._age += seconds
        self._moved, self._painted = max(self._moved, moved), max(self._painted, painted)
        if self._age >= EVERY:
            said = f"{self.fps:3.0f} fps   move {1e3 * self._moved:4.1f} ms   paint {1e3 * self._painted:4.1f} ms"
            self._text = font("head", 28).render(said, True, ICE, (0, 0, 0)) if self.shown else None
            self._age = self._moved = self._painted = 0.0

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the last reading, if it is wished for."""
        if self.shown and self._text:
            screen.blit(self._text, (12, 1046))
