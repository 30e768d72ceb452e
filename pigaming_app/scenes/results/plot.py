"""Score over time as a plot revealed from left to right: one line per robot or per team."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import pygame

from pigaming_app.ui.draw import BODY, FOCUS, HAIR, MIST, PLAYERS, STEEL, THIN, badge, dim, mix, text_width
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.i18n import numeral

Series = Sequence[tuple[float, float]]  # (seconds, score) at each change, or (lap, s)
Point = tuple[float, float]
APART = 4  # px between coinciding lines
ROOM = 54  # px between the badges at the ends
STEPS = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)  # candidate tick spacings of an axis


@dataclass(frozen=True)
class Curve:
    """One line of the plot: its players (the first sets the colour) and its series."""

    players: tuple[int, ...]
    series: tuple[tuple[float, float], ...]

    @property
    def last(self) -> float:
        return self.series[-1][1] if self.series else 0


class Plot:
    """Plot of a match of `seconds` in the area x, y, w, h (canvas px)."""

    def __init__(self, x: int, y: int, w: int, h: int, curves: Sequence[Curve], seconds: float) -> None:
        badges = max((len(curve.players) for curve in curves), default=1)
        self.low, self.high, self.step = self.scale([value for curve in curves for _, value in curve.series])
        left = 20 + max(64.0, *(text_width(label, BODY) for _, label in self.numbers()))
        self.x, self.y, self.w, self.h = round(x + left), y + 8, round(w - left) - 30 - 50 * badges, h - 76
        self.foot = y + h - 20
        self.seconds = max(1.0, seconds)
        self.curves = curves
        self.box = x, y, w, h

    def scale(self, values: Sequence[float]) -> tuple[int, int, int]:
        """Lower end, upper end and tick spacing of the y axis."""
        return scale(math.floor(min(0, *values, 0)), math.ceil(max(0, *values, 0)))

    def to_screen(self, seconds: float, score: float) -> Point:
        """Canvas position of a score at a time."""
        share = (score - self.low) / (self.high - self.low)
        return self.x + self.w * min(1.0, seconds / self.seconds), self.y + self.h * (1.0 - share)

    def grid(self) -> LitImage:
        """Grid lines and tick labels, below the curves."""
        layer = Layer(*self.box)
        ink = layer.canvas.crisp
        faint = dim(STEEL, 0.55)
        for value, label in self.numbers():
            a, b = self.to_screen(0, value), self.to_screen(self.seconds, value)
            ink.line([a, b], STEEL if value == 0 else faint, THIN if value == 0 else HAIR)
            ink.text(label, BODY, self.x - 20, a[1], MIST, "head", "r")
        for at, label in self.marks():
            ink.line([self.to_screen(at, self.low), self.to_screen(at, self.high)], faint, HAIR)
            ink.text(label, BODY, self.to_screen(at, 0)[0], self.foot, MIST, "head", "c")
        return layer.render()

    def numbers(self) -> list[tuple[int, str]]:
        """y axis: value and label of each tick."""
        return [(value, numeral(value)) for value in range(self.low, self.high + 1, self.step)]

    def marks(self) -> list[tuple[float, str]]:
        """x axis: value and label of each tick."""
        return [(second, f"{second // 60}:{second % 60:02}") for second in time_marks(self.seconds)]

    def lines(self) -> LitImage:
        """The curves."""
        layer = Layer(self.x, self.y, self.w, self.h)
        middle = (len(self.curves) - 1) / 2
        for i, curve in reversed(list(enumerate(self.curves))):
            points = [(x, y + APART * (i - middle)) for x, y in self.corners(curve.series)]
            if points:
                layer.glow.line(points, PLAYERS[curve.players[0]], 5)
        for x, y in self.marked():
            layer.glow.ring(x, y, 16, FOCUS, THIN)
        return layer.render()

    def marked(self) -> list[Point]:
        """Positions of highlighted points."""
        return []

    def ends(self) -> LitImage:
        """Badges at the ends of the curves, without overlap."""
        x = self.x + self.w
        layer = Layer(x, self.y, 1840 - x, self.h)
        drawn = [curve for curve in self.curves if curve.series]
        heights = spread([self.to_screen(0, curve.last)[1] for curve in drawn], ROOM, self.y + self.h)
        for curve, y in zip(drawn, heights, strict=True):
            for i, player in enumerate(curve.players):
                badge(layer.glow, player, x + 44 + 52 * i, y, 22)
        return layer.render()

    def heads(self, share: float) -> list[tuple[Point, tuple[int, int, int]]]:
        """Position and colour of each curve's end when `share` of the time is revealed."""
        now, middle, out = share * self.seconds, (len(self.curves) - 1) / 2, []
        for i, curve in enumerate(self.curves):
            score = next((s for t, s in reversed(curve.series) if t <= now), 0)
            x, y = self.to_screen(now, score)
            out.append(((x, y + APART * (i - middle)), mix(PLAYERS[curve.players[0]], (255, 255, 255), 0.6)))
        return out

    def corners(self, series: Series) -> list[Point]:
        """Polyline of a step curve on the canvas."""
        points, score = [self.to_screen(0, 0)], 0.0
        for seconds, after in series:
            points += [self.to_screen(seconds, score), self.to_screen(seconds, after)]
            score = after
        return [*points, self.to_screen(self.seconds, score)]


