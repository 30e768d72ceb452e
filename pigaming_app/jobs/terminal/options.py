"""Options that several jobs share, and the types of their values.

Each type accepts every sensible value and refuses the others in one line (argparse.ArgumentTypeError).
"""

import argparse
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Mapping
from math import isfinite
from pathlib import Path
from types import ModuleType
from typing import Any

from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.sim.rng import SEEDS
from pigaming_app.storage.parsing import quote

MAX_INTEGER = 2**63 - 1
DEFAULT_GAME = "pitanks"
AIS = "idle, random, level1 to level5, another of the game, or a trained one's file"


def integer(low: int = 1, high: int = MAX_INTEGER) -> Callable[[str], int]:
    """Whole numbers from `low` to `high`."""

    def parse(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{quote(text)} is not a whole number") from None
        if number < low:
            raise argparse.ArgumentTypeError(f"{quote(text)} is less than {low}")
        if number > high:
            raise argparse.ArgumentTypeError(f"{quote(text)} is more than {high}")
        return number

    return parse


def decimal(low: float, high: float) -> Callable[[str], float]:
    """Numbers from `low` to `high`."""

    def parse(text: str) -> float:
        try:
            number = float(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{quote(text)} is not a number") from None
        if not isfinite(number) or not low <= number <= high:
            raise argparse.ArgumentTypeError(f"{quote(text)} is not between {low:g} and {high:g}")
        return number

    return parse


def hexadecimal(low: int, high: int) -> Callable[[str], int]:
    """Whole numbers from `low` to `high` in hexadecimal digits, as an XBee takes them."""

    def parse(text: str) -> int:
        try:
            number = int(text, 16)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{quote(text)} is not a hexadecimal number") from None
        if not low <= number <= high:
            raise argparse.ArgumentTypeError(f"{quote(text)} is not between {low:X} and {high:X} (hexadecimal)")
        return number

    return parse


def path(text: str) -> Path:
    """A path that the system accepts."""
    if not text or "\0" in text:
        raise argparse.ArgumentTypeError(f"{quote(text)} is not the name of a file")
    return Path(text)


def word(text: str) -> str:
    """Printable text."""
    if not text.isprintable():
        raise argparse.ArgumentTypeError(f"{quote(text)} is not a plain text")
    return text


SHARED: dict[str, dict[str, Any]] = {
    "--arena": {"help": "name, or path of a .toml file; default: the game's first"},
    "--minutes": {"type": decimal(0.0, 3600.0), "help": "length of a match; default: the game's own"},
    "--variant": {"help": "set of rules; default: the game's first"},
    "--laps": {"type": integer(), "metavar": "NUMBER", "help": "length of a race"},
    "--pallets": {"type": integer(), "metavar": "NUMBER", "help": "pallets that win the factory"},
    "--seed": {"type": integer(0, SEEDS - 1), "metavar": "NUMBER", "default": 1, "help": "random seed; default 1"},
    "--json": {"action": "store_true", "help": "print the result as one JSON object"},
    "--kiosk": {"action": "store_true", "help": "only the operator can leave"},
    "--display": {
        "type": integer(high=64),
        "metavar": "NUMBER",
        "help": "display, from 1; default: that of the settings",
    },
    "--scoreboard": {
        "type": integer(high=16),
        "metavar": "NUMBER",
        "help": "display of a second screen with scores, from 1; F2 changes its page",
    },
    "--emulate": {
        "type": integer(0),
        "nargs": "?",
        "const": 1,
        "metavar": "SEED",
        "help": "emulated robots, camera and projector, no hardware; default seed 1",
    },
    "--things": {
        "type": integer(0, 8),
        "metavar": "NUMBER",
        "default": 0,
        "help": "with --emulate: boxes, cups, books and tape on the mat, at most 8; placed by its seed",
    },
    "--camera": {"type": integer(0), "metavar": "NUMBER", "help": "camera above the mat, from 0"},
    "--port": {"type": word, "help": "serial port of the radio; empty: the first one"},
    "--baud": {"type": integer(), "metavar": "NUMBER", "help": "baud rate of the radio"},
    "--radio": {"metavar": "MODE", "help": "api2, api1, transparent, udp (Wi-Fi), or stock (a robot on a cable)"},
}
MATCH = ("--arena", "--minutes", "--variant", "--laps", "--pallets")


def shared(parser: argparse._ActionsContainer, *names: str) -> None:
    """Declare some of SHARED."""
    for name in names:
        parser.add_argument(name, **SHARED[name])


def subcommands(parser: ArgumentParser, name: str, modules: Mapping[str, ModuleType]) -> None:
    """Declare a sub-command for each module, described by its docstring. The chosen one is the value `name`."""
    parsers = parser.add_subparsers(dest=name, metavar=name.upper(), required=True)
    for word, module in modules.items():
        about = (module.__doc__ or "").partition("\n\n")[0].replace("\n", " ")
        short = about[0].lower() + about[1:].rstrip(".")
        module.options(parsers.add_parser(word, help=short, description=about, allow_abbrev=False))


def game_option(parser: ArgumentParser, required: bool = False, more: tuple[str, ...] = ()) -> None:
    """Declare the game as a positional argument. `more`: further accepted words."""
    from pigaming_app.games.registry import games

    names = ", ".join([*games(), *more])
    if required:
        parser.add_argument("game", metavar="GAME", help=names)
    else:
        text = f"{names}; default {DEFAULT_GAME}"
        parser.add_argument("game", metavar="GAME", nargs="?", default=DEFAULT_GAME, help=text)


def duel_options(parser: ArgumentParser) -> None:
    """Declare the matches of a pair of AIs."""
    parser.add_argument(
        "--matches", type=integer(), metavar="NUMBER", default=100, help="matches of each pair; default 100"
    )
    shared(parser, *MATCH, "--seed", "--json")


def mat_options(parser: ArgumentParser) -> None:
    """Declare camera and radio of the real robots, for jobs that save them."""
    group = parser.add_argument_group("real robots", "Camera and radio are saved in the settings.")
    shared(group, "--emulate", "--things", "--camera", "--port", "--baud", "--radio")


def goal(arguments: Namespace) -> int | None:
    """The requested goal; None: the game's default. Raises Refusal for the goal of another game."""
    from pigaming_app.games.registry import games

    for name in ("laps", "pallets"):
        wanted: int | None = getattr(arguments, name)
        if wanted is not None:
            if arguments.game in games() and games()[arguments.game].goal != name:
                raise Refusal(f"--{name}: {arguments.game} is not played for {name}")
            return wanted
    return None


def display(arguments: Namespace) -> int | None:
    """The requested display, from 0; None: that of the settings."""
    return None if arguments.display is None else arguments.display - 1


def mat_settings(arguments: Namespace) -> dict[str, Any]:
    """The requested settings of camera and radio. Raises Refusal for an invalid value."""
    from pigaming_app.storage.settings import Settings

    if getattr(arguments, "things", 0) and arguments.emulate is None:
        raise Refusal("--things: real things are yours to put down; for emulated ones add --emulate")
    given = {name: getattr(arguments, name, None) for name in ("camera", "port", "baud", "radio")}
    given = {name: value for name, value in given.items() if value is not None}
    for name, value in given.items():
        try:
            Settings().choose(name, value)
        except ValueError as error:
            raise Refusal(f"--{error}") from None
    return given
