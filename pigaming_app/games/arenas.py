"""Loading of arenas: files under assets/arenas/GAME/, or in a plug-in, parsed by their game, and arenas from a seed.

The user's own arenas are in `arenas/GAME/` of the data folder. Their names are never those of other arenas.
"""

import hashlib
import logging
import re
from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from pigaming_app import ASSETS
from pigaming_app.games.registry import OURS, games
from pigaming_app.sim.arena import WIDEST_ROBOT, Arena, ArenaError, start_faults, written_radius
from pigaming_app.sim.arena import parse as parse_arena
from pigaming_app.sim.things.spec import ThingSpec, written
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import RADIUS
from pigaming_app.storage.plugins.parts import data_folders
from pigaming_app.storage.settings import folders

MAX_BYTES = 100_000  # per file; replays contain a copy
SURPRISE = re.compile(r"surprise-(\d{1,9})")  # name of an arena that is made from this seed


NAME = re.compile(r"[a-z0-9][a-z0-9_-]{0,39}")  # of a user's arena
RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)")  # names of devices on Windows
MOST_OWN = 60  # arenas of the user in a game; others are left out
log = logging.getLogger("pigaming")


def arenas(game: str) -> list[str]:
    """The names of a game's arenas, its default first, the user's own last; damaged ones of these are left out."""
    return [*shipped_arenas(game), *own_arenas(game)]


def shipped_arenas(game: str) -> list[str]:
    """The names of the arenas that come with a game, its default first."""
    names = sorted(path.stem for path in _folder(game).glob("*.toml"))
    return sorted(names, key=lambda name: name != games()[game].arena)


def default_goal(game: str, variant: str, arena: str) -> int:
    """The goal of a match unless another one is chosen: that of the arena, if it comes with the game and has one."""
    offered = games()[game].variants[variant]
    return (offered.goals and _goal_of(game, arena)) or offered.default_goal


@lru_cache(maxsize=64)
def _goal_of(game: str, name: str) -> int:
    """The goal in the file of an arena that comes with a game; 0: none."""
    read = games()[game].goal_of
    if read is None or name not in shipped_arenas(game):
        return 0
    return read(TomlTable.parse(read_source(_folder(game) / f"{name}.toml")))


def own_arenas(game: str) -> list[str]:
    """The names of the user's arenas of a game; damaged files are left out, each with one line in the log."""
    try:
        found = sorted(path.stem for path in own_folder(game).glob("*.toml"))
    except OSError:
        return []
    shipped = shipped_arenas(game)
    names = [name for name in found if _is_possible(name) and name not in shipped][:MOST_OWN]
    return [name for name in names if isinstance(_own(game, name), Arena)]


def own_folder(game: str) -> Path:
    """The folder of the user's arenas of a game. It may be missing."""
    return folders().data / "arenas" / game


def is_own_name(game: str, name: str) -> bool:
    """True if an arena of the user may have this name."""
    return _is_possible(name) and name not in shipped_arenas(game)


def _is_possible(name: str) -> bool:
    return bool(NAME.fullmatch(name)) and not RESERVED.fullmatch(name) and not SURPRISE.fullmatch(name)


def score_name(game: str, name: str) -> str:
    """The name of an arena in high-score tables: the user's arenas begin new ones with each change of their file."""
    own = _own(game, name) if is_own_name(game, name) else None
    return f"{name}-{hashlib.sha256(own.source.encode()).hexdigest()[:8]}" if isinstance(own, Arena) else name


def load(game: str, name: str) -> Arena:
    """Load an arena of a game: by its name, as `surprise-SEED`, or by the path of a .toml file. Raises ArenaError."""
    make, seed = games()[game].surprise, SURPRISE.fullmatch(name)
    if make and seed:
        return parse(game, make(int(seed[1])), name)
    if is_own_name(game, name) and (own := _own(game, name)):
        if isinstance(own, str):
            raise ArenaError(own)
        return own
    path = Path(name) if name.endswith(".toml") else _folder(game) / f"{name}.toml"
    return _loaded(game, path, lambda: f"{name}: no such arena for {game}; there are {', '.join(arenas(game))}")


def load_file(game: str, path: Path) -> Arena:
    """Load an arena of a game from a file. Raises ArenaError."""
    return _loaded(game, path, lambda: f"{path.name}: file: there is none")


