"""A scripted walk through every screen of the arcade, which measures the CPU time of each frame.

A frame is events, update and draw, without the flip, which may wait for the display; only the thread of the frames
counts. The walk is the cold case: a fresh process with empty folders, in which nothing is cached but what the arcade
itself has prepared. Time is made up, and keys are real events.
"""

import json
from collections.abc import Callable
from time import thread_time
from typing import Any

import pygame

from pigaming_app.scenes.app import App, Options, opened
from pigaming_app.scenes.walk.tour import tour

FPS = 30
TAP = 2  # frames for which a key is held
PATIENCE = 60.0  # s to wait for a screen
WARM = 2.0  # s on the title before anything is pressed


class ScreenMissing(Exception):
    """A screen did not come."""


class Walker:
    """Somebody at the keyboard of an arcade; `worst`: ms of the longest frame, by the name given to each screen."""

    def __init__(self, app: App) -> None:
        self.app, self.context = app, app.context
        self.screen = "title"
        self.worst: dict[str, float] = {}

    @property
    def top(self) -> Any:
        """The scene that is shown."""
        return self.app.stack.top

    def on(self, kind: str) -> bool:
        """Whether a scene of that class is shown."""
        return type(self.top).__name__ == kind

    def at(self, screen: str) -> None:
        """Count what follows as frames of that screen."""
        self.screen = f"{screen} ({self.context.words.language})"

    def frame(self) -> None:
        """One frame."""
        began = thread_time()
        painted = self.app.compose(1 / FPS)
        spent = 1000.0 * (thread_time() - began)
        self.worst[self.screen] = max(spent, self.worst.get(self.screen, 0.0))
        if painted:
            self.context.canvas.flip()

    def wait(self, seconds: float) -> None:
        """Let time pass."""
        for _ in range(round(seconds * FPS)):
            self.frame()

    def until(self, true: Callable[[], bool]) -> None:
        """Let time pass until something is so. Raises Lost."""
        for _ in range(round(PATIENCE * FPS)):
            if true():
                return
            self.frame()
        raise ScreenMissing(f"{self.screen}: {type(self.top).__name__} is still shown")

    def press(self, *keys: str, pause: float = 0.1) -> None:
        """Tap keys one after the other."""
        for key in keys:
            scancode = getattr(pygame, f"KSCAN_{key.upper()}")
            for kind in (pygame.KEYDOWN, pygame.KEYUP):
                pygame.event.post(
                    pygame.Event(kind, key=pygame.key.key_code(key), scancode=scancode, mod=0, unicode="")
                )
                self.wait(TAP / FPS)
            self.wait(pause)


def walk() -> dict[str, float]:
    """Walk in this process; the first picture of all, for which nothing is shown yet, does not count."""
    with opened(Options(headless=True)) as app:
        walker = Walker(app)
        walker.frame()
        walker.worst.clear()
        walker.wait(WARM)
        tour(walker)
    return walker.worst


if __name__ == "__main__":
    print(json.dumps(walk()))
