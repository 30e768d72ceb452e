"""Every test of the scenes runs without a screen and without a sound card."""

import os
from collections.abc import Iterator

os.environ["SDL_VIDEODRIVER"] = "dummy"
os.environ["SDL_AUDIODRIVER"] = "dummy"
os.environ["PYGAME_HIDE_SUPPORT_PROMPT"] = "1"

import pygame
import pytest

from pigaming_app.scenes.controls import Controls


@pytest.fixture
def controls() -> Iterator[Controls]:
    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    pygame.event.clear()
    yield Controls()
    pygame.event.clear()