def _own(game: str, name: str) -> Arena | str | None:
    """An arena of the user, the sentence why it is unusable, or None if there is none."""
    path = own_folder(game) / f"{name}.toml"
    try:
        status = path.stat()
    except OSError:
        return None
    return _own_as_of(game, path, (status.st_ino, status.st_mtime_ns, status.st_size))


@lru_cache(maxsize=4 * MOST_OWN)
def _own_as_of(game: str, path: Path, stamp: tuple[int, int, int]) -> Arena | str:
    """An arena of the user as its file was at a stamp; a track takes a second."""
    try:
        return load_file(game, path)
    except ArenaError as error:
        log.warning("%s", error)
        return str(error)


def _loaded(game: str, path: Path, missing: Callable[[], str]) -> Arena:
    """Load a file. Raises ArenaError, if there is none with the sentence `missing`."""
    try:
        if not path.exists():
            raise ArenaError(missing())
        return parse(game, read_source(path), path.name)
    except OSError as error:
        raise ArenaError(f"{path.name}: file: cannot be read ({error.strerror or error})") from None
    except UnicodeDecodeError:
        raise ArenaError(f"{path.name}: file: cannot be read (it is not text in UTF-8)") from None


def _folder(game: str) -> Path:
    """The folder of a game's arenas."""
    ours = ASSETS / "arenas" / game
    return ours if game in OURS else dict(data_folders("arenas")).get(game, ours)


def read_source(path: Path) -> str:
    """The text of a file, without a byte order mark. Raises OSError, UnicodeDecodeError."""
    if not path.is_file():  # opening a pipe would block
        raise OSError("it is not a file")
    with path.open("rb") as file:
        raw = file.read(MAX_BYTES + 1)
    if len(raw) > MAX_BYTES:
        raise OSError(f"it is larger than {MAX_BYTES:,} bytes")
    return raw.decode("utf-8-sig")  # Notepad writes a byte order mark


def parse(game: str, source: str, file: str) -> Arena:
    """Parse and validate an arena file of a game. Raises ArenaError, with `file`, key and reason."""
    return parse_arena(source, file, games()[game].read)


def on_mat(game: str, arena: Arena, things: Sequence[ThingSpec], radius: float = RADIUS) -> Arena:
    """An arena of a game with real things on it, for robots of a radius, px.

    Raises ArenaError if it cannot be played with them.
    """
    added = written(things) + (written_radius(radius) if radius > RADIUS else "")
    return parse(game, arena.source + added, f"{arena.name}.toml") if added else arena


@lru_cache(maxsize=16 * MOST_OWN)
def has_room(game: str, source: str, radius: float, berth: float = 0.0) -> bool:
    """True if robots of a radius, px, can play in an arena with this text, which the usual ones can.

    `berth`: px that they keep from walls on their ways between the starts; real ones do.
    """
    if radius <= RADIUS:
        return True
    rules = games()[game]
    try:
        table = TomlTable.parse(source + written_radius(radius))
        if rules.faults and not all(fault.flaw for fault in rules.faults(table)):
            return False
        if rules.faults and "start" not in table:  # no walls, but reading takes long
            return True
        return not any(start_faults(replace(rules.read(table), radius=radius + berth)))
    except FieldError:
        return False


def widest(game: str, source: str, berth: float = 0.0, least: float = RADIUS) -> float:
    """The largest radius, px, of robots that can play in an arena with this text, found by trying, to a tenth.

    `least` if no wider ones can; `berth`: see `has_room`.
    """
    first = round(10 * least) + 1
    tenths = range(first, round(10 * WIDEST_ROBOT) + 1)

    def is_too_wide(tenth: int) -> bool:
        return not has_room(game, source, tenth / 10, berth)

    return least if is_too_wide(first) else (first - 1 + bisect_left(tenths, True, key=is_too_wide)) / 10


@lru_cache(maxsize=4)
def widest_of_all(berth: float) -> float:
    """The largest radius, px, of robots that can play in any arena that comes with the games; `berth`: as above."""
    found = RADIUS
    for game in games():
        for name in shipped_arenas(game):
            found = widest(game, load(game, name).source, berth, found)
    return found
