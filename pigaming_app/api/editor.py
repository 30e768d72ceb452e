"""Drawing of a game's arenas."""

from pigaming_app.scenes.editor.model.shapes import Paper, Shape, Tool
from pigaming_app.scenes.editor.parts.walls import WalledTools
from pigaming_app.ui.draw.pen import Pen

__all__ = ["Paper", "Pen", "Shape", "Tool", "WalledTools"]
