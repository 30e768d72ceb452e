"""Options of jobs as frozen dataclasses, those that several jobs share, and the types of their values.

A job's `run(options: PlayOptions)` names its dataclass. Each field is an option, as
`option` (--name VALUE) or `flag` (--name) declares it, or an `argument` by its position. Each type accepts every
sensible value and refuses the others in one line (argparse.ArgumentTypeError).
"""

import argparse
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Collection, Mapping
from dataclasses import MISSING, dataclass, field, fields
from math import isfinite
from pathlib import Path
from types import ModuleType
from typing import Any, ClassVar, TypeVar, get_type_hints

from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.sim.rng import SEEDS
from pigaming_app.storage.parsing import quote

T = TypeVar("T")
Groups = Mapping[tuple[str, str], tuple[str, ...]]
"""Fields by the title and text of their group in the help."""

MAX_INTEGER = 2**63 - 1
DEFAULT_GAME = "pitanks"
ONE_OF = ("", "")  # a group without a title: at most one of its options may be given
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


def camera(text: str) -> int | str:
    """The number of a camera, `phone`, or the address of a stream, which the settings check."""
    return word(text) if "://" in text or text == "phone" else integer(0)(text)


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


Help = str | Callable[[], str]


def option(help: Help, type: Callable[[str], Any] | None = None, default: Any = None, **more: Any) -> Any:
    """A field with an option of its name. `more`: as of `add_argument`; `name`: of the option, if it is another."""
    details = {"help": help, "type": type or str, "names": more.pop("name", None), **more}
    if "action" in more and more["action"] != "append":
        del details["type"]
    return field(default=MISSING if more.get("required") else default, metadata=details)


def flag(help: Help) -> Any:
    """A field with an option that is there or not."""
    return option(help, default=False, action="store_true")


def argument(help: Help, type: Callable[[str], Any] | None = None, default: Any = MISSING, **more: Any) -> Any:
    """A field with a value by its position; with `nargs` it may be missing."""
    return option(help, type, default, **{"name": (), **more})


def declare(parser: ArgumentParser, kind: type) -> None:
    """Declare the fields of a job's options; others, which the command line fills in, have their defaults."""
    places: dict[str, argparse._ActionsContainer] = {}
    for (title, text), names in getattr(kind, "GROUPS", {}).items():
        group = parser.add_argument_group(title, text) if title else parser.add_mutually_exclusive_group()
        places |= dict.fromkeys(names, group)
    for one in fields(kind):
        details = dict(one.metadata)
        if not details:
            parser.set_defaults(**{one.name: one.default})
            continue
        names = details.pop("names")
        if names is None or names:
            names, details["dest"] = names or (f"--{one.name.replace('_', '-')}",), one.name
        if callable(details["help"]):
            details["help"] = details["help"]()
        if one.default is not MISSING and one.default != ():
            details["default"] = one.default
        places.get(one.name, parser).add_argument(*(names or (one.name,)), **details)


def options_of(kind: type[T], found: Namespace) -> T:
    """The options as they were given; lists become tuples."""
    values = {one.name: getattr(found, one.name) for one in fields(kind)}  # type: ignore[arg-type]
    return kind(**{name: tuple(v) if isinstance(v, list) else v for name, v in values.items() if v is not None})


def require_unused(options: Any, names: Collection[str], owner: str) -> None:
    """Raises Refusal if one of these options was given; without their `owner` they would do nothing."""
    for one in fields(options):
        if one.name in names and getattr(options, one.name) != one.default:
            raise Refusal(f"--{one.name.replace('_', '-')} goes with {owner}")


def declare_job(parser: ArgumentParser, job: ModuleType | Callable[[Any], int]) -> None:
    """Declare a job: its options, or a sub-command for each module or function in its `WORDS`, with its docstring.

    `start(found)` of the parsed arguments runs the chosen one.
    """
    if not hasattr(job, "WORDS"):
        run = getattr(job, "run", job)
        kind = get_type_hints(run)["options"]
        declare(parser, kind)
        parser.set_defaults(start=lambda found: run(options_of(kind, found)))
        return
    parsers = parser.add_subparsers(metavar="WORD", required=True)
    for word, part in job.WORDS.items():
        about = (part.__doc__ or "").partition("\n\n")[0].replace("\n", " ")
        short = about[0].lower() + about[1:].rstrip(".")
        declare_job(parsers.add_parser(word, help=short, description=about, allow_abbrev=False), part)


def games_and(*more: str, default: str = "") -> Callable[[], str]:
    """The help of a game: the names of all, and further accepted words."""

    def text() -> str:
        from pigaming_app.games.registry import games

        return ", ".join([*games(), *more]) + (f"; default {default}" if default else "")

    return text


def _display(text: str) -> int:
    return integer(high=64)(text) - 1


@dataclass(frozen=True, kw_only=True)
class JsonOption:
    """Whether the result is for programs."""

    json: bool = flag("print the result as one JSON object")


