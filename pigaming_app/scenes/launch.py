"""Options of the arcade, filled in by the jobs."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.storage.heartbeat import Heartbeat


@dataclass(frozen=True)
class Options:
    """Options of the arcade. `frames`: close after this many; `screenshot`: path of a picture, taken when due."""

    first_scene: Callable[[Context], Scene] | None = None  # scene pushed on top of the title
    without_title: bool = False  # show only that scene; close when it is popped
    kiosk: bool = False
    heartbeat: Heartbeat | None = None  # for a supervisor, beaten once a frame
    display: int | None = None
    scoreboard: int | None = None  # display of the second screen, from 1, instead of that of the settings
    headless: bool = False
    frames: int | None = None
    screenshot: Path | None = None
    screenshot_due: Callable[[], bool] = lambda: True
    step: float | None = None  # s of simulated time per frame, instead of real time
    should_close: Callable[[], bool] = lambda: False  # close after this picture if true
    ros_width: float | None = None  # mm, width of the arena of robots in a ROS network
    emulator_seed: int | None = None  # seed of an emulated arena instead of the real one
    emulated_things: int = 0  # real things on its mat
    fetch_networks: tuple[str, ...] = ()  # command that fetches what networks need in the Lab
    changed_settings: Mapping[str, object] = field(default_factory=dict)  # settings to store
