"""The editors of the games; a plug-in may have none."""

from collections.abc import Mapping

from pigaming_app.scenes.editor.games.factory import FactoryTools
from pigaming_app.scenes.editor.games.pitanks import PiTanksTools
from pigaming_app.scenes.editor.games.race import RaceTools
from pigaming_app.scenes.editor.model.shapes import Tools
from pigaming_app.storage.plugins.parts import EDITOR, parts


def _misnamed(name: str, tools: Tools) -> str:
    return "" if tools.game == name else f"its tools are for {tools.game or 'no game'}, not for {name}"


EDITORS: Mapping[str, Tools] = {
    **{tools.game: tools for tools in (PiTanksTools(), FactoryTools(), RaceTools())},
    **parts(EDITOR, "TOOLS", Tools, _misnamed),
}  # by game
