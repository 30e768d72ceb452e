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
    plugins = {plugin.name: plugin for plugin in found()}
    if arguments.word != "list":
        with refused(ValueError):
            require_one_of("game to switch", arguments.game or "", list(plugins))
        switch(arguments.game, arguments.word == "on")
        print(f"{arguments.game} is {arguments.word}, from the next start on")
        return 0
    states = {name: STATES[is_on(plugin)] for name, plugin in plugins.items()}
    playing = games()
    if arguments.json:
        folders = {name: str(plugin.folder) for name, plugin in plugins.items()}
        listed = [{"game": name, "state": state, "folder": folders[name]} for name, state in states.items()]
        print(json.dumps({"own": list(OURS), "plugins": listed, "failures": failures(), "folder": str(user_folder())}))
        return 0
    print(f"{', '.join(OURS)}: always there")
    for name, state in states.items():
        reason = "" if state != "on" or name in playing else ", left out"
        print(f"{name}: {state}{reason}, in {plugins[name].folder}")
    print(f"more: packages in {user_folder()}, or `main.py new-game NAME`")
    return 0
