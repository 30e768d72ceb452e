"""What an operator may change, and where the arcade keeps its files.

Settings are one TOML file in the platform's own place. It may be edited by hand: whatever in it is wrong is named,
with file, key and reason, and its default is used instead. Several copies of the arcade may share it: each writes only
the settings that it has changed itself.
"""

import logging
import os
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any, Protocol

from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.parsing import one_line, parse_toml, quote
from pigaming_app.storage.safe_files import read_or_restore, write_with_backup

FILE = "settings.toml"
FORMER = ("arena", "minutes", "variant")  # stood alone when there was one game
LONGEST = 60  # characters of a name
MOST_GAMES = 64
MOST_SENTENCES = 5  # about one file
log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class Folders:
    """The user's folders of this program. They need not exist."""

    config: Path
    data: Path
    cache: Path


def folders() -> Folders:
    """The platform's folders; the environment variable PIGAMING_HOME puts all three into one place."""
    if home := os.environ.get("PIGAMING_HOME"):
        return Folders(Path(home, "config"), Path(home, "data"), Path(home, "cache"))
    from platformdirs import PlatformDirs

    place = PlatformDirs("pigaming", appauthor=False)
    return Folders(place.user_config_path, place.user_data_path, place.user_cache_path)


class Validator(Protocol):
    """What may stand in a setting."""

    def error(self, value: object) -> str | None:
        """Why the value does not fit, to follow "is", or None."""


@dataclass(frozen=True)
class Range:
    """Whole numbers, or any where `low` is a float, from `low` to `high`, both allowed."""

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
    """A name of something that may have gone since: who uses it looks whether it is there."""

    def error(self, value: object) -> str | None:
        short = isinstance(value, str) and len(value) <= LONGEST and value.isprintable()
        return None if short else "not a short text"


@dataclass(frozen=True)
class SeatNumbers:
    """Different whole numbers from 1 to 4: any of them, or, if `all_of_them`, all."""

    all_of_them: bool = False

    def error(self, value: object) -> str | None:
        known = isinstance(value, list) and all(type(one) is int and 1 <= one <= 4 for one in value)
        if not known or len(set(value)) != len(value):  # type: ignore[call-overload, arg-type]
            return "not a list of different numbers from 1 to 4"
        return "not all of 1, 2, 3, 4" if self.all_of_them and len(value) != 4 else None  # type: ignore[arg-type]


class Corners:
    """Nothing, or eight whole numbers: where the corners of the picture are, px of the canvas."""

    def error(self, value: object) -> str | None:
        whole = isinstance(value, list) and all(type(one) is int and abs(one) < 10000 for one in value)
        return None if whole and len(value) in (0, 8) else "neither empty nor eight whole numbers"  # type: ignore[arg-type]


def _setting(default: Any, validator: Validator) -> Any:
    return field(default=default, metadata={"validator": validator})


@dataclass
class Choice:
    """What was last chosen in the setup of one game; what is empty or 0 is the game's own."""

    arena: str = _setting("", ShortText())
    minutes: int = _setting(0, Range(0, 60))
    variant: str = _setting("", ShortText())
    goal: int = _setting(0, Range(0, 99))


_DEFAULT = Choice()
Key = tuple[str | None, str]  # game, or None, and name of a setting
Flat = dict[Key, Any]


