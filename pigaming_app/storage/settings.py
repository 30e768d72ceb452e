"""The operator's settings, and the folders of the arcade's files.

Settings are one TOML file in the platform's standard folder. It may be edited by hand: every invalid entry is reported
with file, key and reason, and replaced by its default. Several instances of the arcade may share it: each writes only
the settings that it has changed.
"""

import logging
import os
import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field, fields
from datetime import time
from pathlib import Path
from typing import Any, Protocol

from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.parsing import one_line, parse_toml, quote
from pigaming_app.storage.safe_files import read_or_restore, write_with_backup

FILE = "settings.toml"
LEGACY_KEYS = ("arena", "minutes", "variant")  # top-level settings of PiTanks, from when it was the only game
LEVELS = ("level1", "level2", "level3", "level4", "level5")  # of AIs
LEGACY_LEVELS = {"easy": "level1", "normal": "level3", "hard": "level5"}  # from when there were three
MAX_NAME = 60  # characters
MAX_GAMES = 64
MAX_DEVICES = 16  # with changed controls, and functions of each
MAX_MESSAGES = 5  # per file
DRAWN = ("arena_id", "wifi_key")  # settings that identify this arena to its robots
VISITORS = ("language", "strength")  # settings that visitors choose, beside those of each game
log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class Folders:
    """The user's folders of this program. They need not exist."""

    config: Path
    data: Path
    cache: Path


class NoHome(OSError):
    """There is no folder for the user's files. The text is a sentence for the operator."""


def folders() -> Folders:
    """The platform's standard folders, or subfolders of the environment variable PIGAMING_HOME if set.

    Raises NoHome for a user without a home folder.
    """
    if home := os.environ.get("PIGAMING_HOME"):
        return Folders(Path(home, "config"), Path(home, "data"), Path(home, "cache"))
    from platformdirs import PlatformDirs

    place = PlatformDirs("pigaming", appauthor=False)
    try:
        return Folders(place.user_config_path, place.user_data_path, place.user_cache_path)
    except RuntimeError:
        advice = "set HOME or PIGAMING_HOME to a folder that can be written."
        raise NoHome(f"this user has no home folder: {advice}") from None


class Validator(Protocol):
    """A check of a setting's value."""

    def error(self, value: object) -> str | None:
        """The reason why a value is invalid, as a phrase that follows "is"; None if it is valid."""


@dataclass(frozen=True)
class Range:
    """Numbers from `low` to `high`, both included; whole numbers only if `low` is an int."""

    low: float
    high: float

    def error(self, value: object) -> str | None:
        whole = isinstance(self.low, int)
        if isinstance(value, bool) or not isinstance(value, int if whole else int | float):
            return "not a whole number" if whole else "not a number"
        return None if self.low <= value <= self.high else f"not between {self.low} and {self.high}"


@dataclass(frozen=True)
class OneOf:
    """One of these words."""

    words: tuple[str, ...]

    def error(self, value: object) -> str | None:
        return None if value in self.words else f"none of {', '.join(self.words)}"


class Boolean:
    """True or false."""

    def error(self, value: object) -> str | None:
        return None if isinstance(value, bool) else "neither true nor false"


class ShortText:
    """A name of something that may no longer exist; users of the setting must check."""

    def error(self, value: object) -> str | None:
        short = isinstance(value, str) and len(value) <= MAX_NAME and value.isprintable()
        return None if short else "not a short text"


@dataclass(frozen=True)
class SeatNumbers:
    """A list of different whole numbers from 1 to 4; all four if `all_of_them`."""

    all_of_them: bool = False

    def error(self, value: object) -> str | None:
        valid = isinstance(value, list) and all(type(seat) is int and 1 <= seat <= 4 for seat in value)
        if not valid or len(set(value)) != len(value):  # type: ignore[call-overload, arg-type]
            return "not a list of different numbers from 1 to 4"
        return "not all of 1, 2, 3, 4" if self.all_of_them and len(value) != 4 else None  # type: ignore[arg-type]


class RobotKinds:
    """A list of four names, each empty or of a kind that may no longer exist."""

    def error(self, value: object) -> str | None:
        short = isinstance(value, list) and len(value) == 4 and not any(ShortText().error(name) for name in value)
        return None if short else "not a list of four short texts"


class TimeOfDay:
    """A time of day such as 22:30."""

    def error(self, value: object) -> str | None:
        valid = isinstance(value, str) and re.fullmatch("([01][0-9]|2[0-3]):[0-5][0-9]", value)
        return None if valid else "no time such as 22:30"


