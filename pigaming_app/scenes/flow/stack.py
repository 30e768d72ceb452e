"""Scenes lie on a stack; a scene answers a press with what shall become of the stack, and reaches for nothing."""

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import pygame

from pigaming_app.ui.input.events import InputEvent


class Scene(Protocol):
    """One screen."""

    def entered(self) -> None:
        """The scene has become the top one: just pushed, or what lay above it has gone."""

    def on(self, event: InputEvent) -> "Turn":
        """Answer a press."""

    def update(self, seconds: float) -> "Turn":
        """Let `seconds` of real time pass."""

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the whole canvas, 1920 x 1080."""


@runtime_checkable
class Closable(Protocol):
    """A scene that holds something, such as a camera, for as long as it lies on the stack."""

    def left(self) -> None:
        """Let go of it: the scene has been taken off the stack."""


@dataclass(frozen=True)
class Push:
    """Put a scene on top."""

    scene: Scene


@dataclass(frozen=True)
class Pop:
    """Take the top scene away."""


@dataclass(frozen=True)
class Swap:
    """Put a scene in the place of the top one."""

    scene: Scene


@dataclass(frozen=True)
class Home:
    """Back to the lowest scene, or to `scene` on top of it."""

    scene: Scene | None = None


@dataclass(frozen=True)
class Quit:
    """Close the arcade."""


Turn = Push | Pop | Swap | Home | Quit | None


class Stack:
    """The scenes that lie on each other; only the top one hears, moves and paints."""

    def __init__(self, first: Scene) -> None:
        self.scenes = [first]
        first.entered()

    @property
    def top(self) -> Scene:
        return self.scenes[-1]

    def turn(self, turn: Turn) -> None:
        """Carry out what the top scene answered. An empty stack means: close."""
        if turn is None:
            return
        before = self.scenes[:]
        match turn:
            case Push(scene):
                self.scenes.append(scene)
            case Pop():
                self.scenes.pop()
            case Swap(scene):
                self.scenes[-1] = scene
            case Home(scene):
                self.scenes[1:] = [scene] if scene else []
            case Quit():
                self.scenes.clear()
        self._leave(before)
        if self.scenes:
            self.top.entered()

    def clear(self) -> None:
        """Take every scene off. What one of them raises as it lets go is raised after all have."""
        before = self.scenes[:]
        self.scenes.clear()
        self._leave(before)

    def _leave(self, before: list[Scene]) -> None:
        """Let the scenes that are gone let go, the topmost first; then raise the first error among them."""
        errors: list[Exception] = []
        for scene in reversed(before):
            if scene not in self.scenes and isinstance(scene, Closable):
                try:
                    scene.left()
                except Exception as error:
                    errors.append(error)
        if errors:
            raise errors[0]
