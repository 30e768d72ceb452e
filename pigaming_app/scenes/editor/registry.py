"""The editors of the games. A game without one, such as a plug-in, has none."""

from collections.abc import Mapping

from pigaming_app.scenes.editor.games.factory import FactoryTools
from pigaming_app.scenes.editor.games.pitanks import PiTanksTools
from pigaming_app.scenes.editor.games.race import RaceTools
from pigaming_app.scenes.editor.model.shapes import Tools

EDITORS: Mapping[str, Tools] = {tools.game: tools for tools in (PiTanksTools(), FactoryTools(), RaceTools())}  # by game
