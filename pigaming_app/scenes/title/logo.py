"""Drawing of the title: the name in neon tubes, and the paths of the four robots that underline it."""

import pygame

from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw import FOCUS, ICE, GlowCanvas
from pigaming_app.ui.draw.theme import cut_box

LETTERS: dict[str, tuple[float, list[list[kit.Point]]]] = {  # width, strokes on a grid of 4 x 6
    "P": (4, [[(0, 6), (0, 0), (3, 0), (4, 1), (4, 2.6), (3, 3.6), (0, 3.6)]]),
    "i": (0, [[(0, 2.1), (0, 6)]]),
    "G": (4, [[(4, 1), (3, 0), (1, 0), (0, 1), (0, 5), (1, 6), (3, 6), (4, 5), (4, 3.2), (2.2, 3.2)]]),
    "A": (4, [[(0, 6), (0, 1), (1, 0), (3, 0), (4, 1), (4, 6)], [(0, 3.7), (4, 3.7)]]),
    "M": (5, [[(0, 6), (0, 0), (2.5, 2.7), (5, 0), (5, 6)]]),
    "I": (0, [[(0, 0), (0, 6)]]),
    "N": (4, [[(0, 6), (0, 0), (4, 6), (4, 0)]]),
}
ENDS = ((1716, 100), (1640, 172), (1764, 244), (1590, 316))  # of the four trails, px
SIZE = 1024  # px
GROUND = (14, 18, 30)
UNIT = 92  # px, a sixth of the height of the letters
LEFT, TOP = 244, 236  # px, upper left of the P
MARGIN, CORNER = 36, 150  # px


def logo(ink: kit.GlowCanvas, x: float, y: float, u: float) -> kit.GlowCanvas:
    """PiGAMING in neon tubes, its i without a dot. (x, y): upper left of the P; u: a sixth of the height, px."""
    strokes: list[tuple[list[kit.Point], kit.Color]] = []
    at = x
    for i, letter in enumerate("PiGAMING"):
        w, lines = LETTERS[letter]
        strokes += [([(at + a * u, y + b * u) for a, b in line], kit.FOCUS if i < 2 else kit.ICE) for line in lines]
        at += (w + 1.9) * u
    for line, color in strokes:
        ink.line(line, color, u)
    for line, _ in strokes:
        ink.void(line, u * 0.56, 0.4)
    for line, color in strokes:
        ink.line(line, color, u * (0.22 if color == kit.FOCUS else 0.1))
    return ink


def trail_path(player: int, y: float = 312) -> list[kit.Point]:
    """The path of a robot that draws its part of the underline: in from the left, up, off to the right; px."""
    (x1, y1), y0, x0 = ENDS[player], y + 16 * player, 1388 + 7 * player
    return [(-80, y0), (x0, y0), (x0 + y0 - y1, y1), (x1, y1), (2000, y1)]


def dot_of(x: float, y: float, u: float) -> kit.Point:
    """Position of the robot that dots the i."""
    return x + (LETTERS["P"][0] + 1.9) * u, y + 0.3 * u


def icon(size: int) -> pygame.Surface:
    """The icon at `size` x `size` px, transparent outside its corners."""
    ink = GlowCanvas(SIZE, SIZE, 1)
    strokes = [[(LEFT + a * UNIT, TOP + b * UNIT) for a, b in line] for line in LETTERS["P"][1]]
    i_left = LEFT + 5.6 * UNIT
    strokes += [[(i_left + a * UNIT, TOP + b * UNIT) for a, b in line] for line in LETTERS["i"][1]]
    for stroke in strokes:
        ink.line(stroke, FOCUS, 0.95 * UNIT)
    ink.disc(i_left, TOP + 0.25 * UNIT, 0.72 * UNIT, ICE)
    edge = SIZE - 2 * MARGIN
    shape = cut_box(MARGIN, MARGIN, edge, edge, CORNER)
    mask = pygame.Surface((SIZE, SIZE), pygame.SRCALPHA)
    pygame.draw.polygon(mask, (255, 255, 255, 255), shape)
    out = pygame.Surface((SIZE, SIZE), pygame.SRCALPHA)
    out.fill((*GROUND, 255))
    out.blit(ink.lit(0.5), (0, 0), special_flags=pygame.BLEND_RGB_ADD)
    out.blit(mask, (0, 0), special_flags=pygame.BLEND_RGBA_MULT)
    return pygame.transform.smoothscale(out, (size, size))
