"""Sprites of items and popups: pick-ups, mines, scores, small icons."""

import math

import pygame

from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw import BLACK, Color, GlowCanvas, baseline, font
from pigaming_app.ui.draw.sprites import Sprite, faded, trim
from pigaming_app.ui.draw.surface_cache import cached

POPUP_LEVELS = 6


@cached
def pickup(name: str) -> Sprite:
    """A power on the floor."""
    ink = kit.GlowCanvas(152, 152, 3).set_transform(76, 76)
    frame = kit.regular_polygon(6, 42, math.pi / 6)
    ink.solid(frame).neon(frame, kit.FOCUS, kit.THIN, True)
    kit.icon(ink, name, 0, 0, 23, kit.mix(kit.FOCUS, kit.WHITE, 0.5), 5)
    return trim(ink.sprite(1.0), 76, 76)


@cached
def mine(player: int, bright: bool) -> Sprite:
    """Mine in its owner's colour with the player number; an armed mine blinks with `bright`."""
    ink = kit.GlowCanvas(120, 120, 3).set_transform(60, 60)
    ink.solid(kit.regular_polygon(24, 25))
    kit.icon(ink, "mine", 0, 0, 27, kit.PLAYERS[player], 4)
    ink.disc(0, 0, 12, kit.ALARM if bright else kit.dim(kit.ALARM, 0.45))
    ink.text(str(player + 1), 20, 0, 0, kit.BLACK, "hero", "c")
    return trim(ink.sprite(1.0 if bright else 0.7), 60, 60)


@cached
def small_icon(name: str, color: kit.Color = kit.ICE, r: int = 16, width: float = kit.THIN) -> Sprite:
    """Icon as additive light, `r` px to each side."""
    ink = kit.GlowCanvas(2 * r + 64, 2 * r + 64, 3)
    kit.icon(ink, name, r + 32, r + 32, r, color, width)
    return trim(ink.lit(0.6), r + 32, r + 32)


@cached
def popup(text: str, player: int, level: int = POPUP_LEVELS) -> Sprite:
    """Rising score, opacity `level` of POPUP_LEVELS; a dark edge keeps it readable on any background."""
    if level < POPUP_LEVELS:
        return faded(popup(text, player), level / POPUP_LEVELS)
    return edged(text, kit.SUB, kit.PLAYERS[player])


def edged(text: str, size: int, color: Color) -> Sprite:
    """A word of `size` px with the middle of its capitals at (0, 0)."""
    face = font("hero", 2 * size)
    edge = face.render(text, True, BLACK)
    w, h = edge.get_width() // 2 + 64, size + 64
    ink = GlowCanvas(w, h).text(text, size, w / 2, h / 2, color, "hero", "c")
    dark = pygame.Surface((2 * w, 2 * h), pygame.SRCALPHA)
    x, y = w - edge.get_width() / 2, h - baseline(text, "hero", 2 * size) + 0.7 * size
    for i in range(12):
        dark.blit(edge, (x + 10 * math.cos(i * math.tau / 12), y + 10 * math.sin(i * math.tau / 12)))
    out = pygame.transform.smoothscale(dark, (w, h))
    out.blit(ink.lit(0.9), (0, 0), special_flags=pygame.BLEND_RGB_ADD)
    return trim(out, w / 2, h / 2)
