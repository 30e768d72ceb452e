"""How often it wins against the hand-made robot, over the matches it has learned from: dots as measured, a line through
them. A tie is half a win, so the hand-made robot itself would be on the dashed line: above it, it has been outdone.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import pygame

from pigaming_app.scenes.lab.layout import CURVE, GOOD, PLOT, RIGHT
from pigaming_app.ui.draw import BODY, ICE, MIST, STEEL, THIN, TITLE, WHITE, dim
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import text, word

FIRST = 50  # matches that the plot has room for in the beginning; it doubles
HANDMADE = 0.5  # how often one wins against one like itself
NAME_FROM = 0.4  # of the width, where its name begins
CALM = 0.3  # share of a new measure in the line
GLOW = ((17, 0.14), (11, 0.3), (6, 1.0))  # px wide, brightness


@dataclass(frozen=True)
class Measure:
    """After so many matches it won this share, 0..1."""

    matches: float
    share: float


def smoothed(measures: Sequence[Measure]) -> list[float]:
    """The line through the dots: each measure moves it by CALM of the way; the first one is where it begins."""
    out: list[float] = []
    for one in measures:
        out.append(one.share if not out else out[-1] + CALM * (one.share - out[-1]))
    return out


def room(matches: float) -> int:
    """How many matches the plot shows."""
    most = FIRST
    while most < matches:
        most *= 2
    return most


class LearningCurve:
    """The picture of the measures, painted again only when there is a new one. `ground`: the page, whole."""

    def __init__(self, ground: pygame.Surface) -> None:
        self.bare = ground.subsurface(CURVE).copy()
        self.sheet = self.bare.copy()
        self.share: float | None = None  # where the line has come to
        self.shown = -1  # measures
        self.above = False  # the name of the hand-made robot stands above its line: below it there is a curve

    def show(self, measures: Sequence[Measure]) -> None:
        """What has been measured so far."""
        if len(measures) == self.shown:
            return
        self.shown = len(measures)
        self.sheet.blit(self.bare, (0, 0))
        left, foot = PLOT.left - CURVE.left, PLOT.bottom - CURVE.top
        _dashes(self.sheet, left, foot - round(PLOT.h * HANDMADE))
        self.share = None
        if measures:
            line = smoothed(measures)
            self.share = line[-1]
            most = room(measures[-1].matches)
            xs = [left + PLOT.w * one.matches / most for one in measures]
            for x, one in zip(xs, measures, strict=True):
                pygame.draw.circle(self.sheet, dim(GOOD, 0.42), (x, foot - PLOT.h * one.share), 4)
            late = [share for x, share in zip(xs, line, strict=True) if x > left + PLOT.w * NAME_FROM]
            self.above = sum(late) < HANDMADE * len(late)
            _tube(self.sheet, [(x, foot - PLOT.h * share) for x, share in zip(xs, line, strict=True)])

    def draw(self, screen: pygame.Surface, name: str, waiting: str) -> None:
        """Paint it; `name`: of the hand-made robot; `waiting`: what to say before anything is measured."""
        screen.blit(self.sheet, CURVE)
        y = PLOT.bottom - PLOT.h * HANDMADE
        text(name, BODY, MIST, "body", "r", PLOT.w - 20).draw(screen, PLOT.right, y + (-34 if self.above else 36))
        if self.share is None:
            text(waiting, BODY, MIST, "body", "r", 190).draw(screen, RIGHT - 36, CURVE.centery)
        else:
            number(round(100 * self.share)).draw(screen, RIGHT - 124, _height(self.share))


def _height(share: float) -> float:
    """Where the number stands: beside the end of the line, but within the panel."""
    return max(CURVE.top + 104.0, min(CURVE.bottom - 64.0, PLOT.bottom - PLOT.h * share))


@cached
def number(percent: int) -> LitImage:
    """How often, round (0, 0)."""
    return word(f"{percent}%", TITLE - 16, ICE, "head", 0.45)


def _dashes(sheet: pygame.Surface, left: int, y: int) -> None:
    for x in range(left, left + PLOT.w - 16, 30):
        pygame.draw.line(sheet, STEEL, (x, y), (x + 16, y), THIN)


def _tube(sheet: pygame.Surface, points: list[tuple[float, float]]) -> None:
    """A line that glows, without the cost of a blur: wide and dim, then narrow and bright."""
    for width, share in GLOW:
        color = dim(GOOD, share)
        for a, b in pairwise(points):
            pygame.draw.aaline(sheet, color, a, b, width)
        for point in points:
            pygame.draw.circle(sheet, color, point, width / 2)
    pygame.draw.circle(sheet, WHITE, points[-1], 13)
