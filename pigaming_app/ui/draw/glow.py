"""Glow rendering: draw large on black, downscale (antialiasing), blur and add the blurs back.

Nothing here runs in a steady frame: the resulting surfaces are cached and blitted. Only tiles that were drawn on are
painted and downscaled, and wide blurs run on small copies; a whole page renders in 50 ms.
"""

import math
from collections.abc import Callable
from itertools import groupby, pairwise
from typing import Self

import pygame

from pigaming_app.ui.draw.frame_budget import Steps, run_to_end
from pigaming_app.ui.draw.theme import (
    BLACK,
    BODY,
    CAPITALS,
    ICE,
    LINE,
    WHITE,
    Color,
    Points,
    baseline,
    line_image,
    mix,
    regular_polygon,
)

ADD, MULT, PRE = pygame.BLEND_RGB_ADD, pygame.BLEND_RGB_MULT, pygame.BLEND_PREMULTIPLIED

Halos = tuple[tuple[int, int, float], ...]
BAND = 120_000  # px blurred at once
# Glow: (downscale factor, Gaussian radius at that scale, strength). NEAR for sprites (reaches 24 px), WIDE for pages.
NEAR: Halos = ((2, 3, 0.60), (4, 3, 0.70))
WIDE: Halos = ((4, 1, 0.55), (8, 2, 0.60), (16, 3, 0.55))
SOFT: Halos = ((4, 1, 0.60), (8, 2, 0.70))  # like NEAR, for pages
TILE_W, TILE_H = 160, 120  # px

Shape = Callable[[pygame.Surface, int], object]  # paints on a band whose upper edge is at this y of its sheet, px


