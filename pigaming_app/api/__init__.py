"""All that a game from elsewhere may import, by what its author does; nothing else of this package is meant for it.

`rules` and `arenas` (state, physics, arena files), `brains` (written by hand), `networks` and `learning` (trained), and
`look` (pictures, sounds), `editor` (drawing of arenas), `environments` (for learning libraries), which need pygame;
`robots` for a driver of robots.
"""

from pigaming_app.games.game import Game, LadderMatches, Variant
from pigaming_app.storage.plugins.found import API

MODULES = ("rules", "arenas", "brains", "networks", "learning", "look", "editor", "environments", "robots")
__all__ = ["API", "Game", "LadderMatches", "Variant"]
