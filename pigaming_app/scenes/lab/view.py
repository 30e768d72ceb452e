"""Rendering of the Lab page: a static background painted once, with dynamic widgets on top."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import pygame

from pigaming_app.scenes.brain.rose import LEVELS, PETALS, draw_petals, draw_signs, tone
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.lab.arena_view import ArenaView
from pigaming_app.scenes.lab.knob import dial
from pigaming_app.scenes.lab.layout import (
    ARENA,
    BAR_Y,
    CURVE,
    GOOD,
    KNOB_NAMES,
    KNOB_Y,
    KNOBS,
    LEFT,
    MATCH,
    PLAN,
    PLAY,
    PLOT,
    ROSE,
    SPEED,
    TITLE_Y,
    WORDS_X,
    knob_rect,
)
from pigaming_app.scenes.lab.learning_curve import LearningCurve, Measure
from pigaming_app.scenes.lab.network.kind_switch import TABLE, kind_rect, kind_switch
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.ui.draw import (
    BLUE,
    BODY,
    FOCUS,
    GREEN,
    ICE,
    MIST,
    STEEL,
    THIN,
    TITLE,
    WALL,
    WHITE,
    Color,
    GlowCanvas,
    LayeredCanvas,
    Points,
    cut_box,
    dim,
    icon,
    mix,
    panel,
    text_width,
)
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, backdrop
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size, wrap_balanced
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.widgets.labels import black_out, blit_sprite

SPEEDS = ("1×", "10×", "max")
SPEED_SIGNS = ("play", "faster", "fastest")
WARM = 1.5  # ms per frame for prewarming
STEPS = 2  # petals changed per frame
UP = round(HEADINGS * 3 / 4)


@dataclass
class LabState:
    """State shown on the page."""

    matches: int = 0
    measures: Sequence[Measure] = ()
    levels: list[int] = field(default_factory=lambda: [0] * PETALS)  # petal length of each direction
    signs: Sequence[str] = ("unknown",) * PETALS
    knowing: float = 0.0  # 0: only explores, 1: only exploits
    values: Mapping[str, int] = field(default_factory=dict)  # knob values
    kind: str = TABLE
    networks: bool = True  # networks can learn here, perhaps after a fetch
    speed: int = 0  # index into SPEEDS
    focus: str = ""
    held: str = ""  # knob being adjusted


class LabPage:
    """The Lab page, without focus and button prompts."""

    def __init__(self, context: Context) -> None:
        self.words, self.language = context.words, context.words.language
        self.ground = ground(context.words.language)
        self.arena = ArenaView(self.ground)
        self.curve = LearningCurve(self.ground)
        self.levels = [0] * PETALS  # animated towards the target

    def watch(self, state: Any) -> None:
        """Take over a new match state."""
        self.arena.show(state)

    def update(self, seconds: float) -> None:
        """Animate the robots and prewarm sprites."""
        self.arena.update(seconds)
        self.arena.prewarm(WARM)

    def draw(self, screen: pygame.Surface, now: LabState) -> None:
        screen.blit(self.ground, (0, 0))
        self.arena.draw(screen)
        blit_sprite(screen, tag(self.words("lab.match", number=now.matches + 1)), ARENA.left + 12, ARENA.bottom - 66)
        self.curve.show(now.measures)
        self.curve.draw(screen, self.words("lab.handmade"), "…")
        self._plan(screen, now)
        for i, name in enumerate(KNOB_NAMES):
            box = knob_rect(i)
            held = name == now.held
            dial(now.values.get(name, 0), held).draw(screen, box.centerx, KNOB_Y)
            knob_name(self.words(f"lab.{name}"), name == now.focus).draw(screen, box.centerx, KNOB_Y)
        box = kind_rect(self.words)
        kind_switch(self.language, now.kind, now.networks).draw(screen, *box.topleft)
        speed(self.words("lab.max"), now.speed).draw(screen, *SPEED.topleft)

    # ---- inside

    def _plan(self, screen: pygame.Surface, now: LabState) -> None:
        """Draw the rose and the bar below it."""
        changes = [k for k in range(PETALS) if self.levels[k] != now.levels[k]]
        for k in changes[:STEPS]:
            self.levels[k] += 1 if now.levels[k] > self.levels[k] else -1
        draw_petals(screen, *ROSE, self.levels)
        draw_signs(screen, *ROSE, now.signs)
        blit_sprite(screen, tank(0, UP), *ROSE)
        left, right = bar_ends(self.words)
        bar_knob().draw(screen, left + (right - left) * now.knowing, BAR_Y)


@cached
@resumable
def ground(language: str) -> Steps[pygame.Surface]:
    """The static background."""
    words, canvas = Words(language), LayeredCanvas()
    out = black_out(backdrop().copy(), MATCH, KNOBS, CURVE, PLAN, kind_rect(words), SPEED, PLAY)
    yield
    title = words("lab.title")
    canvas.text(title, fit_size(title, TITLE, kind_rect(words).left - LEFT - 20), LEFT, TITLE_Y, ICE)
    yield
    canvas.glow.line(outline(MATCH, 20), WALL, THIN, True)
    yield
    for x in range(52, ARENA.w, 52):
        for y in range(52, ARENA.h, 52):
            canvas.crisp.disc(ARENA.x + x, ARENA.y + y, 1.5, (26, 37, 54))
    yield
    for box in (KNOBS, CURVE, PLAN):
        panel(canvas.glow, *box)
    yield
    _caption(canvas, words("lab.likes"), KNOBS)
    _caption(canvas, words("lab.wins"), CURVE)
    canvas.body(words("lab.ties"), CURVE.right - 36, CURVE.top + 40, MIST, "r")
    canvas.crisp.line([PLOT.topleft, PLOT.bottomleft, PLOT.bottomright], STEEL, THIN)
    yield
    _legend(canvas, words)
    _bar(canvas, words)
    _play(canvas, words("lab.play"))
    yield
    light = yield from canvas.render_steps()
    out.blit(light, (0, 0), special_flags=pygame.BLEND_RGB_ADD)
    return out


def _caption(canvas: LayeredCanvas, name: str, box: pygame.Rect) -> None:
    canvas.body(name, box.left + 32, box.top + 40, ICE, "l", fit_size(name, BODY + 4, box.w - 64, "body"))


def _legend(canvas: LayeredCanvas, words: Words) -> None:
    """Legend of the rose."""
    y, room = PLAN.top, PLAN.right - WORDS_X - 28
    title = words("lab.plan")
    canvas.text(title, fit_size(title, 60, room), WORDS_X, y + 56, ICE)
    for i, key in enumerate(("lab.enemy", "lab.does")):
        label = words(key)
        canvas.body(label, WORDS_X, y + 116 + 48 * i, MIST, "l", fit_size(label, BODY, room, "body"))
    for i, (name, key) in enumerate((("shoot", "shoot"), ("ahead", "drive"), ("turn_right", "turn"))):
        icon(canvas.crisp, name, WORDS_X + 20, y + 226 + 52 * i, 18, ICE, 5 if name == "shoot" else 6)
        canvas.body(words(f"lab.{key}"), WORDS_X + 60, y + 226 + 52 * i)
    x = float(WORDS_X)
    for key, level in (("good", LEVELS), ("bad", -LEVELS)):
        canvas.crisp.fill(cut_box(x, y + 368, 32, 32, 7), dim(tone(level), 0.5)).line(
            cut_box(x, y + 368, 32, 32, 7), tone(level), THIN, True
        )
        canvas.body(words(f"lab.{key}"), x + 48, y + 384)
        x += 48 + text_width(words(f"lab.{key}"), BODY, "body") + 36


def bar_ends(words: Words) -> tuple[float, float]:
    """Left and right end of the bar from guessing to knowing, px."""
    left = PLAN.left + 36 + text_width(words("lab.guessing"), BODY, "body") + 32
    return left, PLAN.right - 36 - text_width(words("lab.knowing"), BODY, "body") - 32


def _bar(canvas: LayeredCanvas, words: Words) -> None:
    left, right = bar_ends(words)
    canvas.body(words("lab.guessing"), PLAN.left + 36, BAR_Y, MIST)
    canvas.body(words("lab.knowing"), PLAN.right - 36, BAR_Y, ICE, "r")
    steps = 60
    for i in range(steps):
        x, color = left + (right - left) * i / steps, mix((120, 70, 170), GOOD, i / steps)
        canvas.crisp.fill([(x, BAR_Y - 7), (x + (right - left) / steps + 1, BAR_Y - 7),
                        (x + (right - left) / steps + 1, BAR_Y + 7), (x, BAR_Y + 7)], color)  # fmt: skip


def _play(canvas: LayeredCanvas, label: str) -> None:
    """Button that starts a challenge match."""
    canvas.glow.line(outline(PLAY), GREEN, THIN, True)
    icon(canvas.glow, "pad", PLAY.left + 58, PLAY.centery, 34, GREEN, THIN)
    canvas.body(label, PLAY.left + 112, PLAY.centery, ICE, "l", fit_size(label, BODY + 2, PLAY.w - 136, "body"))


@cached
def speed(max_label: str, chosen: int) -> LitImage:
    """The three speeds, the selected one lit; top left at (0, 0)."""
    layer = Layer(0, 0, SPEED.w, SPEED.h)
    layer.glow.line(cut_box(0, 0, SPEED.w, SPEED.h, 16), BLUE, THIN, True)
    for i, (label, name) in enumerate(zip((*SPEEDS[:-1], max_label), SPEED_SIGNS, strict=True)):
        x, w = speed_part(i)
        on = i == chosen
        if on:
            layer.canvas.crisp.fill(cut_box(x + 8, 8, w - 16, SPEED.h - 16, 10), dim(BLUE, 0.3))
        width = text_width(label, BODY)
        left = x + (w - width - 44) / 2
        icon(layer.canvas.crisp, name, left + 16, SPEED.h / 2, 17, BLUE if on else STEEL, THIN)
        layer.canvas.crisp.text(label, BODY, left + 44, SPEED.h / 2, ICE if on else MIST, "head")
    return layer.render()


def speed_part(i: int) -> tuple[int, int]:
    """x within the button and width of one speed, px."""
    return ((0, 118), (118, 140), (258, 158))[i]


def speed_at(x: float) -> int:
    """Index of the speed at `x` px from the left edge of the button."""
    return next(i for i in (2, 1, 0) if x >= speed_part(i)[0] or i == 0)


@cached
def knob_name(label: str, focus: bool) -> LitImage:
    """Label of a knob in at most two lines below it, relative to the knob's centre."""
    color: Color = FOCUS if focus else ICE
    lines = wrap_balanced(label, 2)
    layer = Layer(-104, 60, 208, 90)
    for i, line in enumerate(lines):
        y = 84 + 40 * i + (20 if len(lines) == 1 else 0)
        layer.canvas.body(line, 0, y, color, "c", fit_size(line, BODY, 200, "body"))
    return layer.render()