class ChangedControls:
    """Whole numbers by function, by device: see ui/input/remap.py. Users of the setting must check the names."""

    def error(self, value: object) -> str | None:
        tables = list(value.values()) if isinstance(value, dict) and len(value) <= MAX_DEVICES else [None]
        codes = [
            code for table in tables if isinstance(table, dict) and len(table) <= MAX_DEVICES for code in table.values()
        ]
        valid = all(isinstance(table, dict) and table for table in tables) and all(
            type(code) is int and 0 <= code < 1024 for code in codes
        )
        return None if valid else "not a table of tables of key or button numbers"


class HexKey:
    """Nothing, or 32 hexadecimal digits."""

    def error(self, value: object) -> str | None:
        valid = isinstance(value, str) and re.fullmatch("([0-9a-f]{32})?", value)
        return None if valid else "neither empty nor 32 hexadecimal digits"


class Corners:
    """An empty list, or eight whole numbers: the corners of the picture, px of the canvas."""

    def error(self, value: object) -> str | None:
        whole = isinstance(value, list) and all(type(number) is int and abs(number) < 10000 for number in value)
        return None if whole and len(value) in (0, 8) else "neither empty nor eight whole numbers"  # type: ignore[arg-type]


def _setting(default: Any, validator: Validator) -> Any:
    return field(default=default, metadata={"validator": validator})


@dataclass
class Choice:
    """The last choices in the setup of one game; empty or 0 is the game's default."""

    arena: str = _setting("", ShortText())
    minutes: int = _setting(0, Range(0, 60))
    variant: str = _setting("", ShortText())
    goal: int = _setting(0, Range(0, 99))
    rounds: int = _setting(1, Range(1, 9))


_DEFAULT = Choice()
Key = tuple[str | None, str]  # game or None, name of the setting
Flat = dict[Key, Any]


