"""How PiTanks appears on the screens."""

import math

from pigaming_app.scenes.views.benchmark.pitanks import BusyPiTanks
from pigaming_app.scenes.views.game_screens import GameScreens
from pigaming_app.scenes.views.lessons import pitanks as lessons
from pigaming_app.scenes.views.lessons import pitanks_party
from pigaming_app.scenes.views.pitanks.view import PiTanksView
from pigaming_app.scenes.views.sprites.robot import robot
from pigaming_app.scenes.views.sprites.wall import draw_wall
from pigaming_app.ui.draw import BLUE, LABEL, ORANGE, PLAYERS, THIN, WHITE, GlowCanvas, dim


def _shot(ink: GlowCanvas, player: int, x: float, y: float, angle: float) -> None:
    ink.set_transform(x, y, angle)
    for i in range(6):
        ink.line([(-44 + 6 * i, 0), (0, 0)], dim(PLAYERS[player], 0.15 + 0.15 * i), 3 + i)
    ink.disc(1, 0, 5, WHITE).set_transform(0, 0)


def tile(ink: GlowCanvas, x: float, y: float) -> None:
    draw_wall(ink.set_transform(x + 290, y + 128, 1.2), 170, 30, 3, 12)
    robot(ink, 0, x + 118, y + 184, -0.42, 1.15)
    robot(ink, 1, x + 454, y + 84, 2.75, 1.15)
    _shot(ink, 0, x + 234, y + 132, -0.42)
    _shot(ink, 1, x + 346, y + 129, 2.75)
    for i in range(9):  # a recent hit
        c, s = math.cos(-2.5 + i * 0.45), math.sin(-2.5 + i * 0.45)
        ink.line([(x + 454 + 58 * c, y + 84 + 58 * s), (x + 454 + 70 * c, y + 84 + 70 * s)], ORANGE, THIN)
    ink.text("+1", LABEL, x + 118, y + 100, BLUE, "hero", "c")


LESSONS = {
    "drive": lessons.drive,
    "shoot": lessons.shoot,
    "walls": lessons.walls,
    "pickups": lessons.pickups,
    "knockout": pitanks_party.knockout,
    "light": pitanks_party.light,
    "bounty": pitanks_party.bounty,
    "finale": pitanks_party.finale,
}

SCREENS = GameScreens(
    PiTanksView,
    tile,
    lambda variant: BusyPiTanks(variant=variant),
    fire="hint_fire",
    lessons=LESSONS,
    lesson_pages=("pickups", "party"),
)
