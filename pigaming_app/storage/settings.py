"""The operator's settings, and the folders of the arcade's files.

Settings are one TOML file in the platform's standard folder. It may be edited by hand: every invalid entry is reported
with file, key and reason, and replaced by its default. Several instances of the arcade may share it: each writes only
the settings that it has changed.
"""

import logging
import os
import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from datetime import time
from pathlib import Path
from typing import Annotated, Any, get_type_hints

from msgspec import Meta

from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.parsing import one_line, parse_toml, quote
from pigaming_app.storage.safe_files import read_or_restore, write_with_backup
from pigaming_app.storage.schema import PRINTABLE, between, one_of, typed

FILE = "settings.toml"
LEVELS = ("level1", "level2", "level3", "level4", "level5")  # of AIs
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


Short = Annotated[str, PRINTABLE, Meta(max_length=MAX_NAME)]  # a name of something that may no longer exist
Seat = Annotated[int, between(1, 4)]
Volume = Annotated[int, between(0, 10)]
PHONE = "phone"  # in place of a camera's number
CAMERAS = 64  # numbers of cameras, from 0
USER = r"([!\"$-.0->@-Z^-~]*@)?"  # of an address, perhaps with a password: a / in it would cut the address
STREAM = Meta(
    pattern=rf"^({PHONE}|(https?|rtsp)://{USER}[A-Za-z0-9._-]+(:\d{{1,5}})?([/?][!-?A-~]*)?)\Z", max_length=200
)  # address of a camera in the network, or a phone; a misplaced @ would show a piece of a password as the host
HEX_KEY = Meta(pattern=r"^([0-9a-f]{32})?\Z")
Functions = Annotated[dict[Short, Annotated[int, Meta(ge=0, lt=1024)]], Meta(min_length=1, max_length=MAX_DEVICES)]


def different(seats: list[int]) -> str:
    """The reason why a list of seats is invalid; empty if it is valid."""
    return "not different numbers" if len(set(seats)) < len(seats) else ""


def none_or_eight(corners: list[int]) -> str:
    """The reason why a list of corners is invalid; empty if it is valid."""
    return "" if len(corners) in (0, 8) else "neither empty nor eight numbers"


def none_or_four(tops: list[int]) -> str:
    """The reason why a list of speeds is invalid; empty if it is valid."""
    return "" if len(tops) in (0, 4) else "neither empty nor four numbers"


def time_of_day(text: str) -> str:
    """The reason why a text is no time; empty if it is one."""
    return "" if re.fullmatch(r"([01]\d|2[0-3]):[0-5]\d", text) else "not a time such as 22:30"


@dataclass
class Choice:
    """The last choices in the setup of one game; empty or 0 is the game's default."""

    arena: Short = ""
    minutes: Annotated[int, between(0, 60)] = 0
    variant: Short = ""
    goal: Annotated[int, between(0, 99)] = 0
    rounds: Annotated[int, between(1, 9)] = 1


_DEFAULT = Choice()
Key = tuple[str | None, str]  # game or None, name of the setting
Flat = dict[Key, Any]


