"""A scene: the context that it gets, the mat with real robots in it, and the stack operations that it returns."""

import logging
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol, TypeVar, runtime_checkable

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.flow.driving import DrivingStyles
from pigaming_app.scenes.flow.preload import Preloader
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.storage.day_log import DayLog, now
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.scores import Scores
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent, StickState
from pigaming_app.ui.sounds import Sounds
from pigaming_app.ui.widgets.button_prompts import ROOM, ButtonPrompts
from pigaming_app.ui.widgets.notices import Notices
from pigaming_app.ui.window import Canvas

T = TypeVar("T")


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


class RobotMat(Protocol):
    """The real robots of a running arcade."""

    @property
    def available(self) -> bool:
        """True if seats can be given to real robots."""

    @property
    def problem(self) -> OperatorMessage | None:
        """Why the settings forbid matches with real robots, or None."""

    @property
    def scans(self) -> bool:
        """True if our own camera finds things on the mat."""

    @property
    def things(self) -> tuple[ThingSpec, ...]:
        """The things on the mat, as they were scanned last; none if blocks mark them."""

    def has_room(self, game: str, arena: str, robots: Collection[int]) -> bool:
        """True if these real robots are narrow enough on their surface for an arena."""

    def stick(self, seat: int, first: bool) -> StickState | None:
        """The joystick of a seat in a network of robots; None without one. `first`: it is the first person's."""

    def arena_page(self, devices: Callable[[], Sequence[Device | None]]) -> Scene:
        """The page on which an arena is built of real things."""

    def match(
        self,
        setup: Setup,
        devices: Sequence[Device | None],
        real: Collection[int],
        game_choice: Callable[..., Scene] | None = None,
        rounds: Rounds | None = None,
        things: Sequence[ThingSpec] | None = None,
        after: Callable[..., Any] | None = None,
    ) -> Scene:
        """The match with real robots on the seats `real`, or the page with the reason why not. `things`: on the mat;
        None: as they were scanned last, unless they are blocks. The rest: see `MatchScene`.
        """

    def stop(self) -> None:
        """Stop all robots; a match may follow."""

    def end(self) -> None:
        """Close for good."""


@dataclass
class Context:
    """Created once and passed to every scene."""

    settings: Settings
    scores: Scores
    words: Words
    controls: Controls
    sounds: Sounds
    canvas: Canvas
    kiosk: bool = False
    idle: float = 0.0  # seconds since the last input
    mat: RobotMat | None = None
    notices: Notices = field(default_factory=Notices)
    preloader: Preloader = field(default_factory=Preloader)
    driving: DrivingStyles = field(init=False)
    day_log: DayLog = field(default_factory=DayLog)
    dropped: list[Path] = field(default_factory=list)  # files dropped onto the window
    emergency_stops: list[Callable[[], None]] = field(default_factory=list)  # callbacks that stop robots at once
    _shared: dict[object, Any] = field(default_factory=dict)  # see `shared`

    def __post_init__(self) -> None:
        self.driving = DrivingStyles(self.settings)

    @property
    def robots(self) -> bool:
        """True if matches with real robots are available."""
        return self.mat is not None and self.mat.available

    @property
    def robots_problem(self) -> OperatorMessage | None:
        """Why the settings forbid matches with real robots, or None."""
        return self.mat.problem if self.mat else None

    def prompts(
        self,
        items: Sequence[tuple[Button, str]],
        y: int = 980,
        room: int = ROOM,
        solid: bool = False,
        device: Callable[[], Device] | None = None,
    ) -> ButtonPrompts:
        """A page's row of button prompts, see `ButtonPrompts`."""
        return ButtonPrompts(self.words, self.controls, items, y, room, solid, device)

    def shared(self, make: Callable[["Context"], T]) -> T:
        """The one object of this context that `make` makes, at first use: the state of a feature."""
        if make not in self._shared:
            self._shared[make] = make(self)
        made: T = self._shared[make]
        return made

    @property
    def quiet(self) -> bool:
        """True in the quiet hours: title and attract mode are silent."""
        return self.settings.quiet(now().time())

    def hush(self) -> None:
        """Hold the music and stop rumbling, for a page over a match."""
        self.sounds.hold_music()
        self.controls.stop_rumble()

    def stop_all_robots(self) -> None:
        """Stop all robots: after a scene failure, and when the arcade ends."""
        for stop in self.emergency_stops:
            try:
                stop()
            except Exception:
                logging.getLogger("pigaming").exception("robots could not be stopped")
