"""Focus for pad, keyboard and mouse: one spot of a page, marked by four bright corners.

Directions move to the nearest spot that way and wrap round at the end. The mouse focuses the spot under it. The corners
glide to a new spot in 120 ms and pulse once a second.
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
OFF_AXIS_COST = 3.0  # cost of a pixel off the line, in pixels along it
SMALL = 150  # px; spots less high have small corners
REACH = 84  # px of a corner's image on each side

DIRECTIONS = {Button.LEFT: (-1, 0), Button.RIGHT: (1, 0), Button.UP: (0, -1), Button.DOWN: (0, 1)}


@dataclass(frozen=True)
class FocusSpot:
    """A selectable element of a page: its name and rectangle, px on the canvas."""

    name: str
    rect: pygame.Rect


class Focus:
    """The spots of a page, one of them focused. `name`: the initial one, else the first."""

    def __init__(self, spots: Sequence[FocusSpot], name: str | None = None) -> None:
        self.spots = list(spots)
        self.index = self._index(name)
        self._from = self.spot.rect
        self._age = GLIDE
        self._clock = 0.0

    @property
    def spot(self) -> FocusSpot:
        """The focused spot."""
        return self.spots[self.index]

    @property
    def name(self) -> str:
        """The name of the focused spot."""
        return self.spot.name

    def rect(self, name: str) -> pygame.Rect:
        return self.spots[self._index(name)].rect

    def handle(self, event: InputEvent) -> bool:
        """Move the focus by an event; true if it changed."""
        if event.button in DIRECTIONS:
            return self.move_to(self._next(event))
        return event.button in (Button.POINT, Button.CLICK) and self.move_to(self.spot_at(event) or self.name)

    def activated(self, event: InputEvent) -> str | None:
        """The spot activated by an event: by FIRE and START the focused one, by a click the one it hits."""
        if event.button in (Button.FIRE, Button.START):
            return self.name
        return self.spot_at(event) if event.button is Button.CLICK else None

    def spot_at(self, event: InputEvent) -> str | None:
        """The spot under the mouse."""
        at = event.at
        return next((spot.name for spot in self.spots if at and spot.rect.collidepoint(at)), None)

    def move_to(self, name: str) -> bool:
        """Focus a spot; true if it changed."""
        if name == self.name:
            return False
        self._from, self.index, self._age = self.box, self._index(name), 0.0
        return True

    def set_spots(self, spots: Sequence[FocusSpot]) -> None:
        """Replace the spots; the focus stays on its spot if that still exists."""
        name, self.spots = self.name, list(spots)
        self.index = self._index(name)
        self._age = GLIDE

    def update(self, seconds: float) -> None:
        """Advance the animation."""
        self._clock += seconds
        self._age = min(GLIDE, self._age + seconds)

    @property
    def box(self) -> pygame.Rect:
        """The currently drawn rectangle."""
        left = (1.0 - self._age / GLIDE) ** 3
        pairs = zip(self._from, self.spot.rect, strict=True)
        return pygame.Rect(*(round(new + (old - new) * left) for old, new in pairs))

    def draw(self, screen: pygame.Surface, color: Color = FOCUS) -> None:
        """Draw the four corners."""
        pulse = round(2.0 + 2.0 * math.sin(math.tau * self._clock))
        box = self.box.inflate(2 * pulse, 2 * pulse)
        small = self.spot.rect.h < SMALL
        for across, x in ((1, box.left), (-1, box.right)):
            for down, y in ((1, box.top), (-1, box.bottom)):
                corner(across, down, small, color).draw(screen, x, y)

    def _index(self, name: str | None) -> int:
        return next((i for i, spot in enumerate(self.spots) if spot.name == name), 0)

    def _next(self, event: InputEvent) -> str:
        """The nearest spot in a direction; past the last, wrap round unless the key repeats."""
        direction, here = DIRECTIONS[event.button], self.spot.rect
        ahead = [spot for spot in self.spots if _beyond(here, spot.rect, direction)]
        if ahead:
            return min(ahead, key=lambda spot: _distance(here, spot.rect, direction)).name
        row = [spot for spot in self.spots if _gap(here, spot.rect, direction) == 0]
        return self.name if event.repeat else min(row, key=lambda spot: _along(here, spot.rect, direction)).name


@cached
def corner(across: int, down: int, small: bool, color: Color) -> LitImage:
    """A focus corner at (0, 0); `across` and `down` are 1 or -1, towards the inside of the spot."""
    arm, c, width = (12, 12, LINE) if small else (48, 20, BOLD)
    ink = GlowCanvas(2 * REACH, 2 * REACH).set_transform(REACH, REACH)
    points = [(0, down * (c + arm)), (0, down * c), (across * c, 0), (across * (c + arm), 0)]
    return LitImage(ink.neon(points, color, width).lit(1.0), (-REACH, -REACH))


def _beyond(here: pygame.Rect, there: pygame.Rect, direction: tuple[int, int]) -> bool:
    """True if a spot lies beyond this one's edge in a direction, not merely further that way."""
    edges = {(1, 0): there.left - here.right, (-1, 0): here.left - there.right, (0, 1): there.top - here.bottom}
    return edges.get(direction, here.top - there.bottom) >= -1


def _along(here: pygame.Rect, there: pygame.Rect, direction: tuple[int, int]) -> int:
    """Distance between the centres along the direction, px."""
    return (there.centerx - here.centerx) * direction[0] + (there.centery - here.centery) * direction[1]


def _distance(here: pygame.Rect, there: pygame.Rect, direction: tuple[int, int]) -> float:
    aside = abs(there.centerx - here.centerx) if direction[1] else abs(there.centery - here.centery)
    return _along(here, there, direction) + OFF_AXIS_COST * _gap(here, there, direction) + 0.01 * aside


def _gap(here: pygame.Rect, there: pygame.Rect, direction: tuple[int, int]) -> int:
    """Gap between two spots across the direction, px; 0 if they overlap."""
    if direction[1]:
        return max(0, there.left - here.right, here.left - there.right)
    return max(0, there.top - here.bottom, here.top - there.bottom)
