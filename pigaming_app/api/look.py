"""Pictures and sounds of a match."""

from pigaming_app.scenes.views.game_screens import GameScreens
from pigaming_app.scenes.views.lesson import Actor, Lesson
from pigaming_app.scenes.views.simple import SimpleView
from pigaming_app.scenes.views.sprites.robot import robot
from pigaming_app.scenes.views.style import STYLE
from pigaming_app.scenes.views.view import SoundCue
from pigaming_app.ui.draw import GlowCanvas, dim, mix, regular_polygon
from pigaming_app.ui.draw.sprites import Batch, Sprite, light_sprite, put, step, turning_sprite

__all__ = [
    "STYLE",
    "Actor",
    "Batch",
    "GameScreens",
    "GlowCanvas",
    "Lesson",
    "SimpleView",
    "SoundCue",
    "Sprite",
    "dim",
    "light_sprite",
    "mix",
    "put",
    "regular_polygon",
    "robot",
    "step",
    "turning_sprite",
]