@dataclass(frozen=True, kw_only=True)
class GameOption:
    """The game, the usual one by default."""

    game: str = argument(games_and(default=DEFAULT_GAME), default=DEFAULT_GAME, nargs="?", metavar="GAME")


@dataclass(frozen=True, kw_only=True)
class MatchOptions:
    """Place, length and rules of a match."""

    arena: str | None = option("name, or path of a .toml file; default: the game's first")
    minutes: float | None = option("length of a match; default: the game's own", decimal(0.0, 3600.0))
    variant: str | None = option("set of rules; default: the game's first")
    laps: int | None = option("length of a race", integer(), metavar="NUMBER")
    pallets: int | None = option("pallets that win the factory", integer(), metavar="NUMBER")

    def goal(self, game: str) -> int | None:
        """The requested goal; None: the game's default. Raises Refusal for the goal of another game."""
        from pigaming_app.games.registry import games

        for name, wanted in (("laps", self.laps), ("pallets", self.pallets)):
            if wanted is not None:
                if game in games() and games()[game].goal != name:
                    raise Refusal(f"--{name}: {game} is not played for {name}")
                return wanted
        return None


@dataclass(frozen=True, kw_only=True)
class SeedOption:
    """The random seed."""

    seed: int = option("random seed; default 1", integer(0, SEEDS - 1), 1, metavar="NUMBER")


@dataclass(frozen=True, kw_only=True)
class PairOptions(JsonOption, SeedOption, MatchOptions):
    """Matches of pairs of AIs."""

    game: str = argument(games_and(), metavar="GAME")
    matches: int = option("matches of each pair; default 100", integer(), 100, metavar="NUMBER")


@dataclass(frozen=True, kw_only=True)
class DisplayOption:
    """The display, from 0; None: that of the settings."""

    display: int | None = option("display, from 1; default: that of the settings", _display, metavar="NUMBER")


@dataclass(frozen=True, kw_only=True)
class KioskOptions(DisplayOption):
    """An arcade on one or two screens, perhaps under a supervisor."""

    kiosk: bool = flag("only the operator can leave")
    scoreboard: int | None = option(
        "display of a second screen with scores, from 1; F2 changes its page", integer(high=16), metavar="NUMBER"
    )
    words: tuple[str, ...] = ()  # of the command line, to start the same again


@dataclass(frozen=True, kw_only=True)
class EmulateOption:
    """The seed of the emulated robots; None: real ones."""

    emulate: int | None = option(
        "emulated robots, camera and projector, no hardware; default seed 1",
        integer(0),
        nargs="?",
        const=1,
        metavar="SEED",
    )


@dataclass(frozen=True, kw_only=True)
class RigOptions(EmulateOption):
    """Camera and port of the robots."""

    camera: int | str | None = option(
        "camera above the mat, from 0, or phone, or the address of its stream", camera, metavar="CAMERA"
    )
    port: str | None = option("serial port of the radio; empty: the first one", word)

    def mat_settings(self) -> dict[str, Any]:
        """The requested settings of camera and radio. Raises Refusal for an invalid value."""
        from pigaming_app.storage.settings import CAMERAS, Settings

        if getattr(self, "things", 0) and self.emulate is None:
            raise Refusal("--things: real things are yours to put down; for emulated ones add --emulate")
        given = {name: getattr(self, name, None) for name in ("camera", "port", "baud", "radio")}
        given = {name: value for name, value in given.items() if value is not None}
        if "radio" in given:
            from pigaming_app.jobs.terminal.refusal import module_of

            module_of("mat.sessions", "mat").require_driver(given["radio"])
        for name, value in given.items():
            try:
                Settings().choose(name, value)
            except ValueError as error:
                if name == "camera":  # its address may hold a password
                    raise Refusal(
                        f"--camera: a number from 0 to {CAMERAS - 1}, phone, or an address such as "
                        "http://192.168.0.7:8080/video; in its password, write @ as %40, : as %3A, / as %2F"
                    ) from None
                raise Refusal(f"--{error}") from None
        return given


@dataclass(frozen=True, kw_only=True)
class RadioOptions(RigOptions):
    """Camera, port and radio of the robots."""

    radio: str | None = option(
        "api2, api1, transparent, relay (micro:bit), udp (Wi-Fi), thymio, stock (a robot on a cable), or a plug-in",
        metavar="DRIVER",
    )


@dataclass(frozen=True, kw_only=True)
class MatOptions(RadioOptions):
    """All about the robots, for jobs that save it."""

    GROUPS: ClassVar[Groups] = {
        ("real robots", "Camera and radio are saved in the settings."): (
            "emulate", "things", "camera", "port", "baud", "radio",
        ),
    }  # fmt: skip

    things: int = option(
        "with --emulate: boxes, cups, books and tape on the mat, at most 8; placed by its seed",
        integer(0, 8),
        0,
        metavar="NUMBER",
    )
    baud: int | None = option("baud rate of the radio", integer(), metavar="NUMBER")
