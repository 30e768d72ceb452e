"""Where the arenas of the games lie: files under assets/arenas/GAME/, read by the game they are for."""

from pathlib import Path

from pigaming_app import ASSETS
from pigaming_app.games.registry import games
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.sim.arena import parse as parse_by
from pigaming_app.storage.parsing import ParseError, read_text, reason

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
        source = read_text(path, MOST_BYTES)
    except (OSError, ParseError) as error:
        raise ArenaError(f"{path.name}: file: cannot be read ({reason(error)})") from None
    return parse(game, source, path.name)


def parse(game: str, source: str, file: str) -> Arena:
    """Check the text of an arena file of a game. Raises ArenaError, which names `file`, the key and the reason."""
    return parse_by(source, file, games()[game].read)
