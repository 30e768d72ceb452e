"""Start a kiosk with the user's session, from the next one on. Options of the arcade follow after `--`."""

import argparse
import json
import os
import sys
from argparse import ArgumentParser
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from pigaming_app import INSTALLED
from pigaming_app.jobs import arcade
from pigaming_app.jobs.kiosk.autostart.entries import start_entry
from pigaming_app.jobs.terminal.command import own_command
from pigaming_app.jobs.terminal.options import JsonOption, argument, declare
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.storage.safe_files import write_atomic


class _ArcadeOptions(ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise Refusal(f"autostart: {message}")


@dataclass(frozen=True, kw_only=True)
class AutostartOptions(JsonOption):
    """Whether to start with the session, and how."""

    what: str = argument("default show", default="show", choices=["on", "off", "show"], nargs="?")
    kiosk_options: tuple[str, ...] = argument(
        "of the arcade, after --: -- --display 2", default=(), nargs="*", metavar="OPTION"
    )


def run(options: AutostartOptions) -> int:
    """Switch the start with the session on or off, and print the state. Raises Refusal, NotSaved or OSError."""
    words = options.kiosk_options
    if words and options.what != "on":
        raise Refusal(f"autostart {options.what}: options of the arcade go with `on`")
    _check(words)
    python = sys.executable if INSTALLED else getattr(sys, "_base_executable", sys.executable)  # not .venv's
    try:
        entry = start_entry(
            sys.platform, Path.home(), os.environ, own_command(["--kiosk", *words], python, prepared=False)
        )
    except (ValueError, RuntimeError) as error:  # RuntimeError: no home
        raise Refusal(f"autostart: {error}") from None
    if options.what == "on":
        write_atomic(entry.path, entry.content)
    elif options.what == "off":
        entry.path.unlink(missing_ok=True)
    on = entry.path.is_file()
    if options.json:
        print(json.dumps({"on": on, "file": str(entry.path)}))
    else:
        print(f"on, by {entry.path}" if on else "off")
    return 0


def _check(words: Sequence[str]) -> None:
    """Raises Refusal for options that the arcade does not have."""
    parser = _ArcadeOptions(add_help=False, allow_abbrev=False, usage=argparse.SUPPRESS)
    declare(parser, arcade.ArcadeOptions)
    parser.parse_args(words)