@dataclass
class Settings:
    """The operator's settings, and the last choices before a match."""

    language: str = _setting("en", OneOf(("en", "pt", "es", "fr", "de")))
    music: int = _setting(6, Range(0, 10))
    sounds: int = _setting(8, Range(0, 10))
    flashes: str = _setting("full", OneOf(("off", "soft", "full")))
    shake: bool = _setting(True, Boolean())
    calm: bool = _setting(False, Boolean())  # nothing flashes more than three times a second, nothing shakes
    large_text: bool = _setting(False, Boolean())  # in menus, where there is room
    rumble: bool = _setting(True, Boolean())  # of the pads
    display: int = _setting(0, Range(0, 15))
    fullscreen: bool = _setting(True, Boolean())
    phones: bool = _setting(False, Boolean())  # phones may join as pads
    phones_network: str = _setting("", ShortText())  # name or address of their interface; empty: the first one
    phones_port: int = _setting(8787, Range(1024, 65535))
    attract_seconds: float = _setting(60.0, Range(5.0, 3600.0))  # without input
    corners: list[int] = field(
        default_factory=list, metadata={"validator": Corners()}
    )  # of the picture on the projector
    strength: str = _setting("level3", OneOf(LEVELS))  # of the AIs that fill the seats
    camera: int = _setting(0, Range(0, 63))  # over the mat
    arena_mm: float = _setting(2112.0, Range(500.0, 10000.0))  # the arena's width on the mat
    camera_mm: float = _setting(2500.0, Range(0.0, 10000.0))  # the camera's height above it; 0: measured with a robot
    lid_mm: float = _setting(70.0, Range(0.0, 300.0))  # the height of the robots' lids
    port: str = _setting("", ShortText())  # of the radio; empty: the first one found
    baud: int = _setting(57600, Range(1200, 921600))
    radio: str = _setting("api2", OneOf(("api2", "api1", "transparent", "udp", "stock")))  # its mode
    arena_id: int = _setting(0, Range(0, 16383))  # of this computer and its robots; 0: drawn on first use
    wifi_key: str = _setting("", HexKey())  # of this arena and its Wi-Fi robots; empty: drawn on first use
    radio_channel: int = _setting(0, Range(0, 26))  # of the XBees, 11 to 26; 0: follows from the arena id
    radio_pan: int = _setting(0, Range(0, 65534))  # of the XBees; 0: follows from the arena id
    mat: bool = _setting(False, Boolean())  # real robots are selectable
    blocks: bool = _setting(False, Boolean())  # things on the mat are blocks with markers, for a mat without projector
    real: list[int] = field(
        default_factory=list, metadata={"validator": SeatNumbers()}
    )  # seats with real robots, last chosen
    radios: list[int] = field(
        default_factory=lambda: [1, 2, 3, 4], metadata={"validator": SeatNumbers(True)}
    )  # of each marker
    camera_delay: int = _setting(-1, Range(-1, 120))  # ms by which the camera's stamps are late; -1: never measured
    kinds: list[str] = field(
        default_factory=lambda: [""] * 4, metadata={"validator": RobotKinds()}
    )  # of the robot on each radio; empty: as it announces
    pad_driving: str = _setting("", ShortText())  # driving style last chosen on a pad; empty: never
    keys_driving: str = _setting("", ShortText())  # the same on the keyboard
    keypad: bool = _setting(False, Boolean())  # a key of the number pad was pressed once
    scoreboard: int = _setting(0, Range(0, 16))  # the display of the second screen, from 1; 0: none
    volume_cap: int = _setting(10, Range(0, 10))  # of music and sounds
    quiet_from: str = _setting("00:00", TimeOfDay())  # title and attract mode are silent from here
    quiet_until: str = _setting("00:00", TimeOfDay())  # to here; the same time: never
    group_minutes: int = _setting(0, Range(0, 120))  # from the title to the title; 0: no limit
    keep_choices: bool = _setting(False, Boolean())  # visitors' choices stay and are saved
    controls: dict[str, dict[str, int]] = field(
        default_factory=dict, metadata={"validator": ChangedControls()}
    )  # changed keys and buttons, by key cluster (keys1 to keys4) and by kind of pad
    games: dict[str, Choice] = field(default_factory=dict)  # by name: [games.pitanks] in the file

    def __post_init__(self) -> None:
        self._house: Flat | None = None  # choices of the house, while visitors make theirs; None: there are no visitors
        self._base: Flat | None = None  # as last loaded or saved; None: never, so all values count as changed
        self._seen: Flat = {}  # content of the file at that time

    @classmethod
    def load(cls, folder: Path) -> "tuple[Settings, list[str]]":
        """Load the settings from the folder; returns them with a sentence for every problem."""
        table, problems = read_or_restore(folder / FILE, parse_toml)
        settings = cls()
        problems += _fill_all(settings, dict(table or {}), folder / FILE)
        settings._base = settings._seen = _flat(settings)
        return settings, problems

    @property
    def loudness(self) -> tuple[int, int]:
        """Volumes of music and sounds, 0 to 10, within the cap."""
        return min(self.music, self.volume_cap), min(self.sounds, self.volume_cap)

    def quiet(self, now: time) -> bool:
        """True if a local time is within the quiet hours, which may pass midnight."""
        begin, end, at = self.quiet_from, self.quiet_until, f"{now:%H:%M}"
        return begin <= at < end if begin <= end else at >= begin or at < end

    def choice(self, game: str) -> Choice:
        """The last choices for a game, to be modified in place."""
        return self.games.setdefault(game, Choice())

    def choose(self, name: str, value: object) -> None:
        """Change a setting. Raises ValueError with the reason if the value is invalid."""
        if error := next(entry.metadata["validator"] for entry in fields(self) if entry.name == name).error(value):
            raise ValueError(f"{name} = {value!r} is {error}")
        setattr(self, name, value)

    def settle(self, *names: str) -> None:
        """Make the present choices those of the house: all, or of VISITORS those named once there are visitors."""
        now = _choices(self)
        if not names:
            self._house = now
        elif self._house is not None:
            self._house = self._house | {(None, name): now[None, name] for name in names}

    def return_to_house(self) -> None:
        """Give up the visitors' choices, unless they are kept."""
        if self._house is None or self.keep_choices:
            return
        self.games = {}
        for key, value in self._house.items():
            self._set(key, value)

    def leave_choices_unsaved(self) -> None:
        """Do not save the present choices of games, unless they are changed."""
        if self._base is not None:
            self._base = self._base | {key: value for key, value in _flat(self).items() if key[0] is not None}

    def use_defaults(self, names: Iterable[str]) -> None:
        """Use the defaults of these settings, which are not saved unless they are changed or kept."""
        default = Settings()
        for name in names:
            setattr(self, name, getattr(default, name))
        if self._base is not None:
            self._base = self._base | {(None, name): getattr(default, name) for name in names}

    def keep(self, names: Iterable[str]) -> None:
        """Save these settings with the next changes, as they are."""
        if self._base is not None:
            self._base = {key: value for key, value in self._base.items() if key[0] or key[1] not in names}

    def take_over(self, other: "Settings", names: Iterable[str] | None = None) -> list[str]:
        """Take over the values of other settings, all or these, except what is drawn once for this installation.

        Returns the names of those that differed.
        """
        for game in self.games:
            other.choice(game)
        values = _flat(other)
        wanted = {*values} if names is None else {(None, name) for name in names}
        changed = [key for key in _differing(values, _flat(self)) if key in wanted and key[1] not in DRAWN]
        for key in changed:
            self._set(key, values[key])
        return [_name(key) for key in changed]

    def save(self, folder: Path) -> None:
        """Merge the changes of this instance into the file. Raises NotSaved; the file is then intact."""
        import tomli_w

        path, own = folder / FILE, self._own()
        with locked(path):
            merged, problems = Settings.load(folder)
            for sentence in [*problems, *self._foreign(_flat(merged))]:
                log.warning("%s", sentence)
            for key in self._changed():
                merged._set(key, own[key])
            write_with_backup(path, tomli_w.dumps(asdict(merged)))
        self._base, self._seen = own, _flat(merged)

    def _own(self) -> Flat:
        """The settings to be saved: choices of the house in place of the visitors', unless these are kept."""
        if self._house is None or self.keep_choices:
            return _flat(self)
        return {key: value for key, value in _flat(self).items() if key not in _choices(self)} | self._house

    def _changed(self) -> list[Key]:
        """The settings changed by this instance since it last loaded or saved."""
        own = self._own()
        return [*own] if self._base is None else _differing(own, self._base)

    def _foreign(self, stored: Flat) -> list[str]:
        """Sentences for the log on changes to the file by other instances of the arcade."""
        foreign = _differing(stored, self._seen) if self._base is not None else []
        own = self._changed()
        kept, lost = [key for key in foreign if key not in own], [key for key in foreign if key in own]
        messages = [f"settings of another copy of the arcade kept: {_names(kept)}."] if kept else []
        return [*messages, f"settings of another copy of the arcade replaced: {_names(lost)}."] if lost else messages

    def _set(self, key: Key, value: object) -> None:
        game, name = key
        setattr(self.choice(game) if game is not None else self, name, value)


