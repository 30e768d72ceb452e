"""Fixtures of tests of views."""

import pygame
import pytest


@pytest.fixture
def screen() -> pygame.Surface:
    """The window, with fonts to write on it."""
    pygame.display.init()
    pygame.font.init()
    return pygame.display.set_mode((1920, 1080))
