"""Pictures and sounds of a match."""

from pigaming_app.scenes.views.background import LEFT, TOP, Background, Bit
from pigaming_app.scenes.views.game_screens import GameScreens, Placed
from pigaming_app.scenes.views.hud.parts import CLOCK
from pigaming_app.scenes.views.hud.score import ScoreHud
from pigaming_app.scenes.views.lesson import Actor, Lesson
from pigaming_app.scenes.views.preview import fitted, walls
from pigaming_app.scenes.views.rumble import GIVEN
from pigaming_app.scenes.views.simple import SimpleView, on_canvas
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites.factory import TEAMS
from pigaming_app.scenes.views.sprites.robot import robot, tank
from pigaming_app.scenes.views.things.styles import NEON
from pigaming_app.scenes.views.view import SoundCue, ViewOptions
from pigaming_app.scenes.views.walled_background import Starts, walled_floor
from pigaming_app.ui.draw import (
    ADD,
    ALARM,
    FOCUS,
    HAIR,
    HERO,
    ICE,
    LABEL,
    LINE,
    MIST,
    PLAYERS,
    STEEL,
    THIN,
    WHITE,
    Color,
    GlowCanvas,
    Point,
    dim,
    mix,
    readable,
    regular_polygon,
)
from pigaming_app.ui.draw.frame_budget import Job, Steps, resumable
from pigaming_app.ui.draw.icons import Pen
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.sprites import Batch, Sprite, faded, painted, put, step, trim, turned
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size, text
from pigaming_app.ui.i18n import Words

__all__ = [
    "ADD",
    "ALARM",
    "CLOCK",
    "FOCUS",
    "GIVEN",
    "HAIR",
    "HERO",
    "ICE",
    "LABEL",
    "LEFT",
    "LINE",
    "MIST",
    "NEON",
    "PLAYERS",
    "STEEL",
    "TEAMS",
    "THIN",
    "TOP",
    "WHITE",
    "Actor",
    "Background",
    "Batch",
    "Bit",
    "Color",
    "GameScreens",
    "GlowCanvas",
    "Job",
    "Lesson",
    "LitImage",
    "Pen",
    "Placed",
    "Point",
    "ScoreHud",
    "SimpleView",
    "SoundCue",
    "Sprite",
    "Starts",
    "Steps",
    "ViewOptions",
    "Words",
    "cached",
    "dim",
    "effects",
    "faded",
    "fit_size",
    "fitted",
    "mix",
    "on_canvas",
    "painted",
    "put",
    "readable",
    "regular_polygon",
    "resumable",
    "robot",
    "step",
    "tank",
    "text",
    "trim",
    "turned",
    "walled_floor",
    "walls",
]
