"""What every scene may use: settings, scores, words, devices, sounds and the window."""

import logging
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from pigaming_app.ai.experiments.compiler import Compiler
from pigaming_app.scenes.flow.preload import Preloader
from pigaming_app.storage.scores import Scores
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.sounds import Sounds
from pigaming_app.ui.widgets.button_prompts import ROOM, ButtonPrompts
from pigaming_app.ui.window import Canvas

if TYPE_CHECKING:
    from pigaming_app.hardware.session.real import Mat


@dataclass
class Context:
    """One of each, made once, handed to every scene."""

    settings: Settings
    scores: Scores
    words: Words
    controls: Controls
    sounds: Sounds
    canvas: Canvas
    kiosk: bool = False
    idle: float = 0.0  # seconds since anyone pressed anything
    mat: "Mat | None" = None  # where real robots drive
    compiler: Compiler = field(default_factory=Compiler)  # of the Lab's training
    preloader: Preloader = field(default_factory=Preloader)
    emergency_stops: list[Callable[[], None]] = field(default_factory=list)  # each makes robots stand still, at once

    @property
    def robots(self) -> bool:
        """Whether real robots can be chosen for a match."""
        return self.mat is not None and (self.mat.emulated or self.settings.mat)

    def prompts(
        self,
        items: Sequence[tuple[Button, str]],
        y: int = 980,
        room: int = ROOM,
        solid: bool = False,
        voice: Callable[[], Device] | None = None,
    ) -> ButtonPrompts:
        """The row of hints of a page, see `ButtonPrompts`."""
        return ButtonPrompts(self.words, self.controls, items, y, room, solid, voice)

    def stop_all_robots(self) -> None:
        """Stop every robot that a scene has started: when a scene failed, and whenever the arcade ends."""
        for stop in self.emergency_stops:
            try:
                stop()
            except Exception:
                logging.getLogger("pigaming").exception("robots could not be stopped")
