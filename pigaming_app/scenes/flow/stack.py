"""The scene stack. Scenes handle input by returning a stack operation; they never touch the stack."""

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import pygame

from pigaming_app.ui.input.events import InputEvent


class Scene(Protocol):
    """One screen."""

    def on_enter(self) -> None:
        """Called when the scene becomes the top one: after a push, or when the scene above is popped."""

    def handle(self, event: InputEvent) -> "StackOperation":
        """Handle an input event."""

    def update(self, seconds: float) -> "StackOperation":
        """Advance by `seconds` of real time."""

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the whole canvas, 1920 x 1080."""


@runtime_checkable
class Closable(Protocol):
    """A scene that holds a resource, such as a camera, while it is on the stack."""

    def on_leave(self) -> None:
        """Release it: the scene was removed from the stack."""


@dataclass(frozen=True)
class Push:
    """Push a scene."""

    scene: Scene


@dataclass(frozen=True)
class Pop:
    """Pop the top scene."""


@dataclass(frozen=True)
class Swap:
    """Replace the top scene."""

    scene: Scene


@dataclass(frozen=True)
class Home:
    """Return to the lowest scene, with `scene` on top of it if given."""

    scene: Scene | None = None


@dataclass(frozen=True)
class Quit:
    """Close the arcade."""


StackOperation = Push | Pop | Swap | Home | Quit | None


class Stack:
    """The scene stack; only the top scene gets input, updates and draws."""

    def __init__(self, first: Scene) -> None:
        self.scenes = [first]
        first.on_enter()

    @property
    def top(self) -> Scene:
        return self.scenes[-1]

    def apply(self, operation: StackOperation) -> None:
        """Apply a stack operation. An empty stack closes the arcade."""
        if operation is None:
            return
        before = self.scenes[:]
        match operation:
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
            self.top.on_enter()

    def clear(self) -> None:
        """Remove all scenes. Errors raised in `on_leave` are raised after all scenes have been closed."""
        before = self.scenes[:]
        self.scenes.clear()
        self._leave(before)

    def _leave(self, before: list[Scene]) -> None:
        """Close the removed scenes, topmost first; then raise the first error among them."""
        errors: list[Exception] = []
        for scene in reversed(before):
            if scene not in self.scenes and isinstance(scene, Closable):
                try:
                    scene.on_leave()
                except Exception as error:
                    errors.append(error)
        if errors:
            raise errors[0]
