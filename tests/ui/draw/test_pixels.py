"""Surfaces as arrays and back: the colours of single pixels, no surface that stays locked, and blurs in bands."""

import numpy as np
import pygame

from pigaming_app.ui.draw.frame_budget import run_to_end
from pigaming_app.ui.draw.glow import blur_steps
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


def test_a_blur_in_bands_is_that_of_pygame_at_once() -> None:
    light = pygame.Surface((960, 541))
    pygame.surfarray.blit_array(light, np.random.default_rng(5).integers(0, 256, (960, 541, 3)))
    for radius in (1, 3, 6):
        in_bands = run_to_end(blur_steps(light, radius))
        at_once = pygame.transform.gaussian_blur(light, radius)
        assert np.array_equal(pygame.surfarray.array3d(in_bands), pygame.surfarray.array3d(at_once)), radius
