"""The context shared by all scenes: settings, scores, texts, devices, sound and window."""

import logging
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from pigaming_app.scenes.flow.driving import DrivingStyles
from pigaming_app.scenes.flow.preload import Preloader
from pigaming_app.scenes.flow.robot_mat import RobotMat
from pigaming_app.storage.day_log import DayLog, now
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.scores import Scores
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.sounds import Sounds
from pigaming_app.ui.widgets.button_prompts import ROOM, ButtonPrompts
from pigaming_app.ui.widgets.notices import Notices
from pigaming_app.ui.window import Canvas

T = TypeVar("T")


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
