"""Three, two, one, go: the big signs over an arena, before a match and after every interruption."""

import math
from functools import cache

import pygame

from pigaming_app.scenes.ink import BOLD, FOCUS, ICE, Color, Ink
from pigaming_app.scenes.pane import Lit, word

CENTRE = (960, 590)  # of the arena, on the canvas
GO = 0.7  # seconds for which GO! is shown
POP = 0.16  # seconds in which a sign shrinks to its size
POPS = 5  # sizes kept of each sign
HUGE = 300


class Countdown:
    """Locks motion while it runs. `step`: seconds for each number; `lead`: seconds before the first."""

    def __init__(self, step: float = 1.0, lead: float = 0.0) -> None:
        self.step, self.left, self.since = step, 3 * step + lead, 0.0
        self.number = 4

    @property
    def locked(self) -> bool:
        """Nothing may move yet."""
        return self.left > 0.0

    @property
    def shown(self) -> bool:
        """There is still a sign to draw."""
        return self.locked or self.since < GO

    def update(self, seconds: float) -> str | None:
        """Let time pass; answers the name of the sound that is due."""
        if not self.locked:
            self.since += seconds
            return None
        self.left -= seconds
        if not self.locked:
            self.since = 0.0
            return "go"
        number = math.ceil(self.left / self.step)
        self.since += seconds
        if number < self.number:
            self.number, self.since = number, 0.0
            return "count" if number <= 3 else None
        return None

    def draw(self, screen: pygame.Surface, go: str) -> None:
        """Paint the number, or `go`."""
        pop = min(POPS - 1, int(self.since / POP * POPS))
        if not self.locked:
            if self.since < GO:
                level = 8 if self.since < GO / 2 else math.ceil(16 * (1 - self.since / GO))
                popped(go, FOCUS, pop, level).draw(screen, *CENTRE)
        elif self.number <= 3:
            popped(str(self.number), ICE, pop).draw(screen, *CENTRE)
            arcs(self.number).draw(screen, *CENTRE)


@cache
def popped(text: str, color: Color, pop: int, level: int = 8) -> Lit:
    """A huge word centred on (0, 0), the larger the smaller `pop`, 0..POPS - 1, is."""
    if pop == POPS - 1:
        return word(text, HUGE, color, "hero", 0.7, level)
    whole = popped(text, color, POPS - 1, level)
    scale = 1.0 + 0.7 * (1 - (pop + 1) / POPS) ** 2
    image = pygame.transform.smoothscale_by(whole.image, scale)
    return Lit(image, (round(whole.at[0] * scale), round(whole.at[1] * scale)))


@cache
def arcs(count: int) -> Lit:
    """Three arcs round a number, of which `count` are still lit."""
    half = 270
    ink = Ink(2 * half, 2 * half).to(half, half)
    for i in range(3):
        start = -math.pi / 2 + i * math.tau / 3 + 0.14
        lit = i < count
        ink.arc(0, 0, 215, start, start + math.tau / 3 - 0.28, FOCUS if lit else (58, 54, 16), BOLD if lit else 4)
    return Lit(ink.lit(1.0), (-half, -half))
