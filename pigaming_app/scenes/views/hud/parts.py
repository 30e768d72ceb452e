"""HUD parts common to all games: baked panels, bars, numbers, the clock, and samples of them that are drawn ahead."""

from collections import deque
from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import Any

import pygame

from pigaming_app.scenes.views.background import HUD_HEIGHT, Background, Bit
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LABEL, TITLE, Color, GlowCanvas, cut_box, dim, readable
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.layers import fit_size, glyph, number_width, text
from pigaming_app.ui.draw.sprites import Sprite, faded
from pigaming_app.ui.draw.surface_cache import cached

Y, H, EDGE = 34, 92, 24  # px: top and height of the panels, margin around their sprites
PANEL_W = 316  # px, width of a panel
XS = {1: (492,), 2: (492, 1112), 3: (160, 492, 1112), 4: (160, 492, 1112, 1444)}  # px: left edges, by number of panels
CELL = 17.75  # px, pitch of the cells of a turbo bar
ALARM_SECONDS = 10
CLOCK = pygame.Rect(820, 0, 280, HUD_HEIGHT)


class HudParts:
    """HUD parts on a background; a part is baked when its content changes."""

    def __init__(self, background: Background) -> None:
        self.background = background
        self.shown: dict[Hashable, object] = {}

    def update(self, part: Hashable, content: object, bake: Callable[[], object]) -> None:
        """Call `bake` if a part's content changed, and again in the next frame if it raised Unfinished."""
        if self.shown.get(part) != content:
            bake()
            self.shown[part] = content

    def show(self, part: Hashable, content: object, x: int, w: int, bits: Callable[[], Iterable[Bit]]) -> None:
        """Bake a part's pieces over the full HUD height, from `x`, `w` px wide, if its content changed."""
        box = pygame.Rect(x, 0, w, HUD_HEIGHT)
        self.update(part, content, lambda: self.background.bake(box, [*bits()]))

    def countdown(self, state: Any, y: float) -> None:
        """Show the remaining time of a match; vertical centre of the digits at `y` px."""
        left = max(0, -(-(state.rules.ticks - state.tick) // HZ))
        text, color = f"{left // 60}:{left % 60:02}", ALARM if left <= ALARM_SECONDS else ICE
        self.show("clock", left, CLOCK.x, CLOCK.w, lambda: clock_bits(text, y, color))


def drawn(bits: Callable[..., Iterable[Bit]], *sample: object) -> Job:
    """A prewarm job that draws a sample, so that all its pieces are cached: `bits(*sample)`."""
    return lambda: deque(bits(*sample), maxlen=0)


def plate(w: float, h: float) -> GlowCanvas:
    """A canvas of w x h px with a margin of EDGE px."""
    return GlowCanvas(round(w) + 2 * EDGE, round(h) + 2 * EDGE).set_transform(EDGE, EDGE)


@cached
def pulse(color: Color, w: int, h: int = H, share: float = 0.24) -> tuple[Sprite, ...]:
    """Fade-out of the flash of a panel of w x h px, relative to its top left. `share`: of its brightness."""
    whole = Sprite(plate(w, h).fill(cut_box(0, 0, w, h), dim(color, share)).lit(0.8), -EDGE, -EDGE)
    return whole, *(faded(whole, share) for share in (0.8, 0.6, 0.4, 0.25, 0.1))


@cached
def turbo_cells(color: Color, w: int, high: int, lit: bool, glow: float = 0.5) -> pygame.Surface:
    """Cells of a turbo bar of `w` px, `high` px high, all lit or all dark."""
    ink = plate(w, high)
    for i in range(int(w / CELL + 0.01)):
        x = i * CELL
        ink.fill([(x + 3, 0), (x + 16, 0), (x + 13, high), (x, high)], color if lit else dim(color, 0.18))
    return ink.lit(glow) if lit else ink.plain()


def bar_bits(full: pygame.Surface, empty: pygame.Surface, at: tuple[int, int], way: float) -> list[Bit]:
    """A bar at `at` that is lit up to `way` px; `full` and `empty`: all of it, with a margin of EDGE px."""
    x, y, split, (w, h) = at[0] - EDGE, at[1] - EDGE, EDGE + round(way), full.get_size()
    return [(full, (x, y), (0, 0, split, h)), (empty, (x + split, y), (split, 0, w - split, h))]


def clock_bits(text: str, y: float, color: Color, lead: int = 0) -> list[Bit]:
    """The digits of the clock, in the middle of the picture behind `lead` px."""
    size = number_size(text, CLOCK.w - lead, readable(TITLE), TITLE)
    return number_bits(text, size, 960 + (lead - number_width(text, size)) / 2, y, color)


def clock_jobs(y: float) -> Iterator[Job]:
    """Prewarm jobs: samples of the clock."""
    for i in range(10):
        yield from (drawn(clock_bits, f"{i}:{i}{i}", y, color) for color in (ICE, ALARM))


def number_size(text: str, room: float, *sizes: int) -> int:
    """The first of `sizes`, px, at which a number takes less than `room` px, else the last."""
    return next((size for size in sizes if number_width(text, size) < room), sizes[-1])


def number_bits(text: str, size: int, x: float, y: float, color: Color) -> list[Bit]:
    """Number rendered in glyphs from `x`; `y` is the vertical centre of the digits."""
    bits: list[Bit] = []
    for char in text:
        (image, dx, dy), advance = glyph(char, size, color)
        bits.append((image, (round(x + dx), round(y + dy)), None))
        x += advance
    return bits


def word_bits(words: str) -> list[Bit]:
    """Words in place of the clock; | parts lines, of which all have one size."""
    lines = words.split("|")
    size = min(fit_size(line, readable(LABEL), CLOCK.w - 24) for line in lines)
    lit = [text(line, size, FOCUS, "head", room=CLOCK.w - 24) for line in lines]
    top = 84 - 25 * (len(lit) - 1)
    return [(part.image, (CLOCK.centerx + part.at[0], top + 50 * i + part.at[1]), None) for i, part in enumerate(lit)]
