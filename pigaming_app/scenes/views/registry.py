"""How each game appears on the screens."""

from collections.abc import Mapping

from pigaming_app.scenes.views.game_screens import GameScreens
from pigaming_app.scenes.views.games import factory, pitanks, race

SCREENS: Mapping[str, GameScreens] = {
    "pitanks": pitanks.SCREENS,
    "factory": factory.SCREENS,
    "race": race.SCREENS,
}  # by game
