"""A headless arcade for scripted play: real controls and scenes, simulated time, recorded sounds."""

from collections.abc import Callable
from typing import Any, TypeVar

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.scenes.app import App
from pigaming_app.scenes.flow.scene import Context, Scene, Stack, StackOperation
from pigaming_app.scenes.guard import Guard
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.awards.moment import AwardsMoment
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.sim.world import HZ
from pigaming_app.storage.scores import Scores
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.sounds import Sounds
from pigaming_app.ui.window import Canvas
from tests.matches import setup_of
from tests.ui.input.virtual_pad import VirtualPad

S = TypeVar("S")
Opened = TypeVar("Opened", bound=Scene)
KEYS = [Device("keys", number) for number in range(4)]


class Noted(Sounds):
    """Sounds that are recorded instead of played."""

    def __init__(self) -> None:
        super().__init__()
        self.heard: list[str] = []
        self.themes: list[str | None] = []  # also "held" and "finale", each once in a row

    def play(self, name: str, player: int | None = None, pan: float = 0.0) -> None:
        self.heard.append(name)

    def music(self, theme: str | None) -> None:
        self._note(theme)

    def hold_music(self) -> None:
        self._note("held")

    def finale(self) -> None:
        self._note("finale")

    def _note(self, theme: str | None) -> None:
        if self.themes[-1:] != [theme]:
            self.themes.append(theme)


class Floor:
    """A lowest scene without behaviour."""

    def on_enter(self) -> None:
        pass

    def handle(self, event: InputEvent) -> StackOperation:
        return None

    def update(self, seconds: float) -> StackOperation:
        return None

    def draw(self, screen: pygame.Surface) -> None:
        pass


class Arcade:
    """A stack of scenes above two floors (a title and a setup), with simulated input."""

    def __init__(self, controls: Controls, language: str = "en") -> None:
        pygame.font.init()
        canvas = Canvas.open(Settings(fullscreen=False), headless=True)
        self.screen, self.sounds = canvas.screen, Noted()
        self.context = Context(Settings(), Scores(), Words(language), controls, self.sounds, canvas)
        self.pads: list[VirtualPad] = []
        self.title: Scene = Floor()
        self.setup: Scene = Floor()
        self.stack = Stack(self.title)
        self.stack.scenes.append(self.setup)

    def open(self, scene: Opened) -> Opened:
        """Put a scene on top."""
        self.stack.scenes.append(scene)
        scene.on_enter()
        return scene

    def press(self, *buttons: Button, device: Device = KEYS[0]) -> None:
        """Press buttons, each on the scene that is then on top."""
        for button in buttons:
            self._handle(InputEvent(button, device))

    def _handle(self, event: InputEvent) -> None:
        self.stack.apply(Guard(self.context).handle(self.stack.scenes, event))

    def plug(self, *about: Any, **more: Any) -> tuple[VirtualPad, Device]:
        """A virtual pad that is plugged in, and the device that it is."""
        self.pads.append(VirtualPad(*about, **more))
        self.frame()
        return self.pads[-1], Device("pad", self.pads[-1].number)

    def click(self, x: float, y: float) -> None:
        self._handle(InputEvent(Button.CLICK, Device("mouse"), at=(x, y)))

    def frame(self, seconds: float = 1 / 30, draw: bool = False) -> None:
        """One iteration of the main loop."""
        controls = self.context.controls
        for event in [*controls.presses(pygame.event.get()), *controls.repeats(seconds)]:
            self._handle(event)
        self.stack.apply(Guard(self.context).advance(self.stack.scenes, seconds))
        if draw:
            self.stack.top.draw(self.screen)

    def wait(self, seconds: float, fps: int = 30, draw: bool = False) -> None:
        """Run frames for `seconds` of simulated time."""
        for _ in range(round(seconds * fps)):
            self.frame(1 / fps, draw)

    def until(self, condition: Callable[[], bool], timeout: float = 30.0) -> float:
        """Run frames until `condition()`; returns the seconds it took."""
        for frame in range(round(timeout * 30)):
            if condition():
                return frame / 30
            self.frame()
        raise AssertionError(f"not so within {timeout} s; on top lies {type(self.stack.top).__name__}")

    def reach(self, scene_class: type[S], timeout: float = 30.0) -> S:
        """Run frames until a scene of this class is on top."""
        self.until(lambda: isinstance(self.stack.top, scene_class), timeout)
        return self.shown(scene_class)

    def finish(self, *scores: int) -> MatchScene:
        """Play the match on top to its end, with these scores, up to the winner's moment."""
        scene = self.shown(MatchScene)
        scene.opening.countdown.seconds_left = 0.05
        self.until(lambda: not scene.opening.countdown.locked)
        for robot, score in zip(scene.match.state.robots, scores, strict=False):
            robot.score = score
        rules = scene.match.state.rules
        rules.ticks = scene.match.state.tick + 1
        if hasattr(rules, "overtime"):
            rules.overtime = min(rules.overtime, 5 * HZ)  # nobody is there to end it
        self.until(lambda: isinstance(self.stack.top, WinnersMoment))
        return scene

    def skip_moments(self, device: Device = KEYS[0]) -> None:
        """Skip the winner's moment, and that of the awards."""
        while isinstance(self.stack.top, WinnersMoment | AwardsMoment):
            self.wait(1.8)
            self.press(Button.FIRE, device=device)

    def key(self, name: str, seconds: float = 0.0, letter: str = "") -> None:
        """Hold a key, through the real controls, for `seconds` or one frame."""
        codes = getattr(pygame, f"K_{name}"), getattr(pygame, f"KSCAN_{name.upper()}")
        about = {"key": codes[0], "scancode": codes[1], "mod": 0, "unicode": letter}
        pygame.event.post(pygame.Event(pygame.KEYDOWN, about))
        self.wait(max(seconds, 1 / 30), draw=True)
        pygame.event.post(pygame.Event(pygame.KEYUP, about))
        self.frame()

    def shown(self, scene_class: type[S]) -> S:
        """The top scene, which must be of this class; drawn once, so that every scene of a story is drawn."""
        top = self.stack.top
        assert isinstance(top, scene_class), f"{type(top).__name__} is on top"
        self.stack.top.draw(self.screen)
        return top


def service_of(app: App, kind: type[S]) -> S:
    """The service of this class in a running arcade."""
    return next(service for service in app.services if isinstance(service, kind))


def setup(brains: str, minutes: float = 0.1, teams: tuple[int, ...] = (0, 1, 2, 3), seed: int = 3) -> Setup:
    """A match of PiTanks in the classic arena; `brains` such as "human human level1 off"."""
    return setup_of("pitanks", brains, "classic", minutes, seed, "plain", teams=teams)
