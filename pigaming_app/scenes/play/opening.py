"""The opening of a match, and of each part of it after an interruption: countdown, captions of the drivers, rule card.

The rule card, name and one sentence of the rule set, is shown beside the robots during the first countdown.
"""

import math
import re
from collections.abc import Sequence

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.scenes.flow.match_words import sudden_death_key, tagline
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.play.countdown import CENTRE, Countdown, clear_of, signs
from pigaming_app.scenes.play.ending import PREWARM_MS
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, STEEL, THIN, GlowCanvas, cut_box, readable, text_width
from pigaming_app.ui.draw.frame_budget import PrewarmQueue, Steps, resumable
from pigaming_app.ui.draw.layers import fit_size, text, wrap, wrap_balanced
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.widgets.caption import MARGIN, Caption

LEAD_SECONDS = 0.8  # seconds before the first countdown, to look round
RESUME_STEP = 0.5  # seconds per number after an interruption
ROOM = 900  # px, maximum width of a line
PAD, LINE_PITCH, TITLE_PITCH = 36, 50, 58  # px
ARENA = pygame.Rect(LEFT, TOP, int(WIDTH), int(HEIGHT)).inflate(-24, -24)
SIGN = 226  # px, radius of a number of the countdown with its arcs
STEP = 30  # px between two candidate places
SENTENCE = re.compile(r"(?<=[.!]) ")


class Opening:
    """The countdown of a match, and what is shown and prepared meanwhile. `devices`: of each seat."""

    def __init__(self, context: Context, runner: MatchRunner, devices: Sequence[Device | None]) -> None:
        self.context, self.runner, self.devices = context, runner, devices
        self.match = runner.match
        self.countdown, self.at = Countdown(), CENTRE
        self.begin()
        self.signs = PrewarmQueue(signs(*(context.words(f"match.{name}") for name in ("go", "time", "finish"))))
        self.prewarmed = False
        self.card: tuple[Caption, tuple[int, int]] | None = None

    def begin(self) -> None:
        """Count down from three after a look round, or after the ceremony with which the view opens the match."""
        view, first = self.runner.view, self.match.state.tick == 0
        self.countdown.restart(1.0, max(LEAD_SECONDS, view.opening if first else 0.0))
        if first:
            view.open()

    def restart(self) -> None:
        """Count down from three once more: faster if the robots have already driven."""
        self.countdown.restart(1.0 if self.countdown.locked else RESUME_STEP)

    def update(self, seconds: float) -> bool:
        """Prepare pictures, and count down; true while robots may not drive."""
        self.signs.work(0.0)
        self.prewarmed = self.prewarmed or self.runner.prewarm(PREWARM_MS if self.countdown.locked else 2.0)
        if self.countdown.shown and (sound := self.countdown.update(seconds)):
            self.context.sounds.play(sound)
        if self.countdown.locked:
            self.context.controls.forget_taps()
            self.runner.wait(seconds)
        return self.countdown.locked

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the countdown, and at first what the match is about."""
        if not self.countdown.shown:
            return
        if self.match.game.timed and self.match.seconds < 1.0:
            self._draw_goal(screen)
        if self.countdown.locked:
            self.runner.draw_captions(screen, self.devices)
            self.at = clear_of(self.runner.robots())
            if self.match.state.tick == 0 and not self.runner.view.presenting:
                self._draw_rules(screen)
        self.countdown.draw(screen, self.context.words("match.go"), self.at)

    def _draw_rules(self, screen: pygame.Surface) -> None:
        """Show the rule card where it hides no robot."""
        if self.card is None:
            notice = self.runner.notice.box
            occupied = self.runner.occupied(self.devices) + ([notice] if notice else [])
            self.card = rule_card(self.context.words, self.match.setup, occupied, self.at)
        card, centre = self.card
        card.draw(screen, *centre)

    def _draw_goal(self, screen: pygame.Surface) -> None:
        """Show the number of laps in place of the stopped clock."""
        box = self.runner.view.clock
        screen.fill("black", box)
        lines = wrap(tagline(self.context.words, self.match.setup.game, self.match.setup.goal), LABEL, box.w, "head")
        for i, line in enumerate(lines):
            text(line, LABEL, FOCUS, "head", room=box.w).draw(screen, box.centerx, 80 + 58 * i - 29 * (len(lines) - 1))


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
    head, title_pitch, pitch = readable(BODY), readable(TITLE_PITCH), readable(LINE_PITCH)
    size = min(fit_size(line, head, readable(ROOM), "body") for line in lines)
    wide = 2 * PAD + round(max(text_width(title, head), *(text_width(line, size, "body") for line in lines)))
    high = 2 * PAD + title_pitch + pitch * (len(lines) - 1)
    ink = GlowCanvas(wide + 2 * MARGIN, high + 2 * MARGIN).set_transform(MARGIN, MARGIN)
    outline = cut_box(0, 0, wide, high)
    ink.solid(outline).line(outline, STEEL, THIN, True)
    ink.text(title, head, wide / 2, PAD, FOCUS, "head", "c")
    for i, line in enumerate(lines):
        ink.text(line, size, wide / 2, PAD + title_pitch + pitch * i, ICE, "body", "c")
    yield
    image = yield from ink.sprite_steps(0.6)
    return Caption(image, wide, high)


def in_lines(sentence: str, count: int) -> list[str]:
    """A text on at most `count` lines: on two it is broken after a sentence if there are several."""
    parts = SENTENCE.split(sentence) if count == 2 else []
    halves = [[" ".join(parts[:i]), " ".join(parts[i:])] for i in range(1, len(parts))]
    return min(halves, key=lambda half: abs(len(half[0]) - len(half[1])), default=wrap_balanced(sentence, count))


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
