"""Preview of an arena with the players at their start positions.

The renderer depends on the type of the arena's `plan`: see PREVIEWS.
"""

import math
from collections.abc import Callable

import pygame

from pigaming_app.games.factory.layout import Floor
from pigaming_app.games.race.start import TrackPlan
from pigaming_app.scenes.views.factory.background import draw_floor
from pigaming_app.scenes.views.race.background import GLOW, earth
from pigaming_app.scenes.views.race.lines import draw_line, frame
from pigaming_app.scenes.views.race.track import draw_track
from pigaming_app.scenes.views.sprites.factory import TEAMS
from pigaming_app.scenes.views.things.on_mat import black_out, draw_all
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HEIGHT, SOLID, WIDTH
from pigaming_app.ui.draw import (
    ADD,
    BLACK,
    HAIR,
    ICE,
    MIST,
    PLAYERS,
    STEEL,
    THIN,
    WALL,
    GlowCanvas,
    cut_box,
    dim,
    shape_points,
)
from pigaming_app.ui.draw.frame_budget import Steps

MARGIN = 8  # px around the frame for its glow


def preview(arena: Arena, w: int, h: int, allies: bool = False) -> Steps[pygame.Surface]:
    """Preview as additive light, scaled to fit w x h px and centred. `allies`: all robots are in one team."""
    if allies:
        return (yield from floor(arena, w, h, allies))
    return (yield from PREVIEWS.get(type(arena.plan), walls)(arena, w, h))


def walls(arena: Arena, w: int, h: int) -> Steps[pygame.Surface]:
    """Preview of an arena with walls and start positions."""
    left, top, k = fitted(w, h)
    ink = GlowCanvas(w, h, 3)
    for column in range(200, int(WIDTH), 200):
        for row in range(150, int(HEIGHT), 200):
            ink.disc(left + k * column, top + k * row, 1.5, dim(STEEL, 0.6))
    yield
    ink.line(cut_box(left, top, k * WIDTH, k * HEIGHT, 28 * k + 4), MIST, THIN, True)
    for wall in arena.walls:
        ends = [(left + k * wall.ax, top + k * wall.ay), (left + k * wall.bx, top + k * wall.by)]
        thick = max(7.0, 2 * wall.half * k)
        ink.line(ends, WALL, thick).line(ends, dim(WALL, 0.25 if wall.health != SOLID else 0.8), thick - 4)
    draw_all(ink.set_transform(left, top, 0.0, k), "pitanks", arena.things)
    ink.set_transform(0.0, 0.0)
    for player, start in enumerate(arena.starts):
        r, c, s = max(9.0, 44 * k), math.cos(start.heading), math.sin(start.heading)
        x, y = left + k * start.x, top + k * start.y
        ink.fill([(x + py, y - px) for px, py in shape_points(player, r)], PLAYERS[player])
        ink.line([(x + 1.5 * r * c, y + 1.5 * r * s), (x + 2.3 * r * c, y + 2.3 * r * s)], PLAYERS[player], HAIR + 1)
    yield
    return (yield from ink.lit_steps(0.6))


def track(arena: Arena, w: int, h: int) -> Steps[pygame.Surface]:
    """Preview of a track: mud, road, direction, and the lines, which no seat has been dealt yet."""
    left, top, k = fitted(w, h)
    below = pygame.transform.smoothscale(earth(arena.plan), (round(k * WIDTH), round(k * HEIGHT)))
    yield
    glow, crisp = (
        GlowCanvas(w, h, 3).set_transform(left, top, 0.0, k),
        GlowCanvas(w, h, 3).set_transform(left, top, 0.0, k),
    )
    yield from draw_track(glow, crisp, arena.plan)
    for along in arena.plan.lines:
        draw_line(glow, crisp, frame(arena.plan.course, along), ICE)
    black_out(crisp, arena.things)
    draw_all(glow, "race", arena.things)
    yield
    light = yield from glow.lit_steps(GLOW)
    out = pygame.Surface((w, h))
    out.blit(below, (round(left), round(top)))
    for thing in arena.things:
        pygame.draw.polygon(out, BLACK, [(left + k * x, top + k * y) for x, y in thing.outline])
    out.blit(light, (0, 0), special_flags=ADD)
    yield from crisp.downscale_onto(out)
    return out


def floor(arena: Arena, w: int, h: int, allies: bool = False) -> Steps[pygame.Surface]:
    """Preview of a factory floor: warehouses, machines, the aisle, start positions by team."""
    left, top, k = fitted(w, h)
    glow, crisp = (
        GlowCanvas(w, h, 3).set_transform(left, top, 0.0, k),
        GlowCanvas(w, h, 3).set_transform(left, top, 0.0, k),
    )
    yield from draw_floor((glow, crisp), arena.plan, allies)
    glow.line(cut_box(0, 0, WIDTH, HEIGHT, 28), MIST, THIN / k, True)
    black_out(crisp, arena.things)
    draw_all(glow, "factory", arena.things)
    for i, start in enumerate(arena.starts):
        glow.ring(start.x, start.y, 36, TEAMS[0 if allies else i % 2], 8)
    out = yield from glow.lit_steps(GLOW)
    yield from crisp.downscale_onto(out)
    return out


def fitted(w: int, h: int) -> tuple[float, float, float]:
    """Position and scale of an arena centred in w x h px."""
    k = min((w - 2 * MARGIN) / WIDTH, (h - 2 * MARGIN) / HEIGHT)
    return (w - k * WIDTH) / 2, (h - k * HEIGHT) / 2, k


# by type of an arena's plan
PREVIEWS: dict[type, Callable[[Arena, int, int], Steps[pygame.Surface]]] = {TrackPlan: track, Floor: floor}
