"""Layout that keeps page blocks off the lit discs on a mat with robots: blocks are moved and, if necessary, shrunk.

The discs light the robots' markers wherever the robots stand; text below them would be unreadable.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pygame

from pigaming_app.ui.draw import ADD, Point

Circle = tuple[float, float, float]  # x, y, radius, canvas px
ROOM = pygame.Rect(40, 190, 1840, 850)  # area for blocks, below the heading
SCALES = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4)
GRID = 20  # px, spacing of candidate positions
EVERY = 0.5  # s between two layout checks


@dataclass(frozen=True)
class PlacedBlock:
    """A block of the page: its source area on the sheet (`home`) and its placement on the canvas."""

    home: pygame.Rect
    at: tuple[int, int]
    scale: float

    @property
    def box(self) -> pygame.Rect:
        """The occupied area on the canvas."""
        return pygame.Rect(*self.at, round(self.home.w * self.scale), round(self.home.h * self.scale))


class BlockLayout:
    """Keeps the blocks of a page off the discs. A block stays put until a disc reaches it."""

    def __init__(self) -> None:
        self.placed: list[PlacedBlock] = []
        self.age = 0.0

    def update(self, seconds: float, homes: Sequence[pygame.Rect], discs: Sequence[Circle]) -> None:
        """Re-arrange if necessary. `homes`: the blocks in page coordinates."""
        self.age += seconds
        if [block.home for block in self.placed] == list(homes) and self.age < EVERY:
            return
        self.age = 0.0
        better = arrange(homes, discs)
        same = [block.home for block in self.placed] == list(homes)
        if not same or hit(self.placed, discs) or better[0].scale > self.placed[0].scale or not discs:
            self.placed = better

    def draw(self, screen: pygame.Surface, sheet: pygame.Surface) -> None:
        """Blit the blocks from their home positions on `sheet` to the screen, additively."""
        for block in self.placed:
            image = sheet.subsurface(block.home.clip(sheet.get_rect()))
            if block.scale < 1.0:
                image = pygame.transform.smoothscale(image, block.box.size)
            screen.blit(image, block.at, special_flags=ADD)

    def back(self, at: Point) -> Point:
        """Canvas to sheet coordinates; a point outside all blocks maps to (-1, -1)."""
        for block in self.placed:
            if block.box.collidepoint(at):
                return tuple(block.home.topleft[i] + (at[i] - block.at[i]) / block.scale for i in (0, 1))  # type: ignore[return-value]
        return -1.0, -1.0


def arrange(homes: Sequence[pygame.Rect], discs: Sequence[Circle]) -> list[PlacedBlock]:
    """Place the blocks without overlap with discs and each other, as large as possible and near their homes; at home if
    nothing fits.
    """
    for scale in SCALES:
        placed: list[PlacedBlock] = []
        for home in homes:
            at = nearest(home, scale, discs, [block.box for block in placed])
            if at is None:
                break
            placed.append(PlacedBlock(home, at, scale))
        if len(placed) == len(homes):
            return placed
    return [PlacedBlock(home, home.topleft, 1.0) for home in homes]


def nearest(
    home: pygame.Rect, scale: float, discs: Sequence[Circle], taken: Sequence[pygame.Rect]
) -> tuple[int, int] | None:
    """Top left of the free position for a block nearest to its home; None if there is none."""
    w, h = round(home.w * scale), round(home.h * scale)
    if w > ROOM.w or h > ROOM.h:
        return None
    dx, dy = round(home.w - w) // 2, round(home.h - h) // 2
    left = np.append(np.arange(ROOM.left, ROOM.right - w + 1, GRID), min(max(home.x + dx, ROOM.left), ROOM.right - w))
    top = np.append(np.arange(ROOM.top, ROOM.bottom - h + 1, GRID), min(max(home.y + dy, ROOM.top), ROOM.bottom - h))
    x, y = np.meshgrid(left, top)
    free = np.ones(x.shape, bool)
    for cx, cy, r in discs:
        across = np.maximum(0.0, np.maximum(x - cx, cx - x - w))
        down = np.maximum(0.0, np.maximum(y - cy, cy - y - h))
        free &= np.hypot(across, down) > r
    for box in taken:
        free &= (x >= box.right) | (x + w <= box.left) | (y >= box.bottom) | (y + h <= box.top)
    if not free.any():
        return None
    away = np.where(free, np.hypot(x - home.x - dx, y - home.y - dy), np.inf)
    best = np.unravel_index(away.argmin(), away.shape)
    return int(x[best]), int(y[best])


def hit(placed: Sequence[PlacedBlock], discs: Sequence[Circle]) -> bool:
    """True if a disc reaches a block."""
    return any(near(block.box, disc) for block in placed for disc in discs)


def near(box: pygame.Rect, disc: Circle) -> bool:
    """True if a disc reaches a box."""
    x, y, r = disc
    across, down = max(0.0, box.left - x, x - box.right), max(0.0, box.top - y, y - box.bottom)
    return bool(across * across + down * down <= r * r)
