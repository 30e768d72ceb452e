"""Start a kiosk with the user's session, from the next one on. Options of the arcade follow after `--`."""

import argparse
import json
import os
import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import NoReturn

from pigaming_app import INSTALLED
from pigaming_app.jobs import arcade
from pigaming_app.jobs.kiosk.autostart.entries import start_entry
from pigaming_app.jobs.terminal.command import own_command
from pigaming_app.jobs.terminal.options import shared
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.storage.safe_files import write_atomic


class _ArcadeOptions(ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise Refusal(f"autostart: {message}")


def options(parser: ArgumentParser) -> None:
    parser.add_argument("what", choices=["on", "off", "show"], nargs="?", default="show", help="default show")
    parser.add_argument("kiosk_options", nargs="*", metavar="OPTION", help="of the arcade, after --: -- --display 2")
    shared(parser, "--json")


def run(arguments: Namespace) -> int:
    """Switch the start with the session on or off, and print the state. Raises Refusal, NotSaved or OSError."""
    words = arguments.kiosk_options
    if words and arguments.what != "on":
        raise Refusal(f"autostart {arguments.what}: options of the arcade go with `on`")
    _check(words)
    python = sys.executable if INSTALLED else getattr(sys, "_base_executable", sys.executable)  # not .venv's
    try:
        entry = start_entry(
            sys.platform, Path.home(), os.environ, own_command(["--kiosk", *words], python, prepared=False)
        )
    except (ValueError, RuntimeError) as error:  # RuntimeError: no home
        raise Refusal(f"autostart: {error}") from None
    if arguments.what == "on":
        write_atomic(entry.path, entry.content)
    elif arguments.what == "off":
        entry.path.unlink(missing_ok=True)
    on = entry.path.is_file()
    if arguments.json:
        print(json.dumps({"on": on, "file": str(entry.path)}))
    else:
        print(f"on, by {entry.path}" if on else "off")
    return 0


def _check(words: list[str]) -> None:
    """Raises Refusal for options that the arcade does not have."""
    parser = _ArcadeOptions(add_help=False, allow_abbrev=False, usage=argparse.SUPPRESS)
    arcade.options(parser)
    parser.parse_args(words)
