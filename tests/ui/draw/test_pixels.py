"""Surfaces as arrays and back: the colours of single pixels, and no surface that stays locked."""

import numpy as np
import pygame

from pigaming_app.ui.draw.pixels import bgra_surface, pixels_of


def test_pixels_come_and_go_with_their_colours() -> None:
    surface = pygame.Surface((7, 5), depth=32)  # without a window, hence without alpha
    surface.set_at((6, 4), (10, 20, 30))
    pixels = pixels_of(surface)
    assert pixels.shape == (5, 7, 4)
    assert pixels[4, 6, :3].tolist() == [30, 20, 10]
    target = pygame.Surface((7, 5), depth=32)
    target.fill("white")
    target.blit(bgra_surface(pixels), (0, 0))
    assert target.get_at((6, 4))[:3] == (10, 20, 30)
    assert target.get_at((0, 0))[:3] == (0, 0, 0)


def test_kept_pixels_do_not_lock_a_surface() -> None:
    """The overseer of plug-ins holds the frame of a running call for a moment, and all variables in it."""
    surface = pygame.Surface((64, 48), depth=32)
    kept = pixels_of(surface)
    assert not surface.get_locked()
    surface.fill("white")
    assert not np.any(kept[:, :, :3])
