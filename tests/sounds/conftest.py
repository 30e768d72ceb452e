"""The mixer, which decodes the files."""

from collections.abc import Iterator

import pygame
import pytest

from tests.sounds.meter import RATE


@pytest.fixture
def mixer() -> Iterator[None]:
    pygame.mixer.init(RATE, -16, 2, 512, allowedchanges=0)
    yield
    pygame.mixer.quit()
