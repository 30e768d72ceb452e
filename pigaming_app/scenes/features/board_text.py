"""Lines, badges and numbers of the second screen, in a cache of their own, so that no sprite of a match is evicted."""

import pygame

from pigaming_app.ui.draw import ICE, STEEL, THIN, Color, GlowCanvas, badge, cut_box, icon, text_width
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import fit_size
from pigaming_app.ui.draw.surface_cache import SurfaceCache

CACHE = SurfaceCache(24 << 20)  # bytes
EDGE = 28  # px of glow
NUMBER_ADVANCE = 0.6  # em


@CACHE.cached
@resumable
def line(text: str, size: int, color: Color, face: str) -> Steps[pygame.Surface]:
    """One line with its glow and EDGE px round it; its capitals are centred vertically."""
    ink = GlowCanvas(round(text_width(text, size, face)) + 2 * EDGE, round(1.3 * size) + 2 * EDGE)
    yield
    ink.text(text, size, EDGE, ink.h / 2, color, face)
    yield
    if face == "body":
        return (yield from ink.downscale_steps())
    return (yield from ink.lit_steps(0.5))


@CACHE.cached
@resumable
def player_badge(player: int, r: int) -> Steps[pygame.Surface]:
    """The badge of a seat, its middle in the middle of the picture."""
    ink = GlowCanvas(3 * r + 2 * EDGE, 3 * r + 2 * EDGE)
    badge(ink, player, ink.w / 2, ink.h / 2, r)
    yield
    return (yield from ink.lit_steps(0.5))


@CACHE.cached
@resumable
def symbol(name: str, r: int, color: Color) -> Steps[pygame.Surface]:
    """An icon, its middle in the middle of the picture."""
    ink = GlowCanvas(2 * r + 2 * EDGE, 2 * r + 2 * EDGE)
    icon(ink, name, ink.w / 2, ink.h / 2, r, color, THIN + 1)
    yield
    return (yield from ink.lit_steps(0.5))


@CACHE.cached
@resumable
def outline(w: int, h: int, color: Color) -> Steps[pygame.Surface]:
    """A box with cut corners, w x h px."""
    ink = GlowCanvas(w, h, 1)
    yield
    ink.line(cut_box(3, 3, w - 6, h - 6, 20), color, THIN, True)
    return (yield from ink.downscale_steps())


def write(
    screen: pygame.Surface,
    text: str,
    size: int,
    x: float,
    y: float,
    color: Color = ICE,
    face: str = "head",
    align: str = "l",
    room: int = 1728,
) -> int:
    """Draw a line at (x, y), the middle of its capitals, at most `room` px wide. Returns its width, px."""
    image = line(text, fit_size(text, size, room, face), color, face)
    w = image.get_width() - 2 * EDGE
    left = x - EDGE - w * {"l": 0.0, "c": 0.5, "r": 1.0}[align]
    _add(screen, image, left, y - image.get_height() / 2)
    return w


def write_number(screen: pygame.Surface, text: str, size: int, x: float, y: float, color: Color, align: str) -> None:
    """Draw a number in figures of one width, each of them cached: only new figures cost time."""
    advance = [round(size * (NUMBER_ADVANCE if char.isdigit() or char in "−–/" else 0.32)) for char in text]
    left = x - sum(advance) * {"l": 0.0, "c": 0.5, "r": 1.0}[align]
    for char, wide in zip(text, advance, strict=True):
        image = line(char, size, color, "hero")
        _add(screen, image, left + (wide - image.get_width()) / 2, y - image.get_height() / 2)
        left += wide


def put(screen: pygame.Surface, image: pygame.Surface, x: float, y: float) -> None:
    """Draw a picture centred at (x, y)."""
    _add(screen, image, x - image.get_width() / 2, y - image.get_height() / 2)


def rule(screen: pygame.Surface, y: int, color: Color = STEEL) -> None:
    """A line across the screen."""
    pygame.draw.rect(screen, color, (0, y - 2, screen.get_width(), THIN))


def _add(screen: pygame.Surface, image: pygame.Surface, x: float, y: float) -> None:
    screen.blit(image, (round(x), round(y)), special_flags=pygame.BLEND_RGB_ADD)
