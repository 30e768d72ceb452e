"""Layout of the Lab on the canvas, in px, and the colours specific to it."""

import pygame

from pigaming_app.ai.reward_quantities import WEIGHTED
from pigaming_app.scenes.brain.rose import BAD, GOOD
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import ORANGE

LEFT, RIGHT, MIDDLE = 96, 1824, 968  # MIDDLE: left edge of the right column
TITLE_Y, PROMPTS_Y = 100, 992
MATCH = pygame.Rect(LEFT, 160, 848, 424)
KNOBS = pygame.Rect(LEFT, 604, 848, 342)
CURVE = pygame.Rect(MIDDLE, 160, RIGHT - MIDDLE, 286)
PLAN = pygame.Rect(MIDDLE, 466, RIGHT - MIDDLE, 480)
SPEED = pygame.Rect(MIDDLE, 62, 416, 76)
PLAY = pygame.Rect(MIDDLE + 440, 62, RIGHT - MIDDLE - 440, 76)

SCALE = 0.455  # of the arena
ARENA = pygame.Rect(MATCH.centerx - round(SCALE * WIDTH) // 2, MATCH.centery - round(SCALE * HEIGHT) // 2,
                    round(SCALE * WIDTH), round(SCALE * HEIGHT))  # fmt: skip

KNOB_NAMES = WEIGHTED
KNOB_Y = KNOBS.bottom - 153
SIDES = pygame.Rect(KNOBS.right - 28 - 144, KNOBS.top + 8, 144, 46)  # switch between the robots A and B
LINE = pygame.Rect(KNOBS.left + 28, KNOBS.top + 62, KNOBS.w - 56, 50)  # the reward as code
SIDE_LETTERS = "AB"
SIDE_COLORS = (GOOD, ORANGE)  # of the curves of A and B

ROSE = (PLAN.left + 222, PLAN.top + 208)
WORDS_X = PLAN.left + 456
BAR_Y = PLAN.bottom - 40

PLOT = pygame.Rect(CURVE.left + 36, CURVE.top + 84, 560, 172)
NOTHING = (34, 42, 54)  # unlit elements

__all__ = ["ARENA", "BAD", "BAR_Y", "CURVE", "GOOD", "KNOBS", "KNOB_NAMES", "KNOB_Y", "LEFT", "LINE", "MATCH", "MIDDLE",
           "NOTHING", "PLAN", "PLAY", "PLOT", "PROMPTS_Y", "RIGHT", "ROSE", "SCALE", "SIDES", "SIDE_COLORS",
           "SIDE_LETTERS", "SPEED", "TITLE_Y", "WORDS_X"]  # fmt: skip


def knob_rect(i: int) -> pygame.Rect:
    """Click and focus area of the i-th knob; its label stands below."""
    w = KNOBS.w // len(KNOB_NAMES)
    return pygame.Rect(KNOBS.left + w * i + w // 2 - 72, KNOB_Y - 64, 144, 120)