@dataclass
class Settings:
    """What the operator chose, and what was last chosen before a match."""

    language: str = _setting("en", OneOf(("en", "pt")))
    music: int = _setting(6, Range(0, 10))
    sounds: int = _setting(8, Range(0, 10))
    flashes: str = _setting("full", OneOf(("off", "soft", "full")))
    shake: bool = _setting(True, Boolean())
    display: int = _setting(0, Range(0, 15))
    fullscreen: bool = _setting(True, Boolean())
    attract_seconds: float = _setting(60.0, Range(5.0, 3600.0))  # of nobody pressing anything
    corners: list[int] = field(
        default_factory=list, metadata={"validator": Corners()}
    )  # of the picture on the projector
    strength: str = _setting("normal", OneOf(("easy", "normal", "hard")))  # of the AIs that fill the seats
    camera: int = _setting(0, Range(0, 63))  # over the mat
    arena_mm: float = _setting(2112.0, Range(500.0, 10000.0))  # the arena's width on the mat
    camera_mm: float = _setting(2500.0, Range(0.0, 10000.0))  # the camera's height above it; 0: a robot tells it
    lid_mm: float = _setting(70.0, Range(0.0, 300.0))  # the height of the robots' lids
    port: str = _setting("", ShortText())  # of the radio; empty: the first there is
    baud: int = _setting(57600, Range(1200, 921600))
    radio: str = _setting("api2", OneOf(("api2", "api1", "transparent", "stock")))  # how it is set
    mat: bool = _setting(False, Boolean())  # real robots can be chosen
    real: list[int] = field(
        default_factory=list, metadata={"validator": SeatNumbers()}
    )  # seats with real robots, last chosen
    radios: list[int] = field(
        default_factory=lambda: [1, 2, 3, 4], metadata={"validator": SeatNumbers(True)}
    )  # of each marker
    games: dict[str, Choice] = field(default_factory=dict)  # by name: [games.pitanks] in the file

    def __post_init__(self) -> None:
        self._base: Flat | None = None  # as this copy loaded or saved it last; None: all of it is chosen here
        self._seen: Flat = {}  # the file as it was then

    @classmethod
    def load(cls, folder: Path) -> "tuple[Settings, list[str]]":
        """The settings kept in the folder, and one sentence for everything that was wrong with them."""
        found, said = read_or_restore(folder / FILE, parse_toml)
        settings = cls()
        said += _fill_all(settings, dict(found or {}), folder / FILE)
        settings._base = settings._seen = _flat(settings)
        return settings, said

    def choice(self, game: str) -> Choice:
        """What was last chosen for a game; write to it what is chosen now."""
        return self.games.setdefault(game, Choice())

    def choose(self, name: str, value: object) -> None:
        """Set one setting. Raises ValueError with why the value does not fit."""
        if error := next(one.metadata["validator"] for one in fields(self) if one.name == name).error(value):
            raise ValueError(f"{name} = {value!r} is {error}")
        setattr(self, name, value)

    def save(self, folder: Path) -> None:
        """Merge what was changed here into the file. Raises NotSaved; then the settings kept before are intact."""
        import tomli_w

        path, own = folder / FILE, _flat(self)
        with locked(path):
            there, said = Settings.load(folder)
            for sentence in [*said, *self._foreign(_flat(there))]:
                log.warning("%s", sentence)
            for key in self._changed():
                there._set(key, own[key])
            write_with_backup(path, tomli_w.dumps(asdict(there)))
        self._base, self._seen = own, _flat(there)

    def _changed(self) -> list[Key]:
        """What was changed here since it was loaded or saved."""
        own = _flat(self)
        return [*own] if self._base is None else _differing(own, self._base)

    def _foreign(self, there: Flat) -> list[str]:
        """What another copy of the arcade has changed in the file, in sentences for the log."""
        foreign = _differing(there, self._seen) if self._base is not None else []
        own = self._changed()
        kept, lost = [key for key in foreign if key not in own], [key for key in foreign if key in own]
        said = [f"settings of another copy of the arcade kept: {_names(kept)}."] if kept else []
        return [*said, f"settings of another copy of the arcade replaced: {_names(lost)}."] if lost else said

    def _set(self, key: Key, value: object) -> None:
        game, name = key
        setattr(self.choice(game) if game is not None else self, name, value)


def _flat(settings: Settings) -> Flat:
    """Every setting by its key, those of the games too."""
    flat: Flat = {(None, name): value for name, value in asdict(settings).items() if name != "games"}
    for game, choice in settings.games.items():
        flat |= {(game, name): value for name, value in asdict(choice).items()}
    return flat


def _differing(now: Flat, before: Flat) -> list[Key]:
    """The keys whose values differ; a game that was not there had its defaults."""
    return [key for key, value in now.items() if before.get(key, getattr(_DEFAULT, key[1], None)) != value]


def _names(keys: list[Key]) -> str:
    return ", ".join(one_line(name if game is None else f"games.{game}.{name}") for game, name in keys[:MOST_SENTENCES])


def _fill_all(settings: Settings, table: dict[str, Any], path: Path) -> list[str]:
    """Set what fits in the tables of a file; sentences for what does not."""
    games = table.pop("games", {})
    former = {key: table.pop(key) for key in FORMER if key in table}
    said = _fill(settings.choice("pitanks"), former, f"{path}: ") if former else []
    said += _fill(settings, table, f"{path}: ")
    for game, entries in games.items() if isinstance(games, dict) else [("games", games)]:
        if not isinstance(entries, dict):
            said.append(f"{path}: {one_line(game, LONGEST)} is not a table; it is ignored.")
        elif len(game) > LONGEST or (game not in settings.games and len(settings.games) >= MOST_GAMES):
            said.append(f"{path}: games.{one_line(game, LONGEST)} is one game too many, or its name is; it is ignored.")
        else:
            said += _fill(settings.choice(game), entries, f"{path}: games.{one_line(game, LONGEST)}.")
    more = len(said) - MOST_SENTENCES
    return said if more <= 1 else [*said[:MOST_SENTENCES], f"{path}: {more} more lines are wrong; they are ignored."]


def _fill(target: Any, table: dict[str, Any], where: str) -> list[str]:
    """Set what fits; a sentence for everything that does not."""
    said = []
    validators = {one.name: one.metadata["validator"] for one in fields(target) if "validator" in one.metadata}
    for key, value in table.items():
        if key not in validators:
            said.append(f"{where}{one_line(key, LONGEST)} is not a setting; it is ignored.")
        elif error := validators[key].error(value):
            said.append(f"{where}{key} = {quote(value)} is {error}; {getattr(target, key)!r} is used.")
        else:
            setattr(target, key, float(value) if isinstance(getattr(target, key), float) else value)
    return said
