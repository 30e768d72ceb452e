"""A small picture of an arena: its walls, and the shapes of the players where they begin."""

import math

import pygame

from pigaming_app.scenes.ink import HAIR, MIST, PLAYERS, STEEL, THIN, WALL, Ink, cut, dim, shape_points
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HEIGHT, SOLID, WIDTH

MARGIN = 8  # px round the frame, for its glow


def preview(arena: Arena, w: int, h: int) -> pygame.Surface:
    """The arena as light, as large as fits into w x h px and centred there; add it to a picture."""
    k = min((w - 2 * MARGIN) / WIDTH, (h - 2 * MARGIN) / HEIGHT)
    left, top = (w - k * WIDTH) / 2, (h - k * HEIGHT) / 2
    ink = Ink(w, h, 3)
    for column in range(200, int(WIDTH), 200):
        for row in range(150, int(HEIGHT), 200):
            ink.disc(left + k * column, top + k * row, 1.5, dim(STEEL, 0.6))
    ink.line(cut(left, top, k * WIDTH, k * HEIGHT, 28 * k + 4), MIST, THIN, True)
    for wall in arena.walls:
        ends = [(left + k * wall.ax, top + k * wall.ay), (left + k * wall.bx, top + k * wall.by)]
        thick = max(7.0, 2 * wall.half * k)
        ink.line(ends, WALL, thick).line(ends, dim(WALL, 0.25 if wall.health != SOLID else 0.8), thick - 4)
    for player, start in enumerate(arena.starts):
        r, c, s = max(9.0, 44 * k), math.cos(start.heading), math.sin(start.heading)
        x, y = left + k * start.x, top + k * start.y
        ink.fill([(x + py, y - px) for px, py in shape_points(player, r)], PLAYERS[player])
        ink.line([(x + 1.5 * r * c, y + 1.5 * r * s), (x + 2.3 * r * c, y + 2.3 * r * s)], PLAYERS[player], HAIR + 1)
    return ink.lit(0.6)
