"""How PiTanks appears on the screens."""

import math
from dataclasses import replace

from pigaming_app.games.pitanks.state import RICOCHET, SHIELD, TRIPLE, PiTanks
from pigaming_app.scenes.views.game_screens import GameScreens
from pigaming_app.scenes.views.lesson import Actor, Lesson
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


def _with_pickups(state: PiTanks) -> None:
    """Three pick-ups in a row."""
    for i, kind in enumerate((SHIELD, TRIPLE, RICOCHET)):
        pickup = state.pickups[i]
        pickup.alive, pickup.kind, pickup.x, pickup.y = state.rules.pickup_life, kind, 450.0, 520.0 - 90.0 * i


def _with_leader(state: PiTanks) -> None:
    state.robots[1].score = 2 * state.rules.bounty_lead


def _before_finale(state: PiTanks) -> None:
    state.tick = state.rules.ticks - state.rules.finale - 60


MIDDLE, FAR = (450.0, 400.0), Actor(1300.0, 800.0)  # arena px; and a rival out of sight
GUNNER, TARGET = Actor(370.0, 520.0, -45.0, "wait 0.7, fire wait 0.2"), Actor(510.0, 380.0, 135.0)

LESSONS = {
    "drive": Lesson((Actor(390, 260, 0, "go 500 260, go 530 520, go 390 540, go 370 300"),), 5.0, MIDDLE),
    "shoot": Lesson((GUNNER, replace(TARGET, does="wait 2.5, fire wait 0.2")), 4.5, MIDDLE),
    "walls": Lesson((Actor(500, 300, 180, "wait 0.6, fire wait 2.6"),), 5.0, (400.0, 330.0)),
    "pickups": Lesson((Actor(450, 600, -90, "wait 0.5, go 450 420, fire go 450 300"),), 4.5, MIDDLE, _with_pickups),
    "knockout": Lesson((GUNNER, TARGET), 3.5, MIDDLE),
    "light": Lesson((Actor(450, 470, -60, "wait 5.2, go 490 280"), FAR), 7.0, MIDDLE),
    "bounty": Lesson((GUNNER, TARGET), 3.5, MIDDLE, _with_leader),
    "finale": Lesson(
        (Actor(750, 200, -40, "wait 2, fire wait 0.2"), Actor(855, 112, 140)), 3.8, (835.0, 35.0), _before_finale
    ),
}

SCREENS = GameScreens(
    PiTanksView,
    tile,
    fire="hint_fire",
    lessons=LESSONS,
    lesson_pages=("pickups", "party"),
    awards={"hits": "shoot", "aim": "target"},
)
