"""A scripted walk through every screen of the arcade, measuring the CPU time of each frame.

A frame is events, update and draw, without the flip, which may wait for the display; only the frame thread counts. The
walk is the cold case: a new process with empty folders and only the arcade's own prewarming. Time is simulated; keys
are real events.
"""

import json
from collections.abc import Callable
from time import thread_time
from typing import Any

import pygame

from pigaming_app.scenes.app import App
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.start import opened
from pigaming_app.scenes.walk.tour import tour

FPS = 30
TAP = 2  # frames for which a key is held
TIMEOUT = 60.0  # s, timeout for a screen to appear
SETTLE = 2.0  # s on the title before the first input


class ScreenMissing(Exception):
    """A screen did not appear in time."""


class Walker:
    """A simulated keyboard user; `worst`: ms of the longest frame by screen."""

    def __init__(self, app: App) -> None:
        self.app, self.context = app, app.context
        self.screen = "title"
        self.worst: dict[str, float] = {}

    @property
    def top(self) -> Any:
        """The current scene."""
        return self.app.stack.top

    def shows(self, class_name: str) -> bool:
        """True if the current scene is of this class."""
        return type(self.top).__name__ == class_name

    def set_screen(self, screen: str) -> None:
        """Attribute the following frames to a screen."""
        self.screen = f"{screen} ({self.context.words.language})"

    def frame(self) -> None:
        """Run and measure one frame."""
        start = thread_time()
        painted = self.app.compose(1 / FPS)
        spent = 1000.0 * (thread_time() - start)
        self.worst[self.screen] = max(spent, self.worst.get(self.screen, 0.0))
        if painted:
            self.context.canvas.flip()

    def wait(self, seconds: float) -> None:
        """Run frames for `seconds`."""
        for _ in range(round(seconds * FPS)):
            self.frame()

    def wait_until(self, condition: Callable[[], bool]) -> None:
        """Run frames until `condition()`. Raises ScreenMissing."""
        for _ in range(round(TIMEOUT * FPS)):
            if condition():
                return
            self.frame()
        raise ScreenMissing(f"{self.screen}: {type(self.top).__name__} is still shown")

    def press(self, *keys: str, pause: float = 0.1) -> None:
        """Tap keys in turn."""
        for key in keys:
            scancode = getattr(pygame, f"KSCAN_{key.upper()}")
            for kind in (pygame.KEYDOWN, pygame.KEYUP):
                pygame.event.post(
                    pygame.Event(kind, key=pygame.key.key_code(key), scancode=scancode, mod=0, unicode="")
                )
                self.wait(TAP / FPS)
            self.wait(pause)


def walk() -> dict[str, float]:
    """Run the tour in this process. The very first picture is not measured."""
    with opened(Options(headless=True)) as app:
        walker = Walker(app)
        walker.frame()
        walker.worst.clear()
        walker.wait(SETTLE)
        tour(walker)
    return walker.worst


if __name__ == "__main__":
    print(json.dumps(walk()))
