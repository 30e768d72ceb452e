"""The rule card: name and one sentence of the rule set, shown beside the robots during the first countdown."""

import math
import re
from collections.abc import Sequence

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.scenes.flow.match_words import sudden_death_key
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
SIGN = 226  # px, radius of a number of the countdown with its arcs
STEP = 30  # px between two candidate places
SENTENCE = re.compile(r"(?<=[.!]) ")


def rule_card(
    words: Words, setup: Setup, occupied: Sequence[pygame.Rect], sign: tuple[int, int]
) -> tuple[Caption, tuple[int, int]]:
    """The card of a match, wide or narrow, and its centre on the canvas, where it covers least: see `free_place`."""
    title, sentence = f"setup.{setup.game}_{setup.variant}", f"rules.{setup.game}_{setup.variant}"
    if setup.sudden_death:
        title, sentence = "events.sudden_death", sudden_death_key(setup.game)
    cards = [card(words(title), words(sentence), count) for count in (2, 3)]
    places = [free_place((sheet.width, sheet.height), occupied, sign) for sheet in cards]
    best = min(range(len(cards)), key=lambda i: places[i][0])
    return cards[best], places[best][1]


@cached
@resumable
def card(title: str, sentence: str, count: int) -> Steps[Caption]:
    """A plate with a title and a sentence on at most `count` lines."""
    lines = in_lines(sentence, count)
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


def in_lines(text: str, count: int) -> list[str]:
    """A text on at most `count` lines: on two it is broken after a sentence if there are several."""
    parts = SENTENCE.split(text) if count == 2 else []
    halves = [[" ".join(parts[:i]), " ".join(parts[i:])] for i in range(1, len(parts))]
    return min(halves, key=lambda half: abs(len(half[0]) - len(half[1])), default=wrap_balanced(text, count))


def free_place(
    size: tuple[int, int], occupied: Sequence[pygame.Rect], sign: tuple[int, int]
) -> tuple[int, tuple[int, int]]:
    """The area that a card covers, px², and its centre on the canvas, at the place where it covers least of the
    `occupied` boxes and of the countdown `sign`; among equal places the one nearest to the sign.
    """
    plate = pygame.Rect((0, 0), size)
    room = ARENA.inflate(-size[0], -size[1])

    def cost(at: tuple[int, int]) -> tuple[int, int]:
        plate.center = at
        covered = sum(_area(plate.clip(box)) for box in occupied) + 1000 * max(0, round(SIGN - gap(plate, sign)))
        return covered, 9 * (at[0] - sign[0]) ** 2 + (at[1] - sign[1]) ** 2  # rather above or below than beside

    across, down = range(room.left, room.right + 1, STEP), range(room.top, room.bottom + 1, STEP)
    places = [(x, y) for x in (*across, room.right, sign[0]) for y in (*down, room.bottom)]
    best = min(places, key=cost)
    return cost(best)[0], best


def gap(box: pygame.Rect, at: tuple[int, int]) -> float:
    """Distance of a box from a point outside it, px; 0 inside."""
    dx = max(box.left - at[0], 0, at[0] - box.right)
    dy = max(box.top - at[1], 0, at[1] - box.bottom)
    return math.hypot(dx, dy)


def _area(box: pygame.Rect) -> int:
    return box.w * box.h
