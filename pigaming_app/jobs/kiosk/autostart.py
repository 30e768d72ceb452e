"""Start a kiosk with the user's session, from the next one on. Options of the arcade follow after `--`."""

import argparse
import json
import os
import plistlib
import sys
from argparse import ArgumentParser
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from pigaming_app import INSTALLED
from pigaming_app.jobs import arcade
from pigaming_app.jobs.terminal.command import own_command
from pigaming_app.jobs.terminal.options import JsonOption, argument, declare
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.storage.safe_files import write_atomic

LABEL = "pt.pigaming.kiosk"
HOME_VARIABLE = "PIGAMING_HOME"  # see `folders`


@dataclass(frozen=True)
class StartEntry:
    """A file that makes the system start a program."""

    path: Path
    content: bytes


def start_entry(platform: str, home: Path, variables: Mapping[str, str], command: Sequence[str]) -> StartEntry:
    """The file for a platform (of `sys.platform`), the user's home and environment, whose HOME_VARIABLE it sets.

    Raises ValueError with a phrase: no system can start a file with a control character in its name.
    """
    own = {HOME_VARIABLE: os.path.abspath(variables[HOME_VARIABLE])} if variables.get(HOME_VARIABLE) else {}
    for words, what in ((command, "the folder of the program"), (own.values(), HOME_VARIABLE)):
        if not all(word.isprintable() for word in words):
            raise ValueError(f"{what} has an unprintable character in its name")
    if platform == "win32":
        return _windows(home, variables, own, command)
    if platform == "darwin":
        return _macos(home, own, command)
    return _linux(home, variables, own, command)


def _linux(home: Path, variables: Mapping[str, str], own: Mapping[str, str], command: Sequence[str]) -> StartEntry:
    """A desktop entry in the autostart folder of the XDG specification."""
    given = Path(variables.get("XDG_CONFIG_HOME", ""))
    folder = (given if given.is_absolute() else home / ".config") / "autostart"  # relative ones do not count
    setting = ["/usr/bin/env", *(f"{name}={value}" for name, value in own.items())] if own else []
    lines = (
        "[Desktop Entry]",
        "Type=Application",
        "Name=PiGaming",
        f"Exec={' '.join(map(_quoted_for_exec, [*setting, *command]))}",
        "Terminal=false",
        "X-GNOME-Autostart-enabled=true",
    )
    return StartEntry(folder / "pigaming.desktop", "\n".join([*lines, ""]).encode())


def _quoted_for_exec(word: str) -> str:
    """A word of the key Exec: escaped within quotes, then by the rules of all texts, with % doubled."""
    for special in '\\"`$':
        word = word.replace(special, f"\\{special}")
    return '"{}"'.format(word.replace("\\", "\\\\").replace("%", "%%"))


def _windows(home: Path, variables: Mapping[str, str], own: Mapping[str, str], command: Sequence[str]) -> StartEntry:
    """A batch file in the start-up folder."""
    roaming = Path(variables.get("APPDATA") or home / "AppData" / "Roaming")
    folder = roaming / "Microsoft" / "Windows" / "Start Menu" / "Programs" / "Startup"
    setting = (f"set {_quoted_for_batch(f'{name}={value}')}" for name, value in own.items())
    words = " ".join(map(_quoted_for_batch, command))
    lines = ("@echo off", "chcp 65001 >nul", *setting, f'start "PiGaming" /min {words}')
    return StartEntry(folder / "PiGaming.bat", "\r\n".join([*lines, ""]).encode())


def _quoted_for_batch(word: str) -> str:
    return '"{}"'.format(word.replace("%", "%%"))


def _macos(home: Path, own: Mapping[str, str], command: Sequence[str]) -> StartEntry:
    """A launch agent of the user's graphical sessions."""
    agent = {
        "Label": LABEL,
        "ProgramArguments": list(command),
        "EnvironmentVariables": dict(own),
        "RunAtLoad": True,
        "ProcessType": "Interactive",
        "LimitLoadToSessionType": "Aqua",
    }
    return StartEntry(home / "Library" / "LaunchAgents" / f"{LABEL}.plist", plistlib.dumps(agent))


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
