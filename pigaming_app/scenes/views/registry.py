"""How each game appears on the screens."""

from collections.abc import Mapping

from pigaming_app.scenes.views.game_screens import GameScreens
from pigaming_app.scenes.views.games import factory, pitanks, race
from pigaming_app.storage.plugins.parts import parts

SCREENS: Mapping[str, GameScreens] = {
    "pitanks": pitanks.SCREENS,
    "factory": factory.SCREENS,
    "race": race.SCREENS,
    **parts("screens", "SCREENS", GameScreens),
}  # by game