def _flat(settings: Settings) -> Flat:
    """Every setting by its key, including those of the games."""
    flat: Flat = {(None, name): value for name, value in asdict(settings).items() if name != "games"}
    for game, choice in settings.games.items():
        flat |= {(game, name): value for name, value in asdict(choice).items()}
    return flat


def _choices(settings: Settings) -> Flat:
    """The settings that visitors choose."""
    return {key: value for key, value in _flat(settings).items() if key[0] is not None or key[1] in VISITORS}


def _differing(now: Flat, before: Flat) -> list[Key]:
    """The keys whose values differ; a missing game counts as having the defaults."""
    return [key for key, value in now.items() if before.get(key, getattr(_DEFAULT, key[1], None)) != value]


def _name(key: Key) -> str:
    """A setting's name in messages."""
    game, name = key
    return one_line(name if game is None else f"games.{game}.{name}")


def _names(keys: list[Key]) -> str:
    return ", ".join(map(_name, keys[:MAX_MESSAGES]))


def _fill_all(settings: Settings, table: dict[str, Any], path: Path) -> list[str]:
    """Apply the valid entries of a file; returns sentences on the others."""
    games = table.pop("games", {})
    legacy = {key: table.pop(key) for key in LEGACY_KEYS if key in table}
    problems = _fill(settings.choice("pitanks"), legacy, f"{path}: ") if legacy else []
    if isinstance(strength := table.get("strength"), str):
        table["strength"] = LEGACY_LEVELS.get(strength, strength)
    problems += _fill(settings, table, f"{path}: ")
    for game, entries in games.items() if isinstance(games, dict) else [("games", games)]:
        if not isinstance(entries, dict):
            problems.append(f"{path}: {one_line(game, MAX_NAME)} is not a table; it is ignored.")
        elif len(game) > MAX_NAME or (game not in settings.games and len(settings.games) >= MAX_GAMES):
            problems.append(
                f"{path}: games.{one_line(game, MAX_NAME)} is ignored: "
                f"at most {MAX_GAMES} games are kept, with names of at most {MAX_NAME} characters."
            )
        else:
            problems += _fill(settings.choice(game), entries, f"{path}: games.{one_line(game, MAX_NAME)}.")
    more = len(problems) - MAX_MESSAGES
    if more <= 1:
        return problems
    return [*problems[:MAX_MESSAGES], f"{path}: {more} more lines are wrong; they are ignored."]


def _fill(target: Any, table: dict[str, Any], where: str) -> list[str]:
    """Apply the valid entries of a table; returns a sentence for each of the others."""
    problems = []
    validators = {entry.name: entry.metadata["validator"] for entry in fields(target) if "validator" in entry.metadata}
    for key, value in table.items():
        if key not in validators:
            problems.append(f"{where}{one_line(key, MAX_NAME)} is not a setting; it is ignored.")
        elif error := validators[key].error(value):
            problems.append(f"{where}{key} = {quote(value)} is {error}; {getattr(target, key)!r} is used.")
        else:
            setattr(target, key, float(value) if isinstance(getattr(target, key), float) else value)
    return problems
