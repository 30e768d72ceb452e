"""Drawing of a game's arenas."""

from pigaming_app.scenes.editor.model.routes import legs
from pigaming_app.scenes.editor.model.shapes import (
    Dial,
    Item,
    Outline,
    Paper,
    Routes,
    Shape,
    Tool,
    Tools,
    apart,
    following,
    square,
    whole,
)
from pigaming_app.scenes.editor.model.symmetry import Image
from pigaming_app.scenes.editor.parts.starts import Start, starts_of
from pigaming_app.scenes.editor.parts.things import Thing
from pigaming_app.scenes.editor.parts.walls import ROCK_TOOL, SHORT, SOLID_WALL, Wall, rock

__all__ = [
    "ROCK_TOOL",
    "SHORT",
    "SOLID_WALL",
    "Dial",
    "Image",
    "Item",
    "Outline",
    "Paper",
    "Routes",
    "Shape",
    "Start",
    "Thing",
    "Tool",
    "Tools",
    "Wall",
    "apart",
    "following",
    "legs",
    "rock",
    "square",
    "starts_of",
    "whole",
]
