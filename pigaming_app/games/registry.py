"""All games: those of this package, then those of plug-ins."""

from collections.abc import Mapping
from functools import cache

from pigaming_app.games.game import Game
from pigaming_app.sim.kernel import add_sources
from pigaming_app.storage.optional import optional
from pigaming_app.storage.plugins.parts import RULES, kernel_sources, parts, plugins

NAMES = ("pitanks", "factory", "race")  # of the games of this package, any of which may be missing
OURS: dict[str, Game] = {name: room.GAME for name in NAMES if (room := optional(f"games.{name}"))}


@cache
def games() -> Mapping[str, Game]:
    """Every game by its name, in the order of the title screen."""
    for plugin in plugins():
        add_sources(plugin.folder, kernel_sources(plugin))
    return {**OURS, **parts(RULES, "GAME", Game, _unusable)}


def _unusable(name: str, game: Game) -> str:
    """The reason why a plug-in's game cannot be used, or nothing."""
    if name in OURS:
        return f"there is a game {name} already"
    if game.name != name:
        return f"its game is named {game.name}, not {name}"
    folder = next(plugin.folder for plugin in plugins() if plugin.name == name) / "arenas"
    needed = (game.arena, *(game.ladder.arenas if game.ladder else ()))
    if game.ladder and all(variant.teams[0] == variant.teams[1] for variant in game.variants.values()):
        return "ladder: by none of its rules are seats 0 and 1 opponents"
    return next((f"arenas/{arena}.toml is missing" for arena in needed if not (folder / f"{arena}.toml").is_file()), "")
