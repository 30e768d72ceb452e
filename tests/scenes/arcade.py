"""An arcade without a window, for scripted play: real controls and scenes, made-up time, sounds only noted."""

from collections.abc import Callable
from typing import TypeVar, cast

import pygame

from pigaming_app.games.game import Seat, Setup
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Scene, Stack, Turn
from pigaming_app.storage.scores import Scores
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.sounds import Sounds
from pigaming_app.ui.window import Canvas

S = TypeVar("S")
KEYS = [Device("keys", number) for number in range(4)]


class Noted(Sounds):
    """Sounds that nobody hears."""

    def __init__(self) -> None:
        super().__init__()
        self.heard: list[str] = []

    def play(self, name: str, player: int | None = None, pan: float = 0.0) -> None:
        self.heard.append(name)


class Floor:
    """A lowest scene on which nothing happens."""

    def entered(self) -> None:
        pass

    def on(self, event: InputEvent) -> Turn:
        return None

    def update(self, seconds: float) -> Turn:
        return None

    def draw(self, screen: pygame.Surface) -> None:
        pass


class Arcade:
    """Scenes on a stack above two floors (a title and a setup), and somebody who presses."""

    def __init__(self, controls: Controls, language: str = "en") -> None:
        pygame.font.init()
        self.screen = pygame.display.set_mode((1920, 1080))
        self.sounds = Noted()
        nowhere = cast(Canvas, None)
        self.context = Context(Settings(), Scores(), Words(language), controls, self.sounds, nowhere)
        self.title, self.setup = Floor(), Floor()
        self.stack = Stack(self.title)
        self.stack.scenes.append(self.setup)

    def open(self, scene: Scene) -> None:
        self.stack.scenes.append(scene)
        scene.entered()

    def press(self, button: Button, device: Device = KEYS[0]) -> None:
        self.stack.turn(self.stack.top.on(InputEvent(button, device)))

    def click(self, x: float, y: float) -> None:
        self.stack.turn(self.stack.top.on(InputEvent(Button.CLICK, Device("mouse"), at=(x, y))))

    def frame(self, seconds: float = 1 / 30, draw: bool = False) -> None:
        """One turn of the loop of the real arcade."""
        controls = self.context.controls
        for event in [*controls.presses(pygame.event.get()), *controls.repeats(seconds)]:
            self.stack.turn(self.stack.top.on(event))
        self.stack.turn(self.stack.top.update(seconds))
        if draw:
            self.stack.top.draw(self.screen)

    def wait(self, seconds: float, fps: int = 30, draw: bool = False) -> None:
        """Let made-up time pass."""
        for _ in range(round(seconds * fps)):
            self.frame(1 / fps, draw)

    def until(self, true: Callable[[], bool], most: float = 30.0) -> float:
        """Let time pass until something is so; answers how long that took."""
        for frame in range(round(most * 30)):
            if true():
                return frame / 30
            self.frame()
        raise AssertionError(f"not so within {most} s; on top lies {type(self.stack.top).__name__}")

    def shown(self, kind: type[S]) -> S:
        """The top scene, which must be of this kind; painted once, so that every scene of a story is painted."""
        top = self.stack.top
        assert isinstance(top, kind), f"{type(top).__name__} is on top"
        self.stack.top.draw(self.screen)
        return top


def setup(brains: str, minutes: float = 0.1, teams: tuple[int, ...] = (0, 1, 2, 3), seed: int = 3) -> Setup:
    """A match of PiTanks in the classic arena; `brains` such as "human human easy off"."""
    one, two, three, four = (Seat(brain, team) for brain, team in zip(brains.split(), teams, strict=True))
    return Setup("pitanks", "classic", (one, two, three, four), minutes, seed, "plain")
