"""The theme: colours, line weights, type sizes, fonts and basic shapes.

Colour identifies players (Okabe-Ito, brightened for a projector); everything else is ice, focus is yellow.
"""

import math
import re
from collections.abc import Sequence
from functools import cache, lru_cache
from io import BytesIO

import pygame

from pigaming_app import ASSETS

Color = tuple[int, int, int]
Point = tuple[float, float]
Points = Sequence[Point]

BLUE, ORANGE, GREEN, PURPLE = (60, 160, 255), (255, 146, 0), (20, 228, 140), (255, 144, 214)
PLAYERS: tuple[Color, Color, Color, Color] = (BLUE, ORANGE, GREEN, PURPLE)
ICE, MIST, WALL, STEEL = (226, 238, 255), (150, 172, 206), (168, 176, 204), (58, 76, 112)
FOCUS, ALARM, GREY, BLACK, WHITE = (255, 236, 64), (255, 72, 72), (112, 112, 112), (0, 0, 0), (255, 255, 255)

# Line weights, px: the only four.
HAIR, THIN, LINE, BOLD = 2, 4, 6, 9
# Type sizes, px: the only five.
BODY, LABEL, SUB, TITLE, HERO = 40, 52, 72, 96, 200
LARGER = 1.2  # factor of readable texts, if the setting asks for it

CAPITALS = 0.70  # height of the capitals of both faces, em
STARS = "★☆"  # lit and unlit, in any text; the fonts have neither
STAR_RADIUS, STAR_ADVANCE, STAR_DROP = 0.42, 0.88, 0.04  # em; DROP: below the middle of the capitals
STAR_HOLE = 0.74  # size of the hole in an unlit star
UNLIT = (82, 95, 113)  # outline of an unlit star
_FACES = {
    "head": "oxanium-latin-700-normal.woff2",
    "hero": "oxanium-latin-800-normal.woff2",
    "body": "lexend-latin-500-normal.woff2",
}
MAX_FONTS = 48  # loaded ones; each keeps the glyphs it has rendered, 1 MB at 200 px


class _Reading:
    """The size of texts that people read, as a share of the usual one."""

    scale = 1.0


def read_large(large: bool) -> None:
    """Make readable texts larger, or as usual, from now on. What is drawn already stays as it is."""
    _Reading.scale = LARGER if large else 1.0


def reads_large() -> bool:
    """True if readable texts are larger than usual."""
    return _Reading.scale > 1.0


def readable(size: int) -> int:
    """The size at which a text is set whose box has room for larger ones, px."""
    return round(size * _Reading.scale)


def mix(a: Color, b: Color, t: float) -> Color:
    """Linear blend from colour `a` to `b`, t in 0..1."""
    return round(a[0] + (b[0] - a[0]) * t), round(a[1] + (b[1] - a[1]) * t), round(a[2] + (b[2] - a[2]) * t)


def dim(color: Color, k: float) -> Color:
    """A colour at the share `k` (0..1) of its brightness."""
    return mix(BLACK, color, k)


def font(face: str, size: int) -> pygame.font.Font:
    """A font of the face "head", "hero" (Oxanium) or "body" (Lexend), `size` px."""
    if not pygame.font.get_init():
        _loaded.cache_clear()
        pygame.font.init()
    return _loaded(face, size)


@lru_cache(maxsize=MAX_FONTS)
def _loaded(face: str, size: int) -> pygame.font.Font:
    if not _loaded.cache_info().currsize:
        pygame.register_quit(_loaded.cache_clear)  # fonts become invalid in pygame.quit
    return pygame.font.Font(BytesIO(_file(face)), size)


@cache
def _file(face: str) -> bytes:
    """The file of a face, which all its sizes share: from a path, each would keep it open."""
    return (ASSETS / "fonts" / _FACES[face]).read_bytes()


def text_width(text: str, size: int, face: str = "head") -> float:
    """Width of one line of text, px."""
    return line_width(text, face, size * 2) / 2


def line_width(text: str, face: str, size: int) -> int:
    """Width of a line as `line_image` renders it, px. Both kinds of stars are as wide."""
    return sum(
        len(part) * round(STAR_ADVANCE * size) if part[0] in STARS else font(face, size).size(part)[0]
        for part in _runs(text)
    )


def baseline(text: str, face: str, size: int) -> int:
    """The baseline of a line as `line_image` renders it, px from its top: accents above capitals push it down."""
    letters = font(face, size)
    tops = [metrics[3] for metrics in letters.metrics("".join(set(text) - set(STARS))) or () if metrics]
    return max(letters.get_ascent(), *tops) if tops else letters.get_ascent()


def line_image(text: str, face: str, size: int, color: Color) -> pygame.Surface:
    """A rendered line with per-pixel alpha. The fonts lack stars, so these are drawn: ★ filled, ☆ as an outline."""
    letters = font(face, size)
    if not any(star in text for star in STARS):
        return letters.render(text, True, color)
    base = baseline(text, face, size)
    higher = base - letters.get_ascent()
    out = pygame.Surface((line_width(text, face, size), letters.get_linesize() + higher), pygame.SRCALPHA)
    middle, advance, x = base - (CAPITALS / 2 - STAR_DROP) * size, round(STAR_ADVANCE * size), 0
    for part in _runs(text):
        if part[0] not in STARS:
            out.blit(image := letters.render(part, True, color), (x, base - baseline(part, face, size)))
            x += image.get_width()
            continue
        for star in part:
            lit, r, centre = star == STARS[0], STAR_RADIUS * size, x + advance / 2
            light = color if color == BLACK else FOCUS if lit else UNLIT
            pygame.draw.polygon(out, light, star_points(r, centre, middle))
            if not lit:
                pygame.draw.polygon(out, (0, 0, 0, 0), star_points(STAR_HOLE * r, centre, middle))
            x += advance
    return out


def _runs(text: str) -> list[str]:
    """A line split into stars and everything else."""
    return [part for part in re.split(f"([{STARS}]+)", text) if part]


def cut_box(x: float, y: float, w: float, h: float, c: float = 16) -> list[Point]:
    """A rectangle with corners cut at 45 degrees, like the letters of Oxanium."""
    return [
        (x + c, y),
        (x + w - c, y),
        (x + w, y + c),
        (x + w, y + h - c),
        (x + w - c, y + h),
        (x + c, y + h),
        (x, y + h - c),
        (x, y + c),
    ]


def regular_polygon(n: int, r: float, turn: float = 0.0, cx: float = 0, cy: float = 0) -> list[Point]:
    """`n` corners on a circle of radius `r` px round (cx, cy), the first at angle `turn` rad."""
    angles = [turn + i * math.tau / n for i in range(n)]
    return [(cx + r * math.cos(a), cy + r * math.sin(a)) for a in angles]


def star_points(r: float, cx: float = 0, cy: float = 0, turn: float = -math.pi / 2) -> list[Point]:
    """The ten corners of a star with points `r` px from (cx, cy), one of them in the direction `turn`."""
    tips, dents = regular_polygon(5, r, turn, cx, cy), regular_polygon(5, 0.46 * r, turn + 0.2 * math.pi, cx, cy)
    return [corner for pair in zip(tips, dents, strict=True) for corner in pair]


def shape_points(player: int, r: float) -> list[Point]:
    """The shape of seat 0..3, pointing along +x and of equal visual weight: circle, triangle, square, diamond."""
    if player == 0:
        return regular_polygon(48, r * 0.98)
    if player == 1:
        return regular_polygon(3, r * 1.28)
    if player == 2:
        return regular_polygon(4, r * 1.22, math.pi / 4)
    return regular_polygon(4, r * 1.24)
