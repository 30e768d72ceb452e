"""Ink is drawn large on black, shrunk (antialiasing), blurred and added to itself (glow).

Nothing here runs in a steady frame: it makes the surfaces that a scene then only blits.
"""

import math
from itertools import pairwise
from typing import Self

import pygame

from pigaming_app.scenes.palette import BLACK, BODY, CAPITALS, ICE, LINE, WHITE, Color, Points, font, mix, regular

ADD, MULT, PRE = pygame.BLEND_RGB_ADD, pygame.BLEND_RGB_MULT, pygame.BLEND_PREMULTIPLIED

Halos = tuple[tuple[int, int, float], ...]
# Glow: (shrink by, gaussian radius there, strength). NEAR for sprites (reaches 24 px), WIDE for pages.
NEAR: Halos = ((2, 3, 0.60), (4, 3, 0.70))
WIDE: Halos = ((2, 3, 0.55), (4, 4, 0.60), (8, 6, 0.55))


class Ink:
    """A black sheet of w x h px, drawn `ss` times larger than it will be. `to` moves, turns and scales what follows."""

    def __init__(self, w: int, h: int, ss: int = 2) -> None:
        self.w, self.h, self.ss = w, h, ss
        self.sheet = pygame.Surface((w * ss, h * ss))
        self.mask: pygame.Surface | None = None
        self.knock: pygame.Surface | None = None
        self.to(0, 0)

    def to(self, x: float, y: float, angle: float = 0.0, scale: float = 1.0) -> Self:
        """What follows is drawn round (x, y), turned by `angle` rad and `scale` times as large."""
        self.x, self.y, self.k = x, y, scale * self.ss
        self.c, self.s = math.cos(angle) * self.k, math.sin(angle) * self.k
        return self

    def _at(self, p: tuple[float, float]) -> tuple[float, float]:
        x, y = p
        return self.x * self.ss + self.c * x - self.s * y, self.y * self.ss + self.s * x + self.c * y

    def fill(self, points: Points, color: Color) -> Self:
        """A filled polygon."""
        pygame.draw.polygon(self.sheet, color, [self._at(p) for p in points])
        return self

    def solid(self, points: Points) -> Self:
        """Black out what lies below: on the sheet, and, in a sprite, on whatever it is blitted over."""
        at = [self._at(p) for p in points]
        pygame.draw.polygon(self.sheet, BLACK, at)
        if self.mask is None:
            self.mask = pygame.Surface(self.sheet.get_size(), pygame.SRCALPHA)
        pygame.draw.polygon(self.mask, (0, 0, 0, 255), at)
        return self

    def line(self, points: Points, color: Color, width: float = LINE, closed: bool = False) -> Self:
        """A line with round joints and ends."""
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
        return self

    def void(self, points: Points, width: float, keep: float = 0.0) -> Self:
        """A black line that its neighbours' glow does not fill (only `keep` of it)."""
        self.line(points, BLACK, width)
        real, self.sheet = self.sheet, self._knock()
        shade = round(255 * keep)
        self.line(points, (shade, shade, shade), width)
        self.sheet = real
        return self

    def _knock(self) -> pygame.Surface:
        if self.knock is None:
            self.knock = pygame.Surface(self.sheet.get_size())
            self.knock.fill(WHITE)
        return self.knock

    def neon(self, points: Points, color: Color, width: float = LINE, closed: bool = False) -> Self:
        """A line with a hotter core."""
        self.line(points, color, width, closed)
        return self.line(points, mix(color, WHITE, 0.4), width * 0.35, closed)

    def disc(self, x: float, y: float, r: float, color: Color) -> Self:
        """A filled circle."""
        pygame.draw.circle(self.sheet, color, self._at((x, y)), r * self.k)
        return self

    def arc(self, x: float, y: float, r: float, start: float, end: float, color: Color, width: float = LINE) -> Self:
        """Part of a circle, from angle `start` to `end`, rad, clockwise on the screen."""
        n = max(2, int(abs(end - start) * r / 4) + 2)
        angles = [start + (end - start) * i / n for i in range(n + 1)]
        return self.line([(x + r * math.cos(a), y + r * math.sin(a)) for a in angles], color, width)

    def ring(self, x: float, y: float, r: float, color: Color, width: float = LINE) -> Self:
        """A circle's outline."""
        return self.line(regular(max(24, int(r)), r, 0, x, y), color, width, True)

    def dashes(self, points: Points, color: Color, width: float, on: float, off: float, closed: bool = True) -> Self:
        """An outline in dashes, `on` px long and `off` px apart; corners included."""
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
        """One line of text, upright; y is the middle of its capitals; `align` is "l", "c" or "r" of x."""
        f = font(face, round(size * self.k))
        image = f.render(text, True, color)
        px, py = self._at((x, y))
        px -= {"l": 0.0, "c": 0.5, "r": 1.0}[align] * image.get_width()
        at = round(px), round(py + CAPITALS * size * self.k / 2 - f.get_ascent())
        self.sheet.blit(image, at)
        if color == BLACK:  # black lettering stays black under its neighbours' glow
            self._knock().blit(image, at)
        return self

    def plain(self) -> pygame.Surface:
        """The sheet at its real size, without glow."""
        return pygame.transform.smoothscale(self.sheet, (self.w, self.h))

    def lit(self, glow: float = 1.0, halos: Halos = NEAR) -> pygame.Surface:
        """The sheet with its glow: blurs of it, added where the ink itself is dark, so that no hue ever clips."""
        out = self.plain()
        soft = pygame.Surface((self.w, self.h))
        for shrink, radius, k in halos:
            blur = pygame.transform.smoothscale(out, (max(1, self.w // shrink), max(1, self.h // shrink)))
            blur = pygame.transform.gaussian_blur(blur, radius)
            blur.fill([min(255, round(255 * k * glow))] * 3, special_flags=MULT)
            soft.blit(pygame.transform.smoothscale(blur, (self.w, self.h)), (0, 0), special_flags=ADD)
        soft.fill((6, 6, 6), special_flags=pygame.BLEND_RGB_SUB)  # the tails: black stays black, sprites have no edge
        dark = pygame.transform.grayscale(out)
        dark.blit(dark.copy(), (0, 0), special_flags=ADD)
        soft.blit(pygame.transform.invert(dark), (0, 0), special_flags=MULT)
        out.blit(soft, (0, 0), special_flags=ADD)
        if self.knock:
            out.blit(pygame.transform.smoothscale(self.knock, (self.w, self.h)), (0, 0), special_flags=MULT)
        return out

    def sprite(self, glow: float = 1.0) -> pygame.Surface:
        """Premultiplied: black where `solid` hides the ground, light everywhere else. One blit occludes and glows."""
        light = self.lit(glow)
        out = pygame.Surface((self.w, self.h), pygame.SRCALPHA)
        if self.mask:
            out.blit(pygame.transform.smoothscale(self.mask, (self.w, self.h)), (0, 0))
        out.blit(light, (0, 0), special_flags=ADD)
        return out


class Page:
    """A whole screen: lines glow (`hot`), titles shimmer (`warm`), body text is crisp (`cold`)."""

    def __init__(self, w: int = 1920, h: int = 1080) -> None:
        self.hot, self.warm, self.cold = Ink(w, h), Ink(w, h), Ink(w, h)

    def text(
        self, text: str, size: int, x: float, y: float, color: Color = ICE, face: str = "head", align: str = "l"
    ) -> None:
        """A title or a number."""
        self.warm.text(text, size, x, y, color, face, align)

    def body(self, text: str, x: float, y: float, color: Color = ICE, align: str = "l", size: int = BODY) -> None:
        """A sentence."""
        self.cold.text(text, size, x, y, color, "body", align)

    def done(self) -> pygame.Surface:
        """The page, lit."""
        out = self.hot.lit(1.0, WIDE)
        out.blit(self.warm.lit(0.45), (0, 0), special_flags=ADD)
        out.blit(self.cold.plain(), (0, 0), special_flags=ADD)
        return out