class Supersampled:
    """A surface `ss` times as large as a canvas of w x h px. It keeps the shapes and is painted when it is scaled down,
    in bands of TILE_H canvas px, as a whole one of a page would take 33 MB and 50 ms to allocate.
    """

    def __init__(self, w: int, h: int, ss: int, paper: tuple[int, ...] = BLACK) -> None:
        self.w, self.h, self.ss, self.paper = w, h, ss, paper
        self.tiles: set[tuple[int, int]] = set()
        self._bands: dict[int, list[Shape]] = {}

    def polygon(self, points: Points, color: tuple[int, ...], mark: bool = True) -> None:
        """Fill a polygon. Points are in supersampled px; `mark`: its tiles are drawn on."""
        corners = [(int(x), int(y)) for x, y in points]
        xs, ys = [x for x, _ in corners], [y for _, y in corners]

        def paint(band: pygame.Surface, top: int) -> None:
            pygame.draw.polygon(band, color, [(x, y - top) for x, y in corners])

        self._add(paint, (min(xs), min(ys), max(xs), max(ys)), mark)

    def circle(self, center: tuple[float, float], r: float, color: Color, mark: bool = True) -> None:
        """Fill a circle."""
        x, y = int(center[0]), int(center[1])

        def paint(band: pygame.Surface, top: int) -> None:
            pygame.draw.circle(band, color, (x, y - top), r)

        self._add(paint, (x - r, y - r, x + r, y + r), mark)

    def blit(self, image: pygame.Surface, at: tuple[int, int]) -> None:
        """Blit an image."""
        (x, y), (w, h) = at, image.get_size()
        self._add(lambda band, top: band.blit(image, (x, y - top)), (x, y, x + w, y + h), True)

    def _add(self, paint: Shape, box: tuple[float, float, float, float], mark: bool) -> None:
        w, h = TILE_W * self.ss, TILE_H * self.ss
        left, top, right, bottom = box
        for row in range(max(0, int(top // h)), min((self.h - 1) // TILE_H, int(bottom // h)) + 1):
            self._bands.setdefault(row, []).append(paint)
            if mark:
                columns = range(max(0, int(left // w)), min((self.w - 1) // TILE_W, int(right // w)) + 1)
                self.tiles.update((column, row) for column in columns)

    def downscale(self, out: pygame.Surface, flags: int = 0) -> Steps[None]:
        """Blit the tiles that were drawn on, scaled down, onto a surface of w x h px."""
        band = pygame.Surface((self.w * self.ss, min(TILE_H, self.h) * self.ss), out.get_flags() & pygame.SRCALPHA)
        for row, in_row in groupby(runs(self.tiles), key=lambda run: run[0]):
            self._paint(band, row)
            for _, first, count in in_row:
                box = pygame.Rect(first * TILE_W, row * TILE_H, count * TILE_W, TILE_H).clip((0, 0, self.w, self.h))
                large = band.subsurface(box.x * self.ss, 0, box.w * self.ss, box.h * self.ss)
                out.blit(pygame.transform.smoothscale(large, box.size), box, special_flags=flags)
            yield

    def _paint(self, band: pygame.Surface, row: int) -> None:
        band.fill(self.paper)
        for paint in self._bands.get(row, ()):
            paint(band, row * TILE_H * self.ss)


class GlowCanvas:
    """A black canvas of w x h px, supersampled by `ss`. `to` sets the transform of later drawing calls."""

    def __init__(self, w: int, h: int, ss: int = 2) -> None:
        self.w, self.h, self.ss = w, h, ss
        self.sheet, self.knockout = Supersampled(w, h, ss), Supersampled(w, h, ss, WHITE)
        self.mask = Supersampled(w, h, ss, (0, 0, 0, 0))  # what `solid` blacks out
        self.set_transform(0, 0)

    @property
    def is_empty(self) -> bool:
        """True if nothing was drawn."""
        return not self.sheet.tiles

    def set_transform(self, x: float, y: float, angle: float = 0.0, scale: float = 1.0) -> Self:
        """Set the origin to (x, y), the rotation to `angle` rad and the scale to `scale`."""
        self.x, self.y, self.k = x, y, scale * self.ss
        self.c, self.s = math.cos(angle) * self.k, math.sin(angle) * self.k
        return self

    def _at(self, p: tuple[float, float]) -> tuple[float, float]:
        x, y = p
        return self.x * self.ss + self.c * x - self.s * y, self.y * self.ss + self.s * x + self.c * y

    def fill(self, points: Points, color: Color) -> Self:
        self.sheet.polygon([self._at(p) for p in points], color)
        return self

    def solid(self, points: Points) -> Self:
        """Black out a polygon: on the canvas and, in a sprite, on the background it is blitted over."""
        at = [self._at(p) for p in points]
        self.sheet.polygon(at, BLACK, mark=False)
        self.mask.polygon(at, (*BLACK, 255))
        return self

    def line(self, points: Points, color: Color, width: float = LINE, closed: bool = False) -> Self:
        """A line with round joints and caps."""
        return self._line(self.sheet, points, color, width, closed)

    def _line(self, sheet: Supersampled, points: Points, color: Color, width: float, closed: bool = False) -> Self:
        at = [self._at(p) for p in points]
        w = max(1, round(width * self.k))
        for a, b in zip(at, at[1:] + at[:1] if closed else at[1:], strict=False):
            dx, dy = b[0] - a[0], b[1] - a[1]
            d = math.hypot(dx, dy) or 1
            nx, ny = -dy / d * w / 2, dx / d * w / 2
            corners = [(a[0] + nx, a[1] + ny), (b[0] + nx, b[1] + ny), (b[0] - nx, b[1] - ny), (a[0] - nx, a[1] - ny)]
            sheet.polygon(corners, color)
        for p in at:
            sheet.circle(p, w / 2, color)
        return self

    def void(self, points: Points, width: float, keep: float = 0.0) -> Self:
        """A black line that neighbouring glow does not fill, except for the share `keep`."""
        shade = round(255 * keep)
        self._line(self.knockout, points, (shade, shade, shade), width)
        return self.line(points, BLACK, width)

    def neon(self, points: Points, color: Color, width: float = LINE, closed: bool = False) -> Self:
        """A line with a brighter core."""
        self.line(points, color, width, closed)
        return self.line(points, mix(color, WHITE, 0.4), width * 0.35, closed)

    def disc(self, x: float, y: float, r: float, color: Color) -> Self:
        self.sheet.circle(self._at((x, y)), r * self.k, color)
        return self

    def arc(self, x: float, y: float, r: float, start: float, end: float, color: Color, width: float = LINE) -> Self:
        """A circular arc from angle `start` to `end`, rad, clockwise on the screen."""
        n = max(2, int(abs(end - start) * r / 4) + 2)
        angles = [start + (end - start) * i / n for i in range(n + 1)]
        return self.line([(x + r * math.cos(a), y + r * math.sin(a)) for a in angles], color, width)

    def ring(self, x: float, y: float, r: float, color: Color, width: float = LINE) -> Self:
        """A circle outline."""
        return self.line(regular_polygon(max(24, int(r)), r, 0, x, y), color, width, True)

    def dashes(self, points: Points, color: Color, width: float, on: float, off: float, closed: bool = True) -> Self:
        """A dashed outline: dashes of `on` px, gaps of `off` px, continued round corners."""
        points = [*points, points[0]] if closed else points
        left, draw, run = on, True, [points[0]]
        for a, b in pairwise(points):
            d, done = math.dist(a, b), 0.0
            while done < d:
                step = min(left, d - done)
                done, left = done + step, left - step
                p = (a[0] + (b[0] - a[0]) * done / d, a[1] + (b[1] - a[1]) * done / d)
                run.append(p)
                if left <= 1e-6:
                    if draw:
                        self.line(run, color, width)
                    draw, left, run = not draw, off if draw else on, [p]
        if draw and len(run) > 1:
            self.line(run, color, width)
        return self

    def text(
        self, text: str, size: int, x: float, y: float, color: Color = ICE, face: str = "head", align: str = "l"
    ) -> Self:
        """One upright line of text; y is the middle of its capitals; `align` is "l", "c" or "r" relative to x."""
        image = line_image(text, face, round(size * self.k), color)
        px, py = self._at((x, y))
        px -= {"l": 0.0, "c": 0.5, "r": 1.0}[align] * image.get_width()
        at = round(px), round(py + CAPITALS * size * self.k / 2 - baseline(text, face, round(size * self.k)))
        self.sheet.blit(image, at)
        if color == BLACK:  # keep black lettering black under neighbouring glow
            self.knockout.blit(image, at)
        return self

    def downscale_steps(self) -> Steps[pygame.Surface]:
        """The drawing at w x h px, without glow."""
        out = pygame.Surface((self.w, self.h))
        yield from self.sheet.downscale(out)
        return out

    def downscale_onto(self, out: pygame.Surface) -> Steps[None]:
        """Add the drawing, without glow, to a surface of w x h px."""
        return self.sheet.downscale(out, ADD)

    def plain(self) -> pygame.Surface:
        """Like `downscale_steps`, uninterrupted."""
        return run_to_end(self.downscale_steps())

    def lit_steps(self, glow: float = 1.0, halos: Halos = NEAR) -> Steps[pygame.Surface]:
        """The drawing with its glow. Blurs are added only where the drawing is dark, so that no hue clips."""
        out = yield from self.downscale_steps()
        yield from add_glow(out, [(out, halos, glow)])
        yield from self.knockout.downscale(out, MULT)
        return out

    def lit(self, glow: float = 1.0, halos: Halos = NEAR) -> pygame.Surface:
        """Like `lit_steps`, uninterrupted."""
        return run_to_end(self.lit_steps(glow, halos))

    def sprite_steps(self, glow: float = 1.0) -> Steps[pygame.Surface]:
        """A premultiplied sprite: black where `solid` was drawn, light elsewhere. One blit occludes and glows."""
        light = yield from self.lit_steps(glow)
        out = pygame.Surface((self.w, self.h), pygame.SRCALPHA)
        yield from self.mask.downscale(out)
        out.blit(light, (0, 0), special_flags=ADD)
        return out

    def sprite(self, glow: float = 1.0) -> pygame.Surface:
        """Like `sprite_steps`, uninterrupted."""
        return run_to_end(self.sprite_steps(glow))


def runs(tiles: set[tuple[int, int]]) -> list[tuple[int, int, int]]:
    """Merge tiles (column, row) into horizontal runs (row, first column, length)."""
    merged: list[tuple[int, int, int]] = []
    for column, row in sorted(tiles, key=lambda tile: (tile[1], tile[0])):
        if merged and merged[-1][0] == row and merged[-1][1] + merged[-1][2] == column:
            merged[-1] = row, merged[-1][1], merged[-1][2] + 1
        else:
            merged.append((row, column, 1))
    return merged


def blur_steps(light: pygame.Surface, radius: int) -> Steps[pygame.Surface]:
    """A Gaussian blur in bands of about BAND px of area: 25 ms at once for a whole field."""
    w, h = light.get_size()
    rows, rim = max(1, BAND // w), 2 * radius  # the kernel ends there
    out = pygame.Surface((w, h), 0, light)
    for top in range(0, h, rows):
        start = max(0, top - rim)
        band = light.subsurface((0, start, w, min(h, top + rows + rim) - start))
        out.blit(pygame.transform.gaussian_blur(band, radius), (0, top), (0, top - start, w, rows))
        yield
    return out


def add_glow(out: pygame.Surface, sources: list[tuple[pygame.Surface, Halos, float]]) -> Steps[None]:
    """Add the blurs of (light, halos, strength), all the size of `out`, where `out` is dark."""
    size = out.get_size()
    min_shrink = min(shrink for _, halos, _ in sources for shrink, _, _ in halos)
    soft = pygame.Surface((max(1, size[0] // min_shrink), max(1, size[1] // min_shrink)))
    for light, halos, glow in sources:
        small = light
        for shrink, radius, k in halos:
            small = pygame.transform.smoothscale(small, (max(1, size[0] // shrink), max(1, size[1] // shrink)))
            yield
            blur = yield from blur_steps(small, radius)
            blur.fill([min(255, round(255 * k * glow))] * 3, special_flags=MULT)
            soft.blit(pygame.transform.smoothscale(blur, soft.get_size()), (0, 0), special_flags=ADD)
            yield
    soft.fill((6, 6, 6), special_flags=pygame.BLEND_RGB_SUB)  # cut the tails: black stays black, sprites have no edge
    soft = pygame.transform.smoothscale(soft, size)
    yield
    dark = pygame.transform.grayscale(out)
    dark.blit(dark, (0, 0), special_flags=ADD)
    yield
    soft.blit(pygame.transform.invert(dark), (0, 0), special_flags=MULT)
    yield
    out.blit(soft, (0, 0), special_flags=ADD)


class LayeredCanvas:
    """A full-screen canvas of three layers: glowing lines (`glow`), softly glowing titles (`soft`), crisp text."""

    def __init__(self, w: int = 1920, h: int = 1080) -> None:
        self.glow, self.soft, self.crisp = GlowCanvas(w, h), GlowCanvas(w, h), GlowCanvas(w, h)

    def text(
        self, text: str, size: int, x: float, y: float, color: Color = ICE, face: str = "head", align: str = "l"
    ) -> None:
        """Draw a title or number."""
        self.soft.text(text, size, x, y, color, face, align)

    def body(self, text: str, x: float, y: float, color: Color = ICE, align: str = "l", size: int = BODY) -> None:
        """Draw body text."""
        self.crisp.text(text, size, x, y, color, "body", align)

    def render_steps(self) -> Steps[pygame.Surface]:
        """Render the page."""
        lines = yield from self.glow.downscale_steps()
        out = lines.copy()
        sources = [(lines, WIDE, 1.0)]
        if not self.soft.is_empty:
            titles = yield from self.soft.downscale_steps()
            out.blit(titles, (0, 0), special_flags=ADD)
            sources.append((titles, SOFT, 0.45))
        yield
        yield from add_glow(out, sources)
        yield from self.glow.knockout.downscale(out, MULT)
        yield from self.soft.knockout.downscale(out, MULT)
        yield from self.crisp.downscale_onto(out)
        return out

    def render(self) -> pygame.Surface:
        """Like `render_steps`, uninterrupted."""
        return run_to_end(self.render_steps())
