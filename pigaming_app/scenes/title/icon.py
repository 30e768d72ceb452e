"""The program's icon: the Pi of its name, with a robot as the dot of the i."""

import pygame

from pigaming_app.scenes.title.logo import LETTERS
from pigaming_app.ui.draw import FOCUS, ICE, GlowCanvas
from pigaming_app.ui.draw.theme import cut_box

SIZE = 1024  # px
GROUND = (14, 18, 30)
UNIT = 92  # px, a sixth of the height of the letters
LEFT, TOP = 244, 236  # px, upper left of the P
MARGIN, CORNER = 36, 150  # px


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
