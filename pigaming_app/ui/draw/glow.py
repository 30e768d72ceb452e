"""Glow rendering: draw large on black, downscale (antialiasing), blur and add the blurs back.

Nothing here runs in a steady frame: the resulting surfaces are cached and blitted. Only tiles that were drawn on are
downscaled, and wide blurs run on small copies; a whole page renders in 50 ms.
"""

import math
from functools import cached_property
from itertools import pairwise
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
# Glow: (downscale factor, Gaussian radius at that scale, strength). NEAR for sprites (reaches 24 px), WIDE for pages.
NEAR: Halos = ((2, 3, 0.60), (4, 3, 0.70))
WIDE: Halos = ((4, 1, 0.55), (8, 2, 0.60), (16, 3, 0.55))
SOFT: Halos = ((4, 1, 0.60), (8, 2, 0.70))  # like NEAR, for pages
TILE_W, TILE_H = 160, 120  # px


class GlowCanvas:
    """A black canvas of w x h px, supersampled by `ss`. `to` sets the transform of later drawing calls."""

    def __init__(self, w: int, h: int, ss: int = 2) -> None:
        self.w, self.h, self.ss = w, h, ss
        self.covers: list[list[tuple[float, float]]] = []
        self.knockout: pygame.Surface | None = None
        self.tiles: set[tuple[int, int]] = set()
        self.set_transform(0, 0)

    @cached_property
    def sheet(self) -> pygame.Surface:
        """The supersampled surface, allocated on the first drawing call."""
        return pygame.Surface((self.w * self.ss, self.h * self.ss))

    def set_transform(self, x: float, y: float, angle: float = 0.0, scale: float = 1.0) -> Self:
        """Set the origin to (x, y), the rotation to `angle` rad and the scale to `scale`."""
        self.x, self.y, self.k = x, y, scale * self.ss
        self.c, self.s = math.cos(angle) * self.k, math.sin(angle) * self.k
        return self

    def _at(self, p: tuple[float, float]) -> tuple[float, float]:
        x, y = p
        return self.x * self.ss + self.c * x - self.s * y, self.y * self.ss + self.s * x + self.c * y

    def _mark(self, left: float, top: float, right: float, bottom: float) -> None:
        """Mark the tiles of a box, in supersampled px, as drawn on."""
        w, h = TILE_W * self.ss, TILE_H * self.ss
        columns = range(max(0, int(left // w)), min((self.w - 1) // TILE_W, int(right // w)) + 1)
        for row in range(max(0, int(top // h)), min((self.h - 1) // TILE_H, int(bottom // h)) + 1):
            for column in columns:
                self.tiles.add((column, row))

    def fill(self, points: Points, color: Color) -> Self:
        box = pygame.draw.polygon(self.sheet, color, [self._at(p) for p in points])
        self._mark(box.left, box.top, box.right, box.bottom)
        return self

    def solid(self, points: Points) -> Self:
        """Black out a polygon: on the canvas and, in a sprite, on the background it is blitted over."""
        at = [self._at(p) for p in points]
        pygame.draw.polygon(self.sheet, BLACK, at)
        self.covers.append(at)
        return self

    def line(self, points: Points, color: Color, width: float = LINE, closed: bool = False) -> Self:
        """A line with round joints and caps."""
        at = [self._at(p) for p in points]
        w = max(1, round(width * self.k))
        for a, b in zip(at, at[1:] + at[:1] if closed else at[1:], strict=False):
            dx, dy = b[0] - a[0], b[1] - a[1]
            d = math.hypot(dx, dy) or 1
            nx, ny = -dy / d * w / 2, dx / d * w / 2
            corners = [(a[0] + nx, a[1] + ny), (b[0] + nx, b[1] + ny), (b[0] - nx, b[1] - ny), (a[0] - nx, a[1] - ny)]
            pygame.draw.polygon(self.sheet, color, corners)
        for p in at:
            pygame.draw.circle(self.sheet, color, p, w / 2)
        xs, ys, r = [p[0] for p in at], [p[1] for p in at], w / 2 + 1
        self._mark(min(xs) - r, min(ys) - r, max(xs) + r, max(ys) + r)
        return self

    def void(self, points: Points, width: float, keep: float = 0.0) -> Self:
        """A black line that neighbouring glow does not fill, except for the share `keep`."""
        self.line(points, BLACK, width)
        canvas, self.sheet = self.sheet, self._knockout()
        shade = round(255 * keep)
        self.line(points, (shade, shade, shade), width)
        self.sheet = canvas
        return self

    def _knockout(self) -> pygame.Surface:
        if self.knockout is None:
            self.knockout = pygame.Surface(self.sheet.get_size())
            self.knockout.fill(WHITE)
        return self.knockout

    def neon(self, points: Points, color: Color, width: float = LINE, closed: bool = False) -> Self:
        """A line with a brighter core."""
        self.line(points, color, width, closed)
        return self.line(points, mix(color, WHITE, 0.4), width * 0.35, closed)

    def disc(self, x: float, y: float, r: float, color: Color) -> Self:
        box = pygame.draw.circle(self.sheet, color, self._at((x, y)), r * self.k)
        self._mark(box.left, box.top, box.right, box.bottom)
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
        box = self.sheet.blit(image, at)
        self._mark(box.left, box.top, box.right, box.bottom)
        if color == BLACK:  # keep black lettering black under neighbouring glow
            self._knockout().blit(image, at)
        return self

    def _downscale(self, sheet: pygame.Surface, out: pygame.Surface, flags: int) -> Steps[None]:
        """Blit the drawn tiles of a supersampled surface, downscaled, onto a surface of w x h px."""
        for row, first, count in runs(self.tiles):
            box = pygame.Rect(first * TILE_W, row * TILE_H, count * TILE_W, TILE_H).clip((0, 0, self.w, self.h))
            large = sheet.subsurface(box.x * self.ss, box.y * self.ss, box.w * self.ss, box.h * self.ss)
            out.blit(pygame.transform.smoothscale(large, box.size), box, special_flags=flags)
            yield

    def downscale_onto(self, out: pygame.Surface) -> Steps[None]:
        """Add the drawing, without glow, to a surface of w x h px."""
        if self.tiles:
            yield from self._downscale(self.sheet, out, ADD)

    def downscale_steps(self) -> Steps[pygame.Surface]:
        """The drawing at w x h px, without glow."""
        out = pygame.Surface((self.w, self.h))
        if self.tiles:
            yield from self._downscale(self.sheet, out, 0)
        return out

    def plain(self) -> pygame.Surface:
        """Like `shrinking`, uninterrupted."""
        return run_to_end(self.downscale_steps())

    def apply_knockout(self, out: pygame.Surface) -> Steps[None]:
        """Darken voids and black lettering."""
        if self.knockout:
            yield from self._downscale(self.knockout, out, MULT)

    def lit_steps(self, glow: float = 1.0, halos: Halos = NEAR) -> Steps[pygame.Surface]:
        """The drawing with its glow. Blurs are added only where the drawing is dark, so that no hue clips."""
        out = yield from self.downscale_steps()
        yield from add_glow(out, [(out, halos, glow)])
        yield from self.apply_knockout(out)
        return out

    def lit(self, glow: float = 1.0, halos: Halos = NEAR) -> pygame.Surface:
        """Like `lit_steps`, uninterrupted."""
        return run_to_end(self.lit_steps(glow, halos))

    def sprite_steps(self, glow: float = 1.0) -> Steps[pygame.Surface]:
        """A premultiplied sprite: black where `solid` was drawn, light elsewhere. One blit occludes and glows."""
        light = yield from self.lit_steps(glow)
        out = pygame.Surface((self.w, self.h), pygame.SRCALPHA)
        if self.covers:
            mask = pygame.Surface(self.sheet.get_size(), pygame.SRCALPHA)
            for points in self.covers:
                pygame.draw.polygon(mask, (0, 0, 0, 255), points)
            out.blit(pygame.transform.smoothscale(mask, (self.w, self.h)), (0, 0))
        out.blit(light, (0, 0), special_flags=ADD)
        return out

    def sprite(self, glow: float = 1.0) -> pygame.Surface:
        """Like `spriting`, uninterrupted."""
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
            blur = pygame.transform.gaussian_blur(small, radius)
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
        if self.soft.tiles:
            titles = yield from self.soft.downscale_steps()
            out.blit(titles, (0, 0), special_flags=ADD)
            sources.append((titles, SOFT, 0.45))
        yield
        yield from add_glow(out, sources)
        yield from self.glow.apply_knockout(out)
        yield from self.soft.apply_knockout(out)
        yield from self.crisp.downscale_onto(out)
        return out

    def render(self) -> pygame.Surface:
        """Like `render_steps`, uninterrupted."""
        return run_to_end(self.render_steps())
