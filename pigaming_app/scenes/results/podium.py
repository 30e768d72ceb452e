"""A podium: the robots of the first three places on their steps, revealed from the third to the first."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import pygame

from pigaming_app.scenes.views.sprites.robot import seat_robot
from pigaming_app.ui.draw import BOLD, FOCUS, HERO, ICE, LINE, PLAYERS, STEEL, Color, GlowCanvas, cut_box, icon
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import blit_sprite

STEP_W, APART = 250, 24  # px
HEIGHTS = (320, 230, 160)  # px, of the steps of places 1 to 3
ORDER = (1, 0, 2)  # steps from left to right, by index
REVEALS = (1.7, 1.0, 0.3)  # s, from which each step rises
RISE = 0.35  # s
FIRST = REVEALS[0]  # s, when the winner appears
SCALE, SCALE_SHARED = 1.5, 1.1  # of one robot on a step, of several
ABOVE = 96  # px from a step to the middle of its robots
UP = -math.pi / 2


@dataclass(frozen=True)
class Stand:
    """One step: its place and the robots on it."""

    place: int
    seats: tuple[int, ...]


def stands(places: Sequence[tuple[int, int, int]]) -> list[Stand]:
    """The steps for (place, team, seat) of every robot: a team shares a step, and so do teams that are level."""
    found: dict[int, list[tuple[int, int]]] = {}
    for place, team, seat in places:
        found.setdefault(place, []).append((team, seat))
    steps, ahead = [], 0
    for _, robots in sorted(found.items()):
        steps.append(Stand(1 + ahead, tuple(sorted(seat for _, seat in robots))))
        ahead += len({team for team, _ in robots})
    return [step for step in steps if step.place <= len(HEIGHTS)]


class Podium:
    """The podium with its foot at y px, centred at x px. `age` is the time since the page was opened, s."""

    def __init__(self, x: float, y: float, stands: Sequence[Stand]) -> None:
        self.x, self.y, self.stands = x, y, list(stands)

    def sounds(self) -> list[tuple[float, str, int | None]]:
        """A note for each step but the first: (seconds, name, player)."""
        return sorted((REVEALS[i], "move", self.stands[i].seats[0]) for i in range(1, len(self.stands)))

    def prewarm(self) -> Steps[None]:
        """Render every sprite."""
        for i, stand in enumerate(self.stands):
            base(stand.place, HEIGHTS[i], self._color(stand))
            yield
            for seat in stand.seats:
                seat_robot(seat, UP, self._scale(stand))
                yield
        crown()
        yield

    def draw(self, screen: pygame.Surface, age: float) -> None:
        """Draw the steps that have begun to rise."""
        for i, stand in enumerate(self.stands):
            share = min(1.0, (age - REVEALS[i]) / RISE)
            if share <= 0.0:
                continue
            high = HEIGHTS[i] * (1.0 - (1.0 - share) ** 2)
            x = self.x + (STEP_W + APART) * (ORDER.index(i) - 1)
            whole = base(stand.place, HEIGHTS[i], self._color(stand))
            screen.set_clip(pygame.Rect(0, 0, 1920, round(self.y) + 40))
            whole.draw(screen, x - STEP_W / 2, self.y - high)
            screen.set_clip(None)
            hop = 10 * abs(math.sin((age - FIRST) * 5)) if i == 0 and share == 1.0 else 0.0
            self._robots(screen, stand, x, self.y - high - ABOVE - hop)
            if i == 0 and share == 1.0:
                crown().draw(screen, x, self.y - high - ABOVE - 128)

    def _robots(self, screen: pygame.Surface, stand: Stand, x: float, y: float) -> None:
        pitch = min(130.0, STEP_W / len(stand.seats))
        for k, seat in enumerate(stand.seats):
            sprite = seat_robot(seat, UP, self._scale(stand))
            blit_sprite(screen, sprite, x + pitch * (k - (len(stand.seats) - 1) / 2), y)

    def _scale(self, stand: Stand) -> float:
        return SCALE if len(stand.seats) == 1 else SCALE_SHARED

    def _color(self, stand: Stand) -> Color:
        return PLAYERS[stand.seats[0]]


@cached
@resumable
def base(place: int, high: int, color: Color) -> Steps[LitImage]:
    """A step with its place; top left at (0, 0)."""
    layer = Layer(0, 0, STEP_W, high)
    layer.glow.solid(cut_box(0, 0, STEP_W, high, 20))
    layer.glow.line(cut_box(0, 0, STEP_W, high, 20), color, BOLD if place == 1 else LINE, True)
    layer.glow.line([(40, high - 28), (STEP_W - 40, high - 28)], STEEL, 4)
    size = min(HERO, high - 84)
    layer.canvas.text(str(place), size, STEP_W / 2, (high - 20) / 2, ICE, "hero", "c")
    yield
    return (yield from layer.render_steps())


@cached
def crown() -> LitImage:
    """The crown over the winner, centred on (0, 0)."""
    ink = GlowCanvas(160, 140).set_transform(80, 70)
    icon(ink, "crown", 0, 0, 40, FOCUS, LINE)
    return LitImage(ink.lit(), (-80, -70))
