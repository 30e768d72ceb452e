"""Where the arenas of the games lie: files under assets/arenas/GAME/, read by the game they are for."""

from pathlib import Path

from pigaming_app import ASSETS
from pigaming_app.games.registry import games
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.sim.arena import parse as parse_by

MOST_BYTES = 100_000  # of a file; replays hold a copy


def arenas(game: str) -> list[str]:
    """The names of a game's arenas, `classic` first."""
    names = sorted(path.stem for path in (ASSETS / "arenas" / game).glob("*.toml"))
    return sorted(names, key=lambda name: name != "classic")


def load(game: str, name: str) -> Arena:
    """An arena of a game by its name, or by the path of a file that ends in .toml. Raises ArenaError."""
    path = Path(name) if name.endswith(".toml") else ASSETS / "arenas" / game / f"{name}.toml"
    try:
        if not path.exists():
            raise ArenaError(f"{name}: no such arena for {game}; there are {', '.join(arenas(game))}")
        return parse(game, _read(path), path.name)
    except OSError as error:
        raise ArenaError(f"{path.name}: file: cannot be read ({error.strerror or error})") from None
    except UnicodeDecodeError:
        raise ArenaError(f"{path.name}: file: cannot be read (it is not text in UTF-8)") from None


def _read(path: Path) -> str:
    """The text of a file, without a byte order mark. Raises OSError, UnicodeDecodeError."""
    if not path.is_file():  # opening a pipe would wait
        raise OSError("it is not a file")
    with path.open("rb") as file:
        raw = file.read(MOST_BYTES + 1)
    if len(raw) > MOST_BYTES:
        raise OSError(f"it is larger than {MOST_BYTES:,} bytes")
    return raw.decode("utf-8-sig")  # Notepad writes the mark


def parse(game: str, source: str, file: str) -> Arena:
    """Check the text of an arena file of a game. Raises ArenaError, which names `file`, the key and the reason."""
    return parse_by(source, file, games()[game].read)
