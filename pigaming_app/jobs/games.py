"""Games and drivers from elsewhere: list them, switch them on or off.

Either is a package in the folder `games` of the data folder, or an installed one. It runs code of its own, so a new one
is used only once it was switched on.
"""

import json
from dataclasses import dataclass

from pigaming_app.games.registry import OURS, games
from pigaming_app.games.setup import require_one_of
from pigaming_app.jobs.terminal.options import JsonOption, argument
from pigaming_app.jobs.terminal.refusal import refused
from pigaming_app.storage.plugins.consent import is_on, switch
from pigaming_app.storage.plugins.found import found, user_folder
from pigaming_app.storage.plugins.parts import failures

STATES = {None: "new", True: "on", False: "off"}


@dataclass(frozen=True, kw_only=True)
class GamesOptions(JsonOption):
    """A game to switch, or none to list them."""

    word: str = argument("", default="list", choices=("list", "on", "off"), nargs="?", metavar="list | on | off")
    game: str | None = argument("name of the game to switch", default=None, nargs="?", metavar="GAME")


def run(options: GamesOptions) -> int:
    """List the games, or switch one from the next start on. Raises Refusal, NotSaved."""
    plugins = found()
    if options.word != "list":
        named = {plugin.name: plugin for plugin in reversed(plugins)}
        game = options.game or ""
        with refused(ValueError):
            require_one_of("game to switch", game, list(named))
        switch(named[game].key, options.word == "on")
        print(f"{game} is {options.word}, from the next start on")
        return 0
    playing = games()
    if options.json:
        listed = [
            {"game": plugin.name, "state": STATES[is_on(plugin)], "folder": str(plugin.folder), "origin": plugin.origin}
            for plugin in plugins
        ]
        print(json.dumps({"own": list(OURS), "plugins": listed, "failures": failures(), "folder": str(user_folder())}))
        return 0
    print(f"{', '.join(OURS)}: always there")
    for plugin in plugins:
        left_out = plugin.fault or (is_on(plugin) and not plugin.drives and plugin.name not in playing)
        state = f"{STATES[is_on(plugin)]}{', a driver' if plugin.drives else ''}{', left out' if left_out else ''}"
        print(f"{plugin.name}: {state}, in {plugin.folder}{f': {plugin.fault}' if plugin.fault else ''}")
    print(f"more: packages in {user_folder()}, or `main.py new-game NAME`")
    return 0