class LapPlot(Plot):
    """Plot of lap times in s over lap numbers."""

    def __init__(self, x: int, y: int, w: int, h: int, curves: Sequence[Curve], laps: int) -> None:
        super().__init__(x, y, w, h, curves, laps)

    def scale(self, values: Sequence[float]) -> tuple[int, int, int]:
        """y axis from just below the best lap, instead of from 0."""
        low, high = math.floor(min(values, default=0)), math.ceil(max(values, default=2))
        step = next(step for step in STEPS if math.ceil((high - low) / step) <= 4)
        bottom = low // step * step
        return bottom, max(-(-high // step) * step, bottom + 2 * step), step

    def to_screen(self, seconds: float, score: float) -> Point:
        """Canvas position of a lap time, centred in the lap's share of the axis."""
        share = (score - self.low) / (self.high - self.low)
        return self.x + self.w * min(1.0, max(0.0, (seconds - 0.5) / self.seconds)), self.y + self.h * (1.0 - share)

    def marked(self) -> list[Point]:
        """The best lap of all."""
        laps = [(time, lap, i) for i, curve in enumerate(self.curves) for lap, time in curve.series]
        if not laps:
            return []
        time, lap, i = min(laps)
        x, y = self.to_screen(lap, time)
        return [(x, y + APART * (i - (len(self.curves) - 1) / 2))]

    def marks(self) -> list[tuple[float, str]]:
        """The lap numbers."""
        return [(lap, str(lap)) for lap in range(1, round(self.seconds) + 1)]

    def corners(self, series: Series) -> list[Point]:
        """Line from lap to lap; a single lap becomes a short stroke."""
        points = [self.to_screen(lap, time) for lap, time in series]
        return [(points[0][0] - 20, points[0][1]), (points[0][0] + 20, points[0][1])] if len(points) == 1 else points

    def heads(self, share: float) -> list[tuple[Point, tuple[int, int, int]]]:
        """The last revealed lap of each driver."""
        now, out = 0.5 + share * self.seconds, []
        for curve in self.curves:
            seen = [(lap, time) for lap, time in curve.series if lap <= now]
            if seen:
                out.append((self.to_screen(*seen[-1]), mix(PLAYERS[curve.players[0]], (255, 255, 255), 0.6)))
        return out


def scale(low: int, high: int) -> tuple[int, int, int]:
    """Lower end, upper end and tick spacing of an axis that contains `low`, `high` and 0."""
    step = next(step for step in STEPS if math.ceil(high / step) - low // step <= 5)
    bottom, top = low // step * step, -(-high // step) * step
    return bottom, max(top, bottom + 2 * step), step


def time_marks(seconds: float) -> list[int]:
    """Tick times of an axis of `seconds`: at most five, none beyond its end."""
    step = next(step for step in (1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 36000) if seconds / step <= 5)
    return list(range(0, int(seconds) + 1, step))


def spread(wanted: Sequence[float], room: float, bottom: float) -> list[float]:
    """Positions nearest to the wanted ones, at least `room` apart, not beyond `bottom`, in the same order."""
    order = sorted(range(len(wanted)), key=lambda i: wanted[i])
    places: list[float] = []
    for i in order:
        places.append(max(wanted[i], places[-1] + room if places else -math.inf))
    limit = bottom
    for k in reversed(range(len(places))):
        places[k] = min(places[k], limit)
        limit = places[k] - room
    out = [0.0] * len(wanted)
    for i, place in zip(order, places, strict=True):
        out[i] = place
    return out


def team_curve(players: Sequence[int], series: Sequence[Series]) -> Curve:
    """One curve for several robots: the sum of their scores."""
    changes = sorted((seconds, k, score) for k, steps in enumerate(series) for seconds, score in steps)
    now, out = [0.0] * len(series), []
    for seconds, k, score in changes:
        now[k] = score
        out.append((seconds, sum(now)))
    return Curve(tuple(players), tuple(out))


def dot(screen: pygame.Surface, at: Point, color: tuple[int, int, int]) -> None:
    """Draw the bright end of a curve during the reveal."""
    pygame.draw.circle(screen, color, at, 7)
