"""The editors of the games; a plug-in may have none."""

from collections.abc import Mapping

from pigaming_app.games.registry import OURS
from pigaming_app.scenes.editor.model.shapes import Tools
from pigaming_app.storage.optional import optional
from pigaming_app.storage.plugins.parts import EDITOR, parts


def _misnamed(name: str, tools: Tools) -> str:
    return "" if tools.game == name else f"its tools are for {tools.game or 'no game'}, not for {name}"


EDITORS: Mapping[str, Tools] = {
    **{game: optional(f"scenes.editor.games.{game}").TOOLS for game in OURS},
    **parts(EDITOR, "TOOLS", Tools, _misnamed),
}  # by game
