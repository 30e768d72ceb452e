"""The user's own arenas: list them, share them as files, check a file.

They are TOML files in the folder `arenas` of the data folder, see docs/arenas.md.
"""

import json
from argparse import ArgumentParser, Namespace
from pathlib import Path

from pigaming_app.games.arenas import arenas, load, own_arenas, own_folder
from pigaming_app.games.drawing.problems import problems
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, require_game
from pigaming_app.jobs.arena.files import import_file, read_file
from pigaming_app.jobs.terminal.options import shared
from pigaming_app.jobs.terminal.refusal import Refusal, refused
from pigaming_app.sim.arena import ArenaError
from pigaming_app.storage.safe_files import write_atomic

WORDS = {"list": 0, "export": 3, "import": 1, "check": 1}  # the number of words that follow
USAGE = "arena needs list, export GAME NAME FILE, import FILE, or check FILE"


def options(parser: ArgumentParser) -> None:
    parser.add_argument("word", choices=WORDS, nargs="?", default="list", metavar="list | export | import | check")
    parser.add_argument("names", nargs="*", metavar="GAME NAME FILE", help="export: all three, import and check: FILE")
    parser.add_argument("--as", dest="name", metavar="NAME", help="import: name of the arena, else that of the file")
    parser.add_argument("--of", dest="game", metavar="GAME", help="game of the file, else the one that can read it")
    parser.add_argument("--replace", action="store_true", help="import: in place of an arena of the same name")
    shared(parser, "--json")


def run(arguments: Namespace) -> int:
    """List, export, import or check. Raises Refusal, NotSaved."""
    if len(arguments.names) != WORDS[arguments.word]:
        raise Refusal(USAGE)
    with refused(ArenaError, ChoiceError):
        match arguments.word:
            case "list":
                _list(arguments.json)
            case "export":
                game, name, file = arguments.names
                require_game(game)
                write_atomic(Path(file), load(game, name).source.encode())
                print(f"{name} of {game} is in {file}")
            case "import":
                print(import_file(Path(arguments.names[0]), arguments.game, arguments.name, arguments.replace))
            case _:
                file = Path(arguments.names[0])
                game, arena = read_file(file, arguments.game)
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
