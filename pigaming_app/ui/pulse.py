"""Signs of life for a supervisor: a beat a frame, and now and then a small copy of the screen for a crash report."""

from collections.abc import Callable
from time import monotonic

import pygame

from pigaming_app.storage.heartbeat import PICTURE, Heartbeat

INTERVAL = 2.0  # s between two copies


class Pulse:
    """Beats `heartbeat`. `clock`: s."""

    def __init__(self, heartbeat: Heartbeat, clock: Callable[[], float] = monotonic) -> None:
        self._heartbeat, self._clock = heartbeat, clock
        self._copied = clock()

    def beat(self, screen: pygame.Surface) -> None:
        """Call once a frame; `screen` is what was drawn last."""
        self._heartbeat.beat()
        if self._clock() - self._copied >= INTERVAL:
            self._copied = self._clock()
            small = pygame.transform.scale(screen, PICTURE)
            self._heartbeat.show(PICTURE, pygame.image.tobytes(small, "RGB"))
