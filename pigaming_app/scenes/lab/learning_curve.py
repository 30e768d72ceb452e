"""Learning curves: win rates against the hand-made robot over training matches, as measured dots and smoothed lines.

A tie counts as half a win, so the hand-made robot itself would lie on the dashed line at 0.5.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import pygame

from pigaming_app.scenes.lab.layout import CURVE, PLOT, RIGHT, SIDE_COLORS, SIDE_LETTERS
from pigaming_app.ui.draw import BODY, ICE, LABEL, MIST, STEEL, THIN, TITLE, WHITE, Color, dim
from pigaming_app.ui.draw.layers import LitImage, text, word
from pigaming_app.ui.draw.surface_cache import cached

MIN_RANGE = 50  # initial range of the x axis, matches; doubles as needed
MARK = 40  # px, height of the mark of a change
EVEN = 0.5  # expected win rate against an equal opponent
NAME_FROM = 0.4  # share of the width, start of its label
SMOOTHING = 0.3  # smoothing factor: weight of a new measurement
GLOW = ((17, 0.14), (11, 0.3), (6, 1.0))  # width in px, brightness


@dataclass(frozen=True)
class Measure:
    """Win rate `share`, 0..1, after a number of matches."""

    matches: float
    share: float


@dataclass(frozen=True)
class WinCourse:
    """What the curve of one robot shows. `changes`: matches after which its reward was changed."""

    measures: Sequence[Measure] = ()
    changes: Sequence[float] = ()


def smoothed(measures: Sequence[Measure]) -> list[float]:
    """Exponentially smoothed win rates with factor CALM; the first value is the first measurement."""
    out: list[float] = []
    for measure in measures:
        out.append(measure.share if not out else out[-1] + SMOOTHING * (measure.share - out[-1]))
    return out


def room(matches: float) -> int:
    """Range of the x axis for `matches`."""
    limit = MIN_RANGE
    while limit < matches:
        limit *= 2
    return limit


class LearningCurve:
    """Plot of the measurements of one robot or two, repainted only when one is added. `ground`: of the whole page."""

    def __init__(self, ground: pygame.Surface) -> None:
        self.bare = ground.subsurface(CURVE).copy()
        self.sheet = self.bare.copy()
        self.shares: list[float | None] = [None]  # ends of the lines
        self.drawn: list[tuple[int, int]] = []  # numbers of measurements and changes drawn
        self.above = False  # label of the hand-made robot above its line, because the curves run below

    def show(self, courses: Sequence[WinCourse]) -> None:
        """Update the plot with all measurements so far."""
        counts = [(len(course.measures), len(course.changes)) for course in courses]
        if counts == self.drawn:
            return
        self.drawn = counts
        self.sheet.blit(self.bare, (0, 0))
        left, foot = PLOT.left - CURVE.left, PLOT.bottom - CURVE.top
        _dashes(self.sheet, left, foot - round(PLOT.h * EVEN))
        limit = room(max((course.measures[-1].matches for course in courses if course.measures), default=0.0))
        self.shares, late = [], list[float]()
        for course, color in zip(courses, SIDE_COLORS, strict=False):
            xs = [left + PLOT.w * measure.matches / limit for measure in course.measures]
            line = smoothed(course.measures)
            for change in course.changes:
                x = left + PLOT.w * min(1.0, change / limit)
                pygame.draw.line(self.sheet, dim(color, 0.6), (x, foot), (x, foot - MARK), THIN)
            for x, measure in zip(xs, course.measures, strict=True):
                pygame.draw.circle(self.sheet, dim(color, 0.42), (x, foot - PLOT.h * measure.share), 4)
            late += [share for x, share in zip(xs, line, strict=True) if x > left + PLOT.w * NAME_FROM]
            self.shares.append(line[-1] if line else None)
            if line:
                _tube(self.sheet, [(x, foot - PLOT.h * share) for x, share in zip(xs, line, strict=True)], color)
        self.above = sum(late) < EVEN * len(late)

    def draw(self, screen: pygame.Surface, name: str) -> None:
        """Draw the plot. `name`: label of the hand-made robot."""
        screen.blit(self.sheet, CURVE)
        y = PLOT.bottom - PLOT.h * EVEN
        text(name, BODY, MIST, "body", "r", PLOT.w - 20).draw(screen, PLOT.right, y + (-34 if self.above else 36))
        if len(self.shares) == 1:
            if (share := self.shares[0]) is not None:
                number(round(100 * share)).draw(screen, RIGHT - 124, _height(share))
            return
        for i, (share, letter, color) in enumerate(zip(self.shares, SIDE_LETTERS, SIDE_COLORS, strict=True)):
            percent = "…" if share is None else f"{round(100 * share)}%"
            word(f"{letter} {percent}", LABEL, color, "head", 0.45).draw(screen, RIGHT - 124, PLOT.y + 32 + 84 * i)


def _height(share: float) -> float:
    """y of the percentage beside the end of the line, px, clamped to the panel."""
    return max(CURVE.top + 104.0, min(CURVE.bottom - 64.0, PLOT.bottom - PLOT.h * share))


@cached
def number(percent: int) -> LitImage:
    """Win rate in percent, centred on (0, 0)."""
    return word(f"{percent}%", TITLE - 16, ICE, "head", 0.45)


def _dashes(sheet: pygame.Surface, left: int, y: int) -> None:
    for x in range(left, left + PLOT.w - 16, 30):
        pygame.draw.line(sheet, STEEL, (x, y), (x + 16, y), THIN)


def _tube(sheet: pygame.Surface, points: list[tuple[float, float]], hue: Color) -> None:
    """Draw a glowing line without a blur: wide and dim strokes first, then narrow and bright ones."""
    for width, share in GLOW:
        color = dim(hue, share)
        for a, b in pairwise(points):
            pygame.draw.aaline(sheet, color, a, b, width)
        for point in points:
            pygame.draw.circle(sheet, color, point, width / 2)
    pygame.draw.circle(sheet, WHITE, points[-1], 13)
