"""The rule card: name and one sentence of the rule set, shown beside the robots during the first countdown."""

import re
from collections.abc import Sequence
from itertools import product

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import BODY, FOCUS, ICE, STEEL, THIN, GlowCanvas, cut_box, text_width
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size, wrap_balanced
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.widgets.caption import MARGIN, Caption

ROOM = 900  # px, maximum width of a line
PAD, LINE_PITCH, TITLE_PITCH = 36, 50, 58  # px
ARENA = pygame.Rect(LEFT, TOP, int(WIDTH), int(HEIGHT)).inflate(-24, -24)
SIGN = pygame.Rect(0, 0, 490, 490)  # a number of the countdown with its arcs
STEP = 40  # px between two candidate places
NEAR, FAR = 60, 150  # px from a robot to the end of its box, which includes its caption on the side with more room
SENTENCE = re.compile(r"(?<=[.!]) ")
CAPTION = 210  # px, half of a caption's usual width


def rule_card(words: Words, setup: Setup) -> Caption:
    """The card of a match."""
    key = f"{setup.game}_{setup.variant}"
    return card(words(f"setup.{key}"), words(f"rules.{key}"))


@cached
@resumable
def card(title: str, sentence: str) -> Steps[Caption]:
    """A plate with a title and a sentence on at most two lines."""
    lines = in_two(sentence)
    size = min(fit_size(line, BODY, ROOM, "body") for line in lines)
    wide = 2 * PAD + round(max(text_width(title, BODY), *(text_width(line, size, "body") for line in lines)))
    high = 2 * PAD + TITLE_PITCH + LINE_PITCH * (len(lines) - 1)
    ink = GlowCanvas(wide + 2 * MARGIN, high + 2 * MARGIN).set_transform(MARGIN, MARGIN)
    outline = cut_box(0, 0, wide, high)
    ink.solid(outline).line(outline, STEEL, THIN, True)
    ink.text(title, BODY, wide / 2, PAD, FOCUS, "head", "c")
    for i, line in enumerate(lines):
        ink.text(line, size, wide / 2, PAD + TITLE_PITCH + LINE_PITCH * i, ICE, "body", "c")
    yield
    image = yield from ink.sprite_steps(0.6)
    return Caption(image, wide, high)


def in_two(text: str) -> list[str]:
    """A text on at most two lines: broken after a sentence if there are several, as evenly as possible."""
    parts = SENTENCE.split(text)
    halves = [(" ".join(parts[:i]), " ".join(parts[i:])) for i in range(1, len(parts))]
    if not halves:
        return wrap_balanced(text, 2)
    first, second = min(halves, key=lambda half: abs(len(half[0]) - len(half[1])))
    return [first, second]


def free_place(size: tuple[int, int], robots: Sequence[tuple[float, float]], sign: tuple[int, int]) -> tuple[int, int]:
    """The centre, on the canvas, of a card that covers as little as possible of the robots, their captions and the
    countdown `sign`; among equal places the one nearest to the sign.
    """
    boxes = [_box(x, y) for x, y in robots]
    number = SIGN.copy()
    number.center = sign
    plate = pygame.Rect((0, 0), size)
    room = ARENA.inflate(-size[0], -size[1])

    def cost(at: tuple[int, int]) -> tuple[int, int]:
        plate.center = at
        covered = sum(_area(plate.clip(box)) for box in boxes) + _area(plate.clip(number))
        return covered, 9 * (at[0] - sign[0]) ** 2 + (at[1] - sign[1]) ** 2  # rather above or below than beside

    across, down = range(room.left, room.right + 1, STEP), range(room.top, room.bottom + 1, STEP)
    return min(product((*across, room.right, sign[0]), (*down, room.bottom)), key=cost)


def _box(x: float, y: float) -> pygame.Rect:
    """The area of a robot and its caption."""
    above, below = (NEAR, FAR) if y < TOP + HEIGHT / 2 else (FAR, NEAR)
    return pygame.Rect(round(x) - CAPTION, round(y) - above, 2 * CAPTION, above + below)


def _area(box: pygame.Rect) -> int:
    return box.w * box.h
