"""Tile of a game for the title screen and the game selection: picture, name, tagline."""

import math

import pygame

from pigaming_app.scenes.views.sprites.robot import robot
from pigaming_app.scenes.views.sprites.wall import draw_wall
from pigaming_app.ui.draw import (
    ALARM,
    BLUE,
    BODY,
    FOCUS,
    GREEN,
    HAIR,
    ICE,
    LABEL,
    LINE,
    MIST,
    ORANGE,
    PLAYERS,
    STEEL,
    THIN,
    WHITE,
    Color,
    GlowCanvas,
    Point,
    cut_box,
    dim,
    panel,
)
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import MARGIN, Layer, LitImage, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size

TILE_Y, TILE_H = 416, 416


def tile_rect(i: int) -> pygame.Rect:
    """Rectangle of the i-th tile from the left."""
    x, w = span(4 * i, 4)
    return pygame.Rect(x, TILE_Y, w, TILE_H)


@cached
@resumable
def tile(game: str, name: str, line: str, hot: bool) -> Steps[LitImage]:
    """Picture and name of a game; top left at (0, 0)."""
    w = span(0, 4)[1]
    layer = Layer(0, 0, w, TILE_H)
    panel(layer.glow, 0, 0, w, TILE_H, dim(FOCUS, 0.55) if hot else STEEL)
    layer.glow.line([(24, 284), (w - 24, 284)], STEEL, HAIR)
    color = FOCUS if hot else ICE
    layer.canvas.text(name, fit_size(name, LABEL, w - 64), 32, 326, color)
    layer.canvas.body(line, 32, 380, ICE if hot else MIST, "l", fit_size(line, BODY, w - 64, "body"))
    drawn = picture(game)
    lit = yield from layer.render_steps()
    drawn.draw(lit.image, -lit.at[0], -lit.at[1])
    return lit


@cached
@resumable
def picture(game: str) -> Steps[LitImage]:
    """The picture of a game, 560 x 284 px; top left at (0, 0)."""
    layer = Layer(MARGIN, MARGIN, 560, 284)  # no offset: robots are placed directly on the sheet
    vignette(game, layer.glow, MARGIN, MARGIN)
    yield
    lit = yield from layer.render_steps()
    return LitImage(lit.image, (-MARGIN, -MARGIN))


def vignette(game: str, ink: GlowCanvas, x: float, y: float) -> GlowCanvas:
    """Draw the picture of a game ("pitanks", "factory" or "race") in the upper 284 px of a 560 x 416 px tile at (x,
    y).
    """
    {"pitanks": _tanks, "factory": _factory, "race": _race}[game](ink, x, y + 4)
    return ink


def _shot(ink: GlowCanvas, player: int, x: float, y: float, angle: float) -> None:
    ink.set_transform(x, y, angle)
    for i in range(6):
        ink.line([(-44 + 6 * i, 0), (0, 0)], dim(PLAYERS[player], 0.15 + 0.15 * i), 3 + i)
    ink.disc(1, 0, 5, WHITE).set_transform(0, 0)


def _tanks(ink: GlowCanvas, x: float, y: float) -> None:
    draw_wall(ink.set_transform(x + 290, y + 128, 1.2), 170, 30, 3, 12)
    robot(ink, 0, x + 118, y + 184, -0.42, 1.15)
    robot(ink, 1, x + 454, y + 84, 2.75, 1.15)
    _shot(ink, 0, x + 234, y + 132, -0.42)
    _shot(ink, 1, x + 346, y + 129, 2.75)
    for i in range(9):  # a recent hit
        c, s = math.cos(-2.5 + i * 0.45), math.sin(-2.5 + i * 0.45)
        ink.line([(x + 454 + 58 * c, y + 84 + 58 * s), (x + 454 + 70 * c, y + 84 + 70 * s)], ORANGE, THIN)
    ink.text("+1", LABEL, x + 118, y + 100, BLUE, "hero", "c")


def _factory(ink: GlowCanvas, x: float, y: float) -> None:
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


def _race(ink: GlowCanvas, x: float, y: float) -> None:
    ink.line(_lane(x, y, 114), MIST, LINE).line(_lane(x, y, 20), MIST, LINE)
    ink.dashes(_lane(x, y, 67), dim(MIST, 0.45), 3, 20, 20, False)
    for i, j in ((i, j) for i in range(2) for j in range(6) if (i + j) % 2):
        left, top = x + 150 + 15 * i, y + 24 + 15 * j
        ink.fill([(left, top), (left + 15, top), (left + 15, top + 15), (left, top + 15)], ICE)
    for player, cx, cy, a in ((3, 446, 196, 5.8), (0, 286, 182, 0.0), (1, 150, 214, 0.0)):
        for side in (-26, 26):
            for i in range(4):
                streak = [(-108 + 18 * i, side), (-46, side)]
                ink.set_transform(x + cx, y + cy, a).line(streak, dim(PLAYERS[player], 0.16 * (i + 1)), THIN)
        robot(ink, player, x + cx, y + cy, a, 0.85)


def _lane(x: float, y: float, r: float) -> list[Point]:
    """Half a track: along the top, round a bend, back along the bottom."""
    bend = [(x + 396 + r * math.sin(math.pi * i / 40), y + 136 - r * math.cos(math.pi * i / 40)) for i in range(41)]
    return [(x + 28, y + 136 - r), *bend, (x + 28, y + 136 + r)]
