"""PiGaming, a robot arcade. Without a job it starts on its title; `JOB --help` lists the options of a job."""

import argparse
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from pigaming_app.jobs.terminal.command import own_command
from pigaming_app.jobs.terminal.options import KioskOptions, MatOptions, decimal, flag, integer, option
from pigaming_app.jobs.terminal.refusal import Refusal, module_of, refused, require
from pigaming_app.jobs.terminal.supervised import heartbeat, is_supervised
from pigaming_app.storage.safe_mode import DEFAULTS, is_safe

if TYPE_CHECKING:
    from pigaming_app.scenes.launch import Options


@dataclass(frozen=True, kw_only=True)
class RobotOptions(KioskOptions, MatOptions):
    """An arcade with robots, perhaps those of a ROS network."""

    plant: str = option("ros: robots of a ROS network", default="own", choices=["own", "ros"])
    width: float | None = option("ros: width of the arena; 2112", decimal(500.0, 10_000.0), metavar="MM")

    def ros_width(self) -> float | None:
        """Width of the arena of a ROS network, mm; None: it is not asked for. Raises Refusal without ROS."""
        if self.plant == "ros":
            return float(module_of("mat.ros", "ros").arena_width(self.width, self.emulate))
        if self.width is not None:
            raise Refusal("--width: only for --plant ros; `calibrate` measures a mat")
        return None


@dataclass(frozen=True, kw_only=True)
class ArcadeOptions(RobotOptions):
    """The whole arcade."""

    phones: bool = flag("phones may join as pads; saved in the settings")
    version: bool = option("print version and commit", default=False, action="store_true", name=("-V", "--version"))
    frames: int | None = option(argparse.SUPPRESS, integer())


def run(options: ArcadeOptions) -> int:
    """Open the arcade on its title. Raises Refusal."""
    if needs_supervisor(options):
        return supervised(options)
    from pigaming_app.boot.fetch import COMMAND
    from pigaming_app.scenes.launch import Options

    if options.emulate is not None:
        require("hardware")
    if options.phones:
        require("phones")
    return show(
        Options(
            kiosk=options.kiosk,
            display=options.display,
            scoreboard=options.scoreboard,
            frames=options.frames,
            emulator_seed=options.emulate,
            ros_width=options.ros_width(),
            emulated_things=options.things,
            fetch_networks=COMMAND,
            changed_settings=options.mat_settings() | ({"phones": True} if options.phones else {}),
        )
    )


def needs_supervisor(options: KioskOptions) -> bool:
    """True in a kiosk, except in the process that its supervisor has started."""
    return bool(options.kiosk) and not is_supervised()


def supervised(options: KioskOptions) -> int:
    """Run this same job under a supervisor; returns its exit code. Raises Refusal, OSError."""
    return int(module_of("kiosk.start", "kiosk").supervise(own_command(options.words)))


def show(options: "Options") -> int:
    """Run the arcade until it is closed, in safe mode without the options of screens and phones. Returns the exit code.

    Raises Refusal without a display.
    """
    from pigaming_app.scenes.start import run
    from pigaming_app.ui.window import NoDisplay

    if is_safe():
        changed = {name: value for name, value in options.changed_settings.items() if name not in DEFAULTS}
        options = replace(options, display=None, scoreboard=None, changed_settings=changed)
    with refused(NoDisplay):
        return run(replace(options, heartbeat=heartbeat()))
