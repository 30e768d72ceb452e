"""PiGaming, a robot arcade. Without a job it starts on its title; `JOB --help` lists the options of a job."""

import argparse
from argparse import ArgumentParser, Namespace
from dataclasses import replace
from typing import TYPE_CHECKING

from pigaming_app.jobs.terminal.command import own_command
from pigaming_app.jobs.terminal.options import decimal, display, integer, mat_options, mat_settings, shared
from pigaming_app.jobs.terminal.refusal import Refusal, module_of, refused, require
from pigaming_app.jobs.terminal.supervised import heartbeat, is_supervised
from pigaming_app.storage.safe_mode import DEFAULTS, is_safe

if TYPE_CHECKING:
    from pigaming_app.scenes.launch import Options


def options(parser: ArgumentParser) -> None:
    parser.usage = "%(prog)s [JOB] [OPTIONS]"
    shared(parser, "--kiosk", "--display", "--scoreboard")
    mat_options(parser)
    parser.add_argument("--phones", action="store_true", help="phones may join as pads; saved in the settings")
    ros_options(parser)
    parser.add_argument("-V", "--version", action="store_true", help="print version and commit")
    parser.add_argument("--frames", type=integer(), help=argparse.SUPPRESS)


def run(arguments: Namespace) -> int:
    """Open the arcade on its title. Raises Refusal."""
    if needs_supervisor(arguments):
        return supervised(arguments)
    from pigaming_app.boot.fetch import COMMAND
    from pigaming_app.scenes.launch import Options

    if arguments.emulate is not None:
        require("hardware")
    if arguments.phones:
        require("phones")
    return show(
        Options(
            kiosk=arguments.kiosk,
            display=display(arguments),
            scoreboard=arguments.scoreboard,
            frames=arguments.frames,
            emulator_seed=arguments.emulate,
            ros_width=ros_width(arguments),
            emulated_things=arguments.things,
            fetch_networks=COMMAND,
            changed_settings=mat_settings(arguments) | ({"phones": True} if arguments.phones else {}),
        )
    )


def needs_supervisor(arguments: Namespace) -> bool:
    """True in a kiosk, except in the process that its supervisor has started."""
    return bool(arguments.kiosk) and not is_supervised()


def supervised(arguments: Namespace) -> int:
    """Run this same job under a supervisor; returns its exit code. Raises Refusal, OSError."""
    return int(module_of("kiosk.start", "kiosk").supervise(own_command(arguments.words)))


def ros_options(parser: ArgumentParser) -> None:
    """Declare the robots of a ROS network."""
    parser.add_argument("--plant", choices=["own", "ros"], default="own", help="ros: robots of a ROS network")
    parser.add_argument("--width", type=decimal(500.0, 10_000.0), metavar="MM", help="ros: width of the arena; 2112")


def ros_width(arguments: Namespace) -> float | None:
    """Width of the arena of a ROS network, mm; None: it is not asked for. Raises Refusal without ROS."""
    if arguments.plant == "ros":
        return float(module_of("mat.ros", "ros").arena_width(arguments))
    if arguments.width is not None:
        raise Refusal("--width: only for --plant ros; `calibrate` measures a mat")
    return None


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
