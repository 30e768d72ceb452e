"""How to build an arena, in three pictures."""

import math

import pygame

from pigaming_app.scenes.mat.things.outlines import boxes
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LINE, STEEL, THIN, GlowCanvas, cut_box
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LitImage, text, wrap_balanced
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words

STEPS = ("put", "light", "scan")
PITCH, PICTURE_Y, TEXT_Y, LINE_PITCH = 500, 470, 680, 54  # px
W, H = 360, 240  # px, of a picture
ROOM = 440  # px, for a text


def draw_steps(screen: pygame.Surface, words: Words) -> None:
    """Draw the pictures side by side, each with its text."""
    for i, step in enumerate(STEPS):
        x = 960 + (i - 1) * PITCH
        picture(step).draw(screen, x, PICTURE_Y)
        for k, line in enumerate(wrap_balanced(words(f"things.step_{step}"), 2)):
            text(line, BODY, ICE, "body", "c", ROOM).draw(screen, x, TEXT_Y + LINE_PITCH * k)


@cached
@resumable
def picture(step: str) -> Steps[LitImage]:
    """A picture centred on (0, 0): things on the mat; a lamp crossed out; stripes of light."""
    ink = GlowCanvas(W + 80, H + 80).set_transform(W / 2 + 40, H / 2 + 40)
    ink.line(cut_box(-W / 2, -H / 2, W, H, 16), STEEL, THIN, True)
    if step == "light":
        ink.ring(0, -16, 46, FOCUS, LINE).line([(-18, 40), (18, 40)], FOCUS, LINE).line(
            [(-12, 56), (12, 56)], FOCUS, LINE
        )
        for turn in range(5):
            c, s = math.cos(math.pi * (1.0 + turn / 4)), math.sin(math.pi * (1.0 + turn / 4))
            ink.line([(66 * c, -16 + 66 * s), (86 * c, -16 + 86 * s)], FOCUS, THIN)
        ink.line([(-84, 84), (84, -96)], ICE, LINE)
    if step == "scan":
        for x in range(-150, 160, 50):
            ink.fill([(x - 10, -H / 2 + 8), (x + 10, -H / 2 + 8), (x + 10, H / 2 - 8), (x - 10, H / 2 - 8)], STEEL)
    if step != "light":
        boxes(ink, 0, 4, ICE if step == "scan" else FOCUS)
    yield
    return LitImage((yield from ink.lit_steps(0.8)), (-W // 2 - 40, -H // 2 - 40))
