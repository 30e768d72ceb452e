"""Pictures and sounds of a match."""

from pigaming_app.scenes.views.game_screens import GameScreens
from pigaming_app.scenes.views.lesson import Actor, Lesson
from pigaming_app.scenes.views.simple import SimpleView
from pigaming_app.scenes.views.sprites.robot import robot
from pigaming_app.scenes.views.style import STYLE
from pigaming_app.ui.draw import GlowCanvas, dim, regular_polygon
from pigaming_app.ui.draw.sprites import Batch, light_sprite, put, turning_sprite

__all__ = [
    "STYLE",
    "Actor",
    "Batch",
    "GameScreens",
    "GlowCanvas",
    "Lesson",
    "SimpleView",
    "dim",
    "light_sprite",
    "put",
    "regular_polygon",
    "robot",
    "turning_sprite",
]
