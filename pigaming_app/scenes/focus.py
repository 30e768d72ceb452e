"""One focus model for pad, keyboard and mouse: spots on a page, one of which has four bright corners round it."""

from dataclasses import dataclass
from functools import cache

import pygame

from pigaming_app.scenes.ink import brackets
from pigaming_app.scenes.pane import Lit, Pane
from pigaming_app.scenes.press import Act, Press

SNAP = 0.12  # s in which the corners come to rest
WAYS = {Act.UP: (0, -1), Act.DOWN: (0, 1), Act.LEFT: (-1, 0), Act.RIGHT: (1, 0)}


@dataclass(frozen=True)
class Spot:
    """Something on a page that can be chosen: its name and where it is, px of the canvas."""

    name: str
    rect: pygame.Rect


class Focus:
    """Which spot is meant. `at`: the name of the one to begin with."""

    def __init__(self, spots: list[Spot], at: str | None = None) -> None:
        self.spots = spots
        self.index = next((i for i, spot in enumerate(spots) if spot.name == at), 0)
        self.snap = 0.0

    @property
    def name(self) -> str | None:
        """The name of the spot that has the focus; None on an empty page."""
        return self.spots[self.index].name if self.spots else None

    def on(self, press: Press) -> bool:
        """Move with a direction or the pointer; true if it moved."""
        before = self.index
        if press.act in WAYS:
            self.index = self._beside(*WAYS[press.act])
        elif press.at is not None:
            found = self._under(press.at)
            if found is not None:
                self.index = found
        if self.index != before:
            self.snap = SNAP
        return self.index != before

    def chosen(self, press: Press) -> str | None:
        """The name of the spot that this press chooses: FIRE or START the one in focus, CLICK the one under it."""
        if press.act in (Act.FIRE, Act.START):
            return self.name
        if press.act is Act.CLICK and press.at is not None and self._under(press.at) is not None:
            return self.name
        return None

    def update(self, seconds: float) -> None:
        """Let the corners come to rest."""
        self.snap = max(0.0, self.snap - seconds)

    def draw(self, screen: pygame.Surface) -> None:
        """The four corners; for a moment a little too far out."""
        if self.spots:
            rect = self.spots[self.index].rect
            corners(rect.w, rect.h, round(3 * self.snap / SNAP)).draw(screen, rect.x, rect.y)

    def _under(self, at: tuple[float, float]) -> int | None:
        return next((i for i, spot in enumerate(self.spots) if spot.rect.collidepoint(at)), None)

    def _beside(self, dx: int, dy: int) -> int:
        """The nearest spot in a direction; the same one where there is none."""
        here = self.spots[self.index].rect
        best, least = self.index, 1e9
        for i, spot in enumerate(self.spots):
            x, y = spot.rect.centerx - here.centerx, spot.rect.centery - here.centery
            ahead, aside = x * dx + y * dy, abs(x * dy) + abs(y * dx)
            apart = spot.rect.top >= here.bottom or spot.rect.bottom <= here.top if dy else True
            if ahead > 0 and apart and i != self.index and ahead + 2 * aside * (1 if dx else 0.5) < least:
                if dx and (spot.rect.top >= here.bottom or spot.rect.bottom <= here.top):
                    continue
                best, least = i, ahead + 2 * aside * (1 if dx else 0.5)
        return best


@cache
def corners(w: int, h: int, out: int) -> Lit:
    """Four corners round a box whose own corner is (0, 0), `out` steps of 6 px too far out."""
    pane = Pane(0, 0, w, h)
    small = min(w, h) < 150
    brackets(pane.hot, 0, 0, w, h, arm=18 if small else 48, c=12 if small else 20, width=6 if small else 9, out=6 * out)
    return pane.done()
