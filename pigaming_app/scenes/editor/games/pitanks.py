"""PiTanks: walls, rocks, mud, and a start for each robot."""

from collections.abc import Mapping
from typing import ClassVar

from pigaming_app.games.drawing.values import Drawing
from pigaming_app.scenes.editor.model.shapes import Shape, Tools
from pigaming_app.scenes.editor.parts.starts import Start, starts_of
from pigaming_app.scenes.editor.parts.things import MUD, DrawnThing
from pigaming_app.scenes.editor.parts.walls import ROCK_TOOL, WALL, DrawnWall
from pigaming_app.scenes.views.things.styles import NEON

EMPTY = Drawing(starts_of((100, 100, 45), (1500, 800, 225), (100, 800, 315), (1500, 100, 135)))


class PiTanksTools(Tools):
    """The editor of PiTanks."""

    game = "pitanks"
    shapes: ClassVar[Mapping[str, Shape]] = {"thing": DrawnThing(NEON), "wall": DrawnWall(), "start": Start()}
    palette = (WALL, ROCK_TOOL, MUD)
    empty = EMPTY


TOOLS = PiTanksTools()