@dataclass
class Settings:
    """The operator's settings, and the last choices before a match."""

    language: Annotated[str, one_of("en", "pt", "es", "fr", "de")] = "en"
    music: Volume = 8
    sounds: Volume = 10
    flashes: Annotated[str, one_of("off", "soft", "full")] = "full"
    shake: bool = True
    calm: bool = False  # nothing flashes more than three times a second, nothing shakes
    large_text: bool = False  # in menus, where there is room
    rumble: bool = True  # of the pads
    display: Annotated[int, between(0, 15)] = 0
    fullscreen: bool = True
    phones: bool = False  # phones may join as pads
    phones_network: Short = ""  # name or address of their interface; empty: the first one
    phones_port: Annotated[int, between(1024, 65535)] = 8787
    phones_stay: bool = False  # the winner plays the next match, too, when others wait
    phones_teams: bool = False  # a lobby begins with two teams
    phones_wifi: Annotated[str, PRINTABLE, Meta(max_length=32)] = ""  # name of the Wi-Fi for a code of its own
    phones_wifi_key: Annotated[str, PRINTABLE, Meta(max_length=63)] = ""  # its password; empty: an open network
    bots: bool = False  # programs may watch matches and play, on the network of the phones
    bots_vision: bool = False  # poses are sent as in RoboCup's Small Size League
    desk: bool = False  # pages of the running event for browsers, on the network of the phones
    attract_seconds: Annotated[float, between(5.0, 3600.0)] = 60.0  # without input
    corners: Annotated[list[Annotated[int, Meta(gt=-10_000, lt=10_000)]], none_or_eight] = field(
        default_factory=list
    )  # of the picture on the projector, px of the canvas: x and y of all four
    strength: Annotated[str, one_of("auto", *LEVELS)] = "auto"  # of the AIs that fill the seats
    camera: Annotated[int, between(0, CAMERAS - 1)] | Annotated[str, STREAM] = 0  # over the mat
    arena_mm: Annotated[float, between(500.0, 10000.0)] = 2112.0  # the arena's width on the mat
    camera_mm: Annotated[float, between(0.0, 10000.0)] = 2500.0  # its height above it; 0: measured with a robot
    lid_mm: Annotated[float, between(0.0, 300.0)] = 70.0  # the height of the robots' lids
    port: Short = ""  # of the radio; empty: the first one found
    baud: Annotated[int, between(1200, 921600)] = 57600
    radio: Short = "api2"  # the name of its driver
    arena_id: Annotated[int, between(0, 16383)] = 0  # of this computer and its robots; 0: drawn on first use
    wifi_key: Annotated[str, HEX_KEY] = ""  # of this arena and its Wi-Fi robots; empty: drawn on first use
    radio_channel: Annotated[int, between(0, 26)] = 0  # of the XBees, 11 to 26; 0: follows from the arena id
    radio_pan: Annotated[int, between(0, 65534)] = 0  # of the XBees; 0: follows from the arena id
    mat: bool = False  # real robots are selectable
    blocks: bool = False  # things on the mat are blocks with markers, for a mat without projector
    real: Annotated[list[Seat], different] = field(default_factory=list)  # seats with real robots, last chosen
    radios: Annotated[list[Seat], Meta(min_length=4), different] = field(
        default_factory=lambda: [1, 2, 3, 4]
    )  # of each marker
    camera_delay: Annotated[int, between(-1, 120)] = -1  # ms by which the camera's stamps are late; -1: never measured
    kinds: Annotated[list[Short], Meta(min_length=4, max_length=4)] = field(
        default_factory=lambda: [""] * 4
    )  # of the robot on each radio; empty: as it announces
    tops: Annotated[list[Annotated[int, between(0, 5000)]], none_or_four] = field(
        default_factory=list
    )  # mm/s, of a wheel of the robot on each radio, by the test drive; 0: as fast as it can; empty: never driven
    pad_driving: Short = ""  # driving style last chosen on a pad; empty: never
    keys_driving: Short = ""  # the same on the keyboard
    keypad: bool = False  # a key of the number pad was pressed once
    scoreboard: Annotated[int, between(0, 16)] = 0  # the display of the second screen, from 1; 0: none
    volume_cap: Volume = 10  # of music and sounds
    quiet_from: Annotated[str, time_of_day] = "00:00"  # title and attract mode are silent from here
    quiet_until: Annotated[str, time_of_day] = "00:00"  # to here; the same time: never
    group_minutes: Annotated[int, between(0, 120)] = 0  # from the title to the title; 0: no limit
    keep_choices: bool = False  # visitors' choices stay and are saved
    pin_asked: bool = False  # a kiosk has asked for a PIN once
    controls: Annotated[dict[Short, Functions], Meta(max_length=MAX_DEVICES)] = field(
        default_factory=dict
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
        try:
            setattr(self, name, _valid(Settings, name, value))
        except ValueError as error:
            raise ValueError(f"{name} = {value!r}: {error}") from None

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
        return {key: value for key, value in _flat(self).items() if not _is_choice(key)} | self._house

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
    return {key: value for key, value in _flat(settings).items() if _is_choice(key)}


def _is_choice(key: Key) -> bool:
    """Whether visitors choose a setting."""
    return key[0] is not None or key[1] in VISITORS


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
    problems = _fill(settings, table, f"{path}: ")
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
    for key, value in table.items():
        if key == "games" or key not in TYPES[type(target)]:
            problems.append(f"{where}{one_line(key, MAX_NAME)} is not a setting; it is ignored.")
            continue
        try:
            setattr(target, key, _valid(type(target), key, value))
        except ValueError as error:
            problems.append(f"{where}{key} = {quote(value)}: {error}; {getattr(target, key)!r} is used.")
    return problems


TYPES = {kind: get_type_hints(kind, include_extras=True) for kind in (Choice, Settings)}  # by names of settings


def _valid(kind: Any, name: str, value: object) -> Any:
    """The value of a setting. Raises ValueError with the reason if it is invalid."""
    found = typed(value, TYPES[kind][name])
    for check in getattr(TYPES[kind][name], "__metadata__", ()):
        if callable(check) and (reason := check(found)):
            raise ValueError(reason)
    return found
