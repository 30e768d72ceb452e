"""How Robot Factory appears on the screens."""

import math

import pygame

from pigaming_app.scenes.views.benchmark.factory import BusyFactory
from pigaming_app.scenes.views.factory.background import draw_floor
from pigaming_app.scenes.views.factory.view import FactoryView
from pigaming_app.scenes.views.game_screens import GameScreens, Placed
from pigaming_app.scenes.views.lessons import factory as lessons
from pigaming_app.scenes.views.lessons import factory_party, factory_together
from pigaming_app.scenes.views.preview import fitted
from pigaming_app.scenes.views.sprites.factory import TEAMS
from pigaming_app.scenes.views.sprites.robot import robot
from pigaming_app.scenes.views.things.on_mat import black_out, draw_all
from pigaming_app.scenes.views.things.styles import WORKSHOP
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import ALARM, BLUE, GREEN, ICE, LINE, MIST, THIN, Color, GlowCanvas, cut_box, dim
from pigaming_app.ui.draw.frame_budget import Steps

GLOW = 0.75


def tile(ink: GlowCanvas, x: float, y: float) -> None:
    for cx, color in ((62, ALARM), (280, GREEN), (498, BLUE)):
        _pallet(ink, x + cx, y + 78, color)
    _machine(ink, x + 171, y + 78, "A")
    _machine(ink, x + 389, y + 78, "B")
    for cx in (100, 242, 318, 460):
        ink.line([(x + cx - 5, y + 68), (x + cx + 4, y + 78), (x + cx - 5, y + 88)], MIST, THIN)
    for player, cx, color in ((2, 132, GREEN), (3, 356, BLUE)):
        robot(ink, player, x + cx, y + 206, 0, 1.05)
        _pallet(ink, x + cx + 92, y + 206, color)


def _machine(ink: GlowCanvas, x: float, y: float, label: str) -> None:
    ink.line(cut_box(x - 56, y - 56, 112, 112, 16), MIST, LINE, True).ring(x, y, 27, MIST, LINE)
    for i in range(8):
        c, s = math.cos(i * math.tau / 8 + 0.2), math.sin(i * math.tau / 8 + 0.2)
        ink.line([(x + 30 * c, y + 30 * s), (x + 37 * c, y + 37 * s)], MIST, 8)
    ink.text(label, 32, x, y, ICE, "hero", "c")


def _pallet(ink: GlowCanvas, x: float, y: float, color: Color, r: float = 22) -> None:
    box = cut_box(x - r, y - r, 2 * r, 2 * r, 5)
    ink.solid(box).line(box, color, 5, True)
    ink.line([(x - r, y), (x + r, y)], color, THIN).line([(x, y - r), (x, y + r)], color, THIN)


def preview(arena: Arena, w: int, h: int, allies: bool) -> Steps[pygame.Surface]:
    """Preview of a factory floor: warehouses, machines, the aisle, start positions by team."""
    left, top, k = fitted(w, h)
    glow, crisp = (
        GlowCanvas(w, h, 3).set_transform(left, top, 0.0, k),
        GlowCanvas(w, h, 3).set_transform(left, top, 0.0, k),
    )
    yield from draw_floor((glow, crisp), arena.plan, allies)
    glow.line(cut_box(0, 0, WIDTH, HEIGHT, 28), MIST, THIN / k, True)
    black_out(crisp, arena.things)
    draw_all(glow, WORKSHOP, arena.things)
    for i, start in enumerate(arena.starts):
        glow.ring(start.x, start.y, 36, TEAMS[0 if allies else i % 2], 8)
    out = yield from glow.lit_steps(GLOW)
    yield from crisp.downscale_onto(out)
    return out


def crate(ink: GlowCanvas, placed: Placed, size: float, shape: int, color: Color) -> None:
    """Confetti: a crate."""
    box = placed(cut_box(-size, -size, 2 * size, 2 * size, 0.35 * size))
    ink.solid(box).fill(box, dim(color, 0.35)).line(box, color, 4, True)


LESSONS = {
    "lift": lessons.lift,
    "work": lessons.work,
    "deliver": lessons.deliver,
    "people": lessons.people,
    "rush": factory_party.rush,
    "loose": factory_party.loose,
    "claim": factory_party.claim,
    "fast": factory_party.fast,
    "allies": factory_together.allies,
    "stars": factory_together.stars,
    "tasks": factory_together.tasks,
    "clear": factory_together.clear,
}

SCREENS = GameScreens(
    FactoryView,
    tile,
    BusyFactory,
    "hint_lift",
    preview,
    crate,
    team_colors=True,
    lessons=LESSONS,
    lesson_pages=("standard", "party", "together"),
)
