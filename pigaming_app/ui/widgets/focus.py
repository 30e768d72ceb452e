"""One focus for pad, keyboard and mouse: which spot of a page is meant, shown by four bright corners.

Directions go to the nearest spot that way, and from the last one round to the first. The mouse focuses what it points
at. The corners glide to a new spot in 120 ms and breathe once a second.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import pygame

from pigaming_app.ui.draw import BOLD, FOCUS, LINE, Color, GlowCanvas
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent

GLIDE = 0.12  # seconds from one spot to the next
ACROSS = 3.0  # a pixel off the line counts as so many along it
SMALL = 150  # px; lower spots have small corners
REACH = 84  # px that the picture of a corner covers on each side

WAYS = {Button.LEFT: (-1, 0), Button.RIGHT: (1, 0), Button.UP: (0, -1), Button.DOWN: (0, 1)}


@dataclass(frozen=True)
class FocusSpot:
    """Something on a page that can be chosen: its name and where it is, px of the canvas."""

    name: str
    rect: pygame.Rect


class Focus:
    """The spots of a page, one of which is meant. `name`: the one to begin with; else the first."""

    def __init__(self, spots: Sequence[FocusSpot], name: str | None = None) -> None:
        self.spots = list(spots)
        self.index = self._index(name)
        self._from = self.spot.rect
        self._age = GLIDE
        self._clock = 0.0

    @property
    def spot(self) -> FocusSpot:
        """The spot that is meant."""
        return self.spots[self.index]

    @property
    def name(self) -> str:
        """The name of the spot that is meant."""
        return self.spot.name

    def rect(self, name: str) -> pygame.Rect:
        """Where the spot of that name is."""
        return self.spots[self._index(name)].rect

    def on(self, event: InputEvent) -> bool:
        """Go where a press leads; true if that is another spot."""
        if event.button in WAYS:
            return self.go(self._next(event))
        return event.button in (Button.POINT, Button.CLICK) and self.go(self.under(event) or self.name)

    def chosen(self, event: InputEvent) -> str | None:
        """The spot that a press accepts: FIRE and START the one in focus, a click the one that it hits."""
        if event.button in (Button.FIRE, Button.START):
            return self.name
        return self.under(event) if event.button is Button.CLICK else None

    def under(self, event: InputEvent) -> str | None:
        """The spot that the mouse points at."""
        at = event.at
        return next((spot.name for spot in self.spots if at and spot.rect.collidepoint(at)), None)

    def go(self, name: str) -> bool:
        """Mean that spot; true if it was another one."""
        if name == self.name:
            return False
        self._from, self.index, self._age = self.box, self._index(name), 0.0
        return True

    def place(self, spots: Sequence[FocusSpot]) -> None:
        """The spots are elsewhere, or others; the one that is meant stays so if it is still there."""
        name, self.spots = self.name, list(spots)
        self.index = self._index(name)
        self._age = GLIDE

    def update(self, seconds: float) -> None:
        """Let the glide go on."""
        self._clock += seconds
        self._age = min(GLIDE, self._age + seconds)

    @property
    def box(self) -> pygame.Rect:
        """Where the focus is shown now."""
        left = (1.0 - self._age / GLIDE) ** 3
        pairs = zip(self._from, self.spot.rect, strict=True)
        return pygame.Rect(*(round(new + (old - new) * left) for old, new in pairs))

    def draw(self, screen: pygame.Surface, color: Color = FOCUS) -> None:
        """Paint the four corners."""
        breath = round(2.0 + 2.0 * math.sin(math.tau * self._clock))
        box = self.box.inflate(2 * breath, 2 * breath)
        small = self.spot.rect.h < SMALL
        for across, x in ((1, box.left), (-1, box.right)):
            for down, y in ((1, box.top), (-1, box.bottom)):
                corner(across, down, small, color).draw(screen, x, y)

    def _index(self, name: str | None) -> int:
        return next((i for i, spot in enumerate(self.spots) if spot.name == name), 0)

    def _next(self, event: InputEvent) -> str:
        """The nearest spot in a direction; past the last, the farthest the other way, unless the key is held."""
        way, here = WAYS[event.button], self.spot.rect
        ahead = [spot for spot in self.spots if _beyond(here, spot.rect, way)]
        if ahead:
            return min(ahead, key=lambda spot: _distance(here, spot.rect, way)).name
        row = [spot for spot in self.spots if _gap(here, spot.rect, way) == 0]
        return self.name if event.repeat else min(row, key=lambda spot: _along(here, spot.rect, way)).name


@cached
def corner(across: int, down: int, small: bool, color: Color) -> LitImage:
    """A corner of the focus at (0, 0); `across` and `down` are 1 or -1: on which side the spot lies."""
    arm, c, width = (12, 12, LINE) if small else (48, 20, BOLD)
    ink = GlowCanvas(2 * REACH, 2 * REACH).to(REACH, REACH)
    points = [(0, down * (c + arm)), (0, down * c), (across * c, 0), (across * (c + arm), 0)]
    return LitImage(ink.neon(points, color, width).lit(1.0), (-REACH, -REACH))


def _beyond(here: pygame.Rect, there: pygame.Rect, way: tuple[int, int]) -> bool:
    """Whether a spot lies that way: past the edge of this one, not merely a little further."""
    edges = {(1, 0): there.left - here.right, (-1, 0): here.left - there.right, (0, 1): there.top - here.bottom}
    return edges.get(way, here.top - there.bottom) >= -1


def _along(here: pygame.Rect, there: pygame.Rect, way: tuple[int, int]) -> int:
    """How far the middle of a spot lies ahead, px."""
    return (there.centerx - here.centerx) * way[0] + (there.centery - here.centery) * way[1]


def _distance(here: pygame.Rect, there: pygame.Rect, way: tuple[int, int]) -> float:
    aside = abs(there.centerx - here.centerx) if way[1] else abs(there.centery - here.centery)
    return _along(here, there, way) + ACROSS * _gap(here, there, way) + 0.01 * aside


def _gap(here: pygame.Rect, there: pygame.Rect, way: tuple[int, int]) -> int:
    """How far two spots lie apart, seen along the way, px; 0 where they overlap."""
    if way[1]:
        return max(0, there.left - here.right, here.left - there.right)
    return max(0, there.top - here.bottom, here.top - there.bottom)
