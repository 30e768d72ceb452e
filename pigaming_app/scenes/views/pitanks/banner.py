"""The clock of PiTanks in the finale, with its announcement, and what replaces the clock in overtime."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import pygame

from pigaming_app.games.pitanks.scoring import is_finale, is_overtime
from pigaming_app.scenes.views.background import Bit
from pigaming_app.scenes.views.hud.parts import ALARM_SECONDS, CLOCK, EDGE, number_bits
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LABEL, SUB, GlowCanvas, dim, readable
from pigaming_app.ui.draw.layers import fit_size, glyph, number_width, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words

ROOM = CLOCK.w - 24  # px for a line
CLOCK_Y, BELOW_Y = 48, 106  # px, middle of the digits and of the announcement
LINES_Y, PITCH = 34, 50  # px, middle of the first line and from line to line in overtime
BAR_Y, CELLS = 122, 15  # px; cells of the bar that empties in overtime
FINALE, OVERTIME = "finale", "overtime"


class Banner:
    """The words between the panels in the finale and in overtime."""

    def __init__(self, words: Words | None) -> None:
        self.double = words("pitanks.double") if words else ""
        self.next_hit = words("pitanks.next_hit").split("|") if words else []
        self.size = min((fit_size(line, readable(LABEL), ROOM) for line in self.next_hit), default=LABEL)

    def content(self, state: Any) -> tuple[str, int] | None:
        """Phase of the match, and the seconds or cells that are left; None before the finale and after the end."""
        rules = state.rules
        if is_finale(state):
            return FINALE, -(-(rules.ticks - state.tick) // HZ)
        if is_overtime(state):
            return OVERTIME, -(-CELLS * (rules.ticks + rules.overtime - state.tick) // rules.overtime)
        return None

    def bits(self, phase: str, left: int) -> list[Bit]:
        """The pieces of the banner."""
        if phase == FINALE:
            clock = f"{left // 60}:{left % 60:02}"
            bits = number_bits(clock, SUB, 960 - number_width(clock, SUB) / 2, CLOCK_Y, _color(left))
            return [*bits, _line(self.double, BELOW_Y, readable(LABEL))]
        middle = CLOCK.centerx - ROOM // 2 - EDGE
        cut = EDGE + ROOM * left // CELLS
        whole = ROOM + 2 * EDGE
        return [
            *(_line(line, LINES_Y + PITCH * i, self.size) for i, line in enumerate(self.next_hit)),
            (bar(True), (middle, BAR_Y - EDGE), (0, 0, cut, 2 * EDGE)),
            (bar(False), (middle + cut, BAR_Y - EDGE), (cut, 0, whole, 2 * EDGE)),
        ]

    def jobs(self, state: Any) -> Iterator[Callable[[], object]]:
        """Prewarm jobs, if the rules have a finale."""
        if not state.rules.finale:
            return
        yield partial(_line, self.double, 0, readable(LABEL))
        yield from (partial(_line, line, 0, self.size) for line in self.next_hit)
        for char in "0123456789:":
            for color in (ICE, ALARM):
                yield partial(glyph, char, SUB, color)
        yield partial(bar, True)
        yield partial(bar, False)


def _color(seconds: int) -> tuple[int, int, int]:
    return ALARM if seconds <= ALARM_SECONDS else ICE


def _line(line: str, y: int, size: int) -> Bit:
    lit = text(line, size, FOCUS, "head", room=ROOM)
    return lit.image, (CLOCK.centerx + lit.at[0], y + lit.at[1]), None


@cached
def bar(full: bool) -> pygame.Surface:
    """The cells of the bar, all lit or all dark."""
    ink = GlowCanvas(ROOM + 2 * EDGE, 2 * EDGE).set_transform(EDGE, EDGE)
    pitch = ROOM / CELLS
    for i in range(CELLS):
        x = i * pitch
        cell = [(x + 3, -5), (x + pitch - 2, -5), (x + pitch - 5, 5), (x, 5)]
        ink.fill(cell, ALARM if full else dim(ALARM, 0.18))
    return ink.lit(0.5) if full else ink.plain()
