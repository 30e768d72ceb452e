"""Games from elsewhere: list them, switch them on or off.

A game is a package in the folder `games` of the data folder, or an installed one. It runs code of its own, so a new one
plays only once it was switched on.
"""

import json
from argparse import ArgumentParser, Namespace

from pigaming_app.games.registry import OURS, games
from pigaming_app.games.setup import require_one_of
from pigaming_app.jobs.terminal.options import shared
from pigaming_app.jobs.terminal.refusal import refused
from pigaming_app.storage.plugins.consent import is_on, switch
from pigaming_app.storage.plugins.found import found, user_folder
from pigaming_app.storage.plugins.parts import failures

STATES = {None: "new", True: "on", False: "off"}


def options(parser: ArgumentParser) -> None:
    parser.add_argument("word", choices=("list", "on", "off"), nargs="?", default="list", metavar="list | on | off")
    parser.add_argument("game", nargs="?", metavar="GAME", help="name of the game to switch")
    shared(parser, "--json")


def run(arguments: Namespace) -> int:
    """List the games, or switch one from the next start on. Raises Refusal, NotSaved."""
    plugins = found()
    if arguments.word != "list":
        named = {plugin.name: plugin for plugin in reversed(plugins)}
        with refused(ValueError):
            require_one_of("game to switch", arguments.game or "", list(named))
        switch(named[arguments.game].key, arguments.word == "on")
        print(f"{arguments.game} is {arguments.word}, from the next start on")
        return 0
    playing = games()
    if arguments.json:
        listed = [
            {"game": plugin.name, "state": STATES[is_on(plugin)], "folder": str(plugin.folder), "origin": plugin.origin}
            for plugin in plugins
        ]
        print(json.dumps({"own": list(OURS), "plugins": listed, "failures": failures(), "folder": str(user_folder())}))
        return 0
    print(f"{', '.join(OURS)}: always there")
    for plugin in plugins:
        left_out = plugin.fault or (is_on(plugin) and plugin.name not in playing)
        state = f"{STATES[is_on(plugin)]}{', left out' if left_out else ''}"
        print(f"{plugin.name}: {state}, in {plugin.folder}{f': {plugin.fault}' if plugin.fault else ''}")
    print(f"more: packages in {user_folder()}, or `main.py new-game NAME`")
    return 0
