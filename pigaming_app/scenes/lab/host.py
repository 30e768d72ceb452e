"""Interface of the Lab for the pages above it."""

from typing import Protocol

import pygame

from pigaming_app.ai.networks.files import TrainedNetwork
from pigaming_app.ai.qlearning.table_files import Trained
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.lab.network.trainer import NetworkTrainer
from pigaming_app.scenes.lab.trainer import Trainer

IDLE = 90.0  # s without input before the return to the Lab
DARK = 72  # 0..255, brightness of the Lab behind a page


class LabHost(Protocol):
    """The Lab below a page."""

    context: Context
    name: str

    @property
    def trainer(self) -> Trainer | NetworkTrainer:
        """The training that is shown."""

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the Lab."""

    def show_message(self, message: str, wrong: bool = False) -> None:
        """Show a message for a few seconds."""

    def begin(self) -> None:
        """Start again with a robot that knows nothing."""

    def open(self, robot: Trained | TrainedNetwork, name: str) -> None:
        """Continue with a saved robot. Raises RobotFileError."""


def dimmed_background(lab: LabHost) -> pygame.Surface:
    """The Lab, dimmed, as the background of a page."""
    canvas = pygame.Surface((1920, 1080))
    lab.draw(canvas)
    canvas.fill((DARK, DARK, DARK), special_flags=pygame.BLEND_RGB_MULT)
    return canvas
