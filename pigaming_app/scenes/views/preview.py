"""Preview of an arena with walls and starts, as additive light."""

import math
from typing import Any

import pygame

from pigaming_app.scenes.views.sprites.floors import FLOORS, pattern_of
from pigaming_app.scenes.views.things.on_mat import black_out, draw_all
from pigaming_app.scenes.views.things.styles import NEON
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HEIGHT, SOLID, WIDTH
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps

MARGIN = 8  # px around the frame for its glow
BADGE = 26.0  # px of the arena, radius


def walls(arena: Arena, w: int, h: int, allies: bool) -> Steps[pygame.Surface]:
    """Preview of an arena with walls and starts, as no seat has been dealt them."""
    left, top, k = fitted(w, h)
    floor, ink = kit.GlowCanvas(w, h, 3), kit.GlowCanvas(w, h, 3)
    FLOORS[pattern_of(arena)](floor.set_transform(left, top, 0.0, k))
    black_out(floor, arena.things)
    yield
    ink.line(kit.cut_box(left, top, k * WIDTH, k * HEIGHT, 28 * k + 4), kit.MIST, kit.THIN, True)
    for wall in arena.walls:
        ends = [(left + k * wall.ax, top + k * wall.ay), (left + k * wall.bx, top + k * wall.by)]
        thick = max(7.0, 2 * wall.half * k)
        ink.line(ends, kit.WALL, thick).line(ends, kit.dim(kit.WALL, 0.25 if wall.health != SOLID else 0.8), thick - 4)
    draw_all(ink.set_transform(left, top, 0.0, k), NEON, arena.things)
    ink.set_transform(0.0, 0.0)
    for start in arena.starts:
        r, c, s = max(9.0, 44 * k), math.cos(start.heading), math.sin(start.heading)
        x, y = left + k * start.x, top + k * start.y
        ink.ring(x, y, r, kit.MIST, kit.THIN)
        ink.line([(x + 1.5 * r * c, y + 1.5 * r * s), (x + 2.3 * r * c, y + 2.3 * r * s)], kit.MIST, kit.HAIR + 1)
    yield
    out = yield from ink.lit_steps(0.6)
    out.blit((yield from floor.downscale_steps()), (0, 0), special_flags=pygame.BLEND_RGB_MAX)
    return out


def floor(ink: kit.GlowCanvas, arena: Arena) -> None:
    """Walls of an arena, px of it, without glow; the inside of those that bullets destroy is dim."""
    for wall in arena.walls:
        ends = [(wall.ax, wall.ay), (wall.bx, wall.by)]
        ink.line(ends, kit.WALL, 2 * wall.half)
        if wall.health != SOLID:
            ink.line(ends, kit.dim(kit.WALL, 0.3), 2 * wall.half - 8)


def robots(ink: kit.GlowCanvas, arena: Arena, state: Any) -> None:
    """The robots of a match on the starts that were dealt to their seats."""
    for seat, robot in enumerate(state.robots):
        if robot.present:
            kit.badge(ink, seat, robot.x, robot.y, BADGE)


def fitted(w: int, h: int) -> tuple[float, float, float]:
    """Position and scale of an arena centred in w x h px."""
    k = min((w - 2 * MARGIN) / WIDTH, (h - 2 * MARGIN) / HEIGHT)
    return (w - k * WIDTH) / 2, (h - k * HEIGHT) / 2, k
