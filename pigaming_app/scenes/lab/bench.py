"""The Lab as the pages above it see it."""

from typing import Protocol

import pygame

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.lab.trainer import Trainer

IDLE = 90.0  # seconds without a press until the Lab
DARK = 72  # of 255: how bright the Lab is behind a page


class LabHost(Protocol):
    """The Lab below a page."""

    context: Context
    trainer: Trainer
    name: str

    def draw(self, screen: pygame.Surface) -> None:
        """Paint it."""

    def say(self, sentence: str, wrong: bool = False) -> None:
        """Show a sentence for a while."""

    def begin(self) -> None:
        """Everything from an empty table."""


def behind(lab: LabHost) -> pygame.Surface:
    """The Lab as it lies behind a page."""
    canvas = pygame.Surface((1920, 1080))
    lab.draw(canvas)
    canvas.fill((DARK, DARK, DARK), special_flags=pygame.BLEND_RGB_MULT)
    return canvas