@cached
def warming(label: str) -> LitImage:
    """Notice beside a clock above the centre of the plot, which early curves do not reach."""
    layer = Layer(PLOT.x, PLOT.y - 10, PLOT.w, 92)
    icon(layer.canvas.crisp, "clock", PLOT.x + 40, PLOT.y + 34, 22, MIST, THIN)
    for i, line in enumerate(wrap_balanced(label, 2)):
        size = fit_size(line, BODY, PLOT.w - 92, "body")
        layer.canvas.body(line, PLOT.x + 80, PLOT.y + 12 + 44 * i, MIST, "l", size)
    return layer.render()


@cached
def tag(label: str) -> Sprite:
    """Text on a black plate, relative to its top left."""
    w = round(text_width(label, BODY, "body")) + 40
    ink = GlowCanvas(w + 48, 102).set_transform(24, 24)
    ink.solid(cut_box(0, 0, w, 54, 12)).line(cut_box(0, 0, w, 54, 12), STEEL, 3, True)
    ink.text(label, BODY, w / 2, 27, ICE, "body", "c")
    return Sprite(ink.sprite(0.5), -24, -24)


@cached
def bar_knob() -> LitImage:
    """Position marker on the bar, centred on (0, 0)."""
    ink = GlowCanvas(80, 80).disc(40, 40, 17, WHITE)
    return LitImage(ink.lit(0.5), (-40, -40))


def outline(box: pygame.Rect, c: float = 16) -> Points:
    """Box outline with cut corners."""
    return cut_box(box.x, box.y, box.w, box.h, c)
