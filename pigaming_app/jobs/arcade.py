"""PiGaming, a robot arcade. Without a job it starts on its title; `JOB --help` lists the options of a job."""

import argparse
from argparse import ArgumentParser, Namespace
from typing import TYPE_CHECKING

from pigaming_app.jobs.terminal.options import display, integer, mat_options, mat_settings, shared
from pigaming_app.jobs.terminal.refusal import refused, require

if TYPE_CHECKING:
    from pigaming_app.scenes.app import Options


def options(parser: ArgumentParser) -> None:
    parser.usage = "%(prog)s [JOB] [OPTIONS]"
    shared(parser, "--kiosk", "--display")
    mat_options(parser)
    parser.add_argument("--frames", type=integer(), help=argparse.SUPPRESS)


def run(arguments: Namespace) -> int:
    """Open the arcade on its title. Raises Refusal."""
    from pigaming_app.scenes.app import Options

    if arguments.emulate is not None:
        require("hardware")
    return show(
        Options(
            kiosk=arguments.kiosk,
            display=display(arguments),
            frames=arguments.frames,
            emulator_seed=arguments.emulate,
            emulated_things=arguments.things,
            changed_settings=mat_settings(arguments),
        )
    )


def show(options: "Options") -> int:
    """Run the arcade until it is closed; returns its exit code. Raises Refusal without a display."""
    from pigaming_app.scenes.app import run
    from pigaming_app.ui.window import NoDisplay

    with refused(NoDisplay):
        return run(options)
