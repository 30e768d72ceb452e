"""Arena files from elsewhere: the game that they belong to, and copies among the user's arenas."""

from functools import partial
from pathlib import Path

from pigaming_app.games.arenas import MOST_OWN, is_own_name, load, load_file, own_folder, read_source, shipped_arenas
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.games.registry import games
from pigaming_app.games.setup import require_game
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.scenes.editor.store import is_full
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.storage.parsing import quote
from pigaming_app.storage.safe_files import write_atomic


def import_file(file: Path, game: str | None, name: str | None, replace: bool) -> str:
    """Copy a file to the user's arenas; returns a sentence. Raises ArenaError, ChoiceError, Refusal, NotSaved."""
    game, arena = read_file(file, game)
    name = name if name is not None else file.stem.lower()
    if not is_own_name(game, name):
        raise Refusal(f"an arena cannot have the name {quote(name)}: --as NAME, of a-z, 0-9, - and _, not one of ours")
    target = own_folder(game) / f"{name}.toml"
    if target.exists() and not replace:
        raise Refusal(f"{game} has an arena {name}: --as NAME for another name, --replace to replace it")
    if not target.exists() and is_full(game):
        raise Refusal(f"{game} has {MOST_OWN} arenas of yours already: delete one first, or --replace one of them")
    write_atomic(target, arena.source.encode())
    return f"{name} is an arena of {game}, in {target}"


def read_file(file: Path, game: str | None) -> tuple[str, Arena]:
    """The game and the arena of a file. Raises ArenaError with the error of the game that its tables belong to."""
    if game is not None:
        require_game(game)
        return game, load_file(game, file)
    errors: dict[str, ArenaError] = {}
    for name in games():
        try:
            return name, load_file(name, file)
        except ArenaError as error:
            errors[name] = error
    raise errors[max(errors, key=partial(_likeness, _tables(file)))]


def _tables(file: Path) -> set[str]:
    """The names of a file's tables; none if it has no such."""
    try:
        return {part.kind for part in drawing_of(read_source(file)).parts}
    except (OSError, UnicodeDecodeError, FieldError):
        return set()


def _likeness(tables: set[str], game: str) -> int:
    """How much the tables are those of a game's arenas."""
    usual = {part.kind for part in drawing_of(load(game, shipped_arenas(game)[0]).source).parts}
    return len(tables & usual) - len(tables ^ usual)
