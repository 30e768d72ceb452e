"""Loading of arenas: files under assets/arenas/GAME/, or in a plug-in, parsed by their game, and arenas from a seed."""

import re
from collections.abc import Sequence
from pathlib import Path

from pigaming_app import ASSETS
from pigaming_app.games.registry import games
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.sim.arena import parse as parse_arena
from pigaming_app.sim.things.spec import ThingSpec, written
from pigaming_app.storage.plugins.parts import data_folders

MAX_BYTES = 100_000  # per file; replays contain a copy
SURPRISE = re.compile(r"surprise-(\d{1,9})")  # name of an arena that is made from this seed


def arenas(game: str) -> list[str]:
    """The names of a game's arenas, `classic` first."""
    names = sorted(path.stem for path in _folder(game).glob("*.toml"))
    return sorted(names, key=lambda name: name != "classic")


def load(game: str, name: str) -> Arena:
    """Load an arena of a game: by its name, as `surprise-SEED`, or by the path of a .toml file. Raises ArenaError."""
    make, seed = games()[game].surprise, SURPRISE.fullmatch(name)
    if make and seed:
        return parse(game, make(int(seed[1])), name)
    path = Path(name) if name.endswith(".toml") else _folder(game) / f"{name}.toml"
    try:
        if not path.exists():
            raise ArenaError(f"{name}: no such arena for {game}; there are {', '.join(arenas(game))}")
        return parse(game, _read(path), path.name)
    except OSError as error:
        raise ArenaError(f"{path.name}: file: cannot be read ({error.strerror or error})") from None
    except UnicodeDecodeError:
        raise ArenaError(f"{path.name}: file: cannot be read (it is not text in UTF-8)") from None


def _folder(game: str) -> Path:
    """The folder of a game's arenas."""
    return dict(data_folders("arenas")).get(game, ASSETS / "arenas" / game)


def _read(path: Path) -> str:
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


def with_things(game: str, arena: Arena, things: Sequence[ThingSpec]) -> Arena:
    """An arena of a game with real things on it. Raises ArenaError if it cannot be played with them."""
    return parse(game, arena.source + written(things), f"{arena.name}.toml") if things else arena
