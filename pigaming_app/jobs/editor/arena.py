"""The user's own arenas: list them, share them as files, check a file.

They are TOML files in the folder `arenas` of the data folder, see docs/arenas.md.
"""

import json
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from pigaming_app.games.arenas import (
    MOST_OWN,
    arenas,
    is_own_name,
    load,
    load_file,
    own_arenas,
    own_folder,
    read_source,
    shipped_arenas,
)
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, require_game
from pigaming_app.jobs.terminal.options import JsonOption, argument, flag, option
from pigaming_app.jobs.terminal.refusal import Refusal, refused
from pigaming_app.scenes.editor.model.problems import problems
from pigaming_app.scenes.editor.store import is_full
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.storage.parsing import quote
from pigaming_app.storage.safe_files import write_atomic

COUNTS = {"list": 0, "export": 3, "import": 1, "check": 1}  # the number of words that follow
USAGE = "arena needs list, export GAME NAME FILE, import FILE, or check FILE"


@dataclass(frozen=True, kw_only=True)
class ArenaOptions(JsonOption):
    """An arena, and what to do with it."""

    word: str = argument("", default="list", choices=COUNTS, nargs="?", metavar="list | export | import | check")
    names: tuple[str, ...] = argument(
        "export: all three, import and check: FILE", default=(), nargs="*", metavar="GAME NAME FILE"
    )
    name: str | None = option("import: name of the arena, else that of the file", name=("--as",), metavar="NAME")
    game: str | None = option("game of the file, else the one that can read it", name=("--of",), metavar="GAME")
    replace: bool = flag("import: in place of an arena of the same name")


def run(options: ArenaOptions) -> int:
    """List, export, import or check. Raises Refusal, NotSaved."""
    if len(options.names) != COUNTS[options.word]:
        raise Refusal(USAGE)
    with refused(ArenaError, ChoiceError):
        match options.word:
            case "list":
                _list(options.json)
            case "export":
                game, name, target = options.names
                require_game(game)
                write_atomic(Path(target), load(game, name).source.encode())
                print(f"{name} of {game} is in {target}")
            case "import":
                print(_import_file(Path(options.names[0]), options.game, options.name, options.replace))
            case _:
                file = Path(options.names[0])
                game, arena = _read_file(file, options.game)
                marks = problems(games()[game], drawing_of(arena.source))
                print(
                    f"{file.name}: an arena of {game}, " + ("; ".join(f"{p.key}: {p.reason}" for p in marks) or "good")
                )
    return 0


def _list(as_json: bool) -> None:
    if as_json:
        listed = {game: {"arenas": arenas(game), "own": own_arenas(game)} for game in games()}
        print(json.dumps(listed))
        return
    for game in games():
        own = own_arenas(game)
        print(f"{game}: {', '.join(name + (' (own)' if name in own else '') for name in arenas(game))}")
    print(f"own arenas are in {own_folder(next(iter(games()))).parent}")


def _import_file(file: Path, game: str | None, name: str | None, replace: bool) -> str:
    """Copy a file to the user's arenas; returns a sentence. Raises ArenaError, ChoiceError, Refusal, NotSaved."""
    game, arena = _read_file(file, game)
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


def _read_file(file: Path, game: str | None) -> tuple[str, Arena]:
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
