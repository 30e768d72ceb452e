"""Glowing words with a dark edge, which keeps them readable on any background."""

import math

import pygame

from pigaming_app.ui.draw import BLACK, Color, GlowCanvas, baseline, font
from pigaming_app.ui.draw.sprites import Sprite, trim


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
