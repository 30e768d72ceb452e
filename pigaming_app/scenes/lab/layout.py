"""Layout of the Lab on the canvas, in px, and the colours specific to it."""

import pygame

from pigaming_app.scenes.brain.rose import BAD, GOOD
from pigaming_app.sim.world import HEIGHT, WIDTH

LEFT, RIGHT, MIDDLE = 96, 1824, 968  # MIDDLE: left edge of the right column
TITLE_Y, PROMPTS_Y = 100, 992
MATCH = pygame.Rect(LEFT, 160, 848, 484)
KNOBS = pygame.Rect(LEFT, 664, 848, 282)
CURVE = pygame.Rect(MIDDLE, 160, RIGHT - MIDDLE, 286)
PLAN = pygame.Rect(MIDDLE, 466, RIGHT - MIDDLE, 480)
SPEED = pygame.Rect(MIDDLE, 62, 416, 76)
PLAY = pygame.Rect(MIDDLE + 440, 62, RIGHT - MIDDLE - 440, 76)

SCALE = 0.52  # of the arena
ARENA = pygame.Rect(MATCH.centerx - round(SCALE * WIDTH) // 2, MATCH.centery - round(SCALE * HEIGHT) // 2,
                    round(SCALE * WIDTH), round(SCALE * HEIGHT))  # fmt: skip

KNOB_NAMES = ("hit", "miss", "behind", "still")
KNOB_Y = KNOBS.top + 129

ROSE = (PLAN.left + 222, PLAN.top + 208)
WORDS_X = PLAN.left + 456
BAR_Y = PLAN.bottom - 40

PLOT = pygame.Rect(CURVE.left + 36, CURVE.top + 84, 560, 172)
NOTHING = (34, 42, 54)  # unlit elements

__all__ = ["ARENA", "BAD", "BAR_Y", "CURVE", "GOOD", "KNOBS", "KNOB_NAMES", "KNOB_Y", "LEFT", "MATCH", "MIDDLE",
           "NOTHING", "PLAN", "PLAY", "PLOT", "PROMPTS_Y", "RIGHT", "ROSE", "SCALE", "SPEED", "TITLE_Y",
           "WORDS_X"]  # fmt: skip


def knob_rect(i: int) -> pygame.Rect:
    """Click and focus area of the i-th knob; its label stands below."""
    w = KNOBS.w // len(KNOB_NAMES)
    return pygame.Rect(KNOBS.left + w * i + w // 2 - 72, KNOB_Y - 64, 144, 120)
