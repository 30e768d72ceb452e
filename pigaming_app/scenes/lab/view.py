"""Rendering of the Lab page: a static background painted once, with dynamic widgets on top."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import pygame

from pigaming_app.scenes.brain.rose import LEVELS, PETALS, draw_petals, draw_signs, tone
from pigaming_app.scenes.flow.scene import Context
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
    LINE,
    MATCH,
    PLAN,
    PLAY,
    PLOT,
    ROSE,
    SIDE_COLORS,
    SIDE_LETTERS,
    SIDES,
    SPEED,
    TITLE_Y,
    WORDS_X,
    knob_rect,
)
from pigaming_app.scenes.lab.learning_curve import LearningCurve, WinCourse
from pigaming_app.scenes.lab.network.kind_switch import TABLE, kind_rect, kind_switch
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, backdrop, fit_size, fit_text, wrap_balanced
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite
from pigaming_app.ui.draw.surface_cache import cached
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
    rate: int = 0  # matches a second
    courses: Sequence[WinCourse] = (WinCourse(),)  # of A, or of A and B
    side: int = 0  # the one that is shown
    line: str = ""  # its reward
    levels: list[int] = field(default_factory=lambda: [0] * PETALS)  # petal length of each direction
    signs: Sequence[str] = ("unknown",) * PETALS
    knowing: float = 0.0  # 0: only explores, 1: only exploits
    values: Mapping[str, float] = field(default_factory=dict)  # knob values
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
        label = self.words("lab.match", number=now.matches + 1)
        if now.rate:
            label += self.words("lab.rate", rate=now.rate)
        blit_sprite(screen, tag(label), MATCH.left + 20, ARENA.bottom - 66)
        self.curve.show(now.courses)
        self.curve.draw(screen, self.words("lab.handmade"))
        self._plan(screen, now)
        for i, name in enumerate(KNOB_NAMES):
            box = knob_rect(i)
            held = name == now.held
            dial(now.values.get(name, 0.0), held).draw(screen, box.centerx, KNOB_Y)
            knob_name(self.words(f"lab.{name}"), name == now.focus).draw(screen, box.centerx, KNOB_Y)
        side_switch(now.side, len(now.courses)).draw(screen, *SIDES.topleft)
        code(now.line, now.focus == "line").draw(screen, *LINE.topleft)
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
    words, canvas = Words(language), kit.LayeredCanvas()
    out = black_out(backdrop().copy(), MATCH, KNOBS, CURVE, PLAN, kind_rect(words), SPEED, PLAY)
    yield
    title = words("lab.title")
    canvas.text(title, fit_size(title, kit.TITLE, kind_rect(words).left - LEFT - 20), LEFT, TITLE_Y, kit.ICE)
    yield
    canvas.glow.line(outline(MATCH, 20), kit.WALL, kit.THIN, True)
    yield
    for x in range(52, ARENA.w, 52):
        for y in range(52, ARENA.h, 52):
            canvas.crisp.disc(ARENA.x + x, ARENA.y + y, 1.5, (26, 37, 54))
    yield
    for box in (KNOBS, CURVE, PLAN):
        kit.panel(canvas.glow, *box)
    yield
    _caption(canvas, words("lab.likes"), KNOBS, SIDES.centery, SIDES.w + 40)
    _caption(canvas, words("lab.wins"), CURVE, CURVE.top + 40)
    canvas.body(words("lab.ties"), CURVE.right - 36, CURVE.top + 40, kit.MIST, "r")
    canvas.crisp.line([PLOT.topleft, PLOT.bottomleft, PLOT.bottomright], kit.STEEL, kit.THIN)
    yield
    _legend(canvas, words)
    _bar(canvas, words)
    _play(canvas, words("lab.play"))
    yield
    light = yield from canvas.render_steps()
    out.blit(light, (0, 0), special_flags=pygame.BLEND_RGB_ADD)
    return out


def _caption(canvas: kit.LayeredCanvas, name: str, box: pygame.Rect, y: float, taken: int = 0) -> None:
    """Write a caption; `taken`: px at its right."""
    size = fit_size(name, kit.BODY + 4, box.w - 64 - taken, "body")
    canvas.body(name, box.left + 32, y, kit.ICE, "l", size)


def _legend(canvas: kit.LayeredCanvas, words: Words) -> None:
    """Legend of the rose."""
    y, room = PLAN.top, PLAN.right - WORDS_X - 28
    title = words("lab.plan")
    canvas.text(title, fit_size(title, 60, room), WORDS_X, y + 56, kit.ICE)
    for i, key in enumerate(("lab.enemy", "lab.does")):
        label = words(key)
        canvas.body(label, WORDS_X, y + 116 + 48 * i, kit.MIST, "l", fit_size(label, kit.BODY, room, "body"))
    for i, (name, key) in enumerate((("shoot", "shoot"), ("ahead", "drive"), ("turn_right", "turn"))):
        kit.icon(canvas.crisp, name, WORDS_X + 20, y + 226 + 52 * i, 18, kit.ICE, 5 if name == "shoot" else 6)
        canvas.body(words(f"lab.{key}"), WORDS_X + 60, y + 226 + 52 * i)
    x = float(WORDS_X)
    for key, level in (("good", LEVELS), ("bad", -LEVELS)):
        canvas.crisp.fill(kit.cut_box(x, y + 368, 32, 32, 7), kit.dim(tone(level), 0.5)).line(
            kit.cut_box(x, y + 368, 32, 32, 7), tone(level), kit.THIN, True
        )
        canvas.body(words(f"lab.{key}"), x + 48, y + 384)
        x += 48 + kit.text_width(words(f"lab.{key}"), kit.BODY, "body") + 36


def bar_ends(words: Words) -> tuple[float, float]:
    """Left and right end of the bar from guessing to knowing, px."""
    left = PLAN.left + 36 + kit.text_width(words("lab.guessing"), kit.BODY, "body") + 32
    return left, PLAN.right - 36 - kit.text_width(words("lab.knowing"), kit.BODY, "body") - 32


def _bar(canvas: kit.LayeredCanvas, words: Words) -> None:
    left, right = bar_ends(words)
    canvas.body(words("lab.guessing"), PLAN.left + 36, BAR_Y, kit.MIST)
    canvas.body(words("lab.knowing"), PLAN.right - 36, BAR_Y, kit.ICE, "r")
    steps = 60
    for i in range(steps):
        x, color = left + (right - left) * i / steps, kit.mix((120, 70, 170), GOOD, i / steps)
        canvas.crisp.fill([(x, BAR_Y - 7), (x + (right - left) / steps + 1, BAR_Y - 7),
                        (x + (right - left) / steps + 1, BAR_Y + 7), (x, BAR_Y + 7)], color)  # fmt: skip


def _play(canvas: kit.LayeredCanvas, label: str) -> None:
    """Button that starts a challenge match."""
    canvas.glow.line(outline(PLAY), kit.GREEN, kit.THIN, True)
    kit.icon(canvas.glow, "pad", PLAY.left + 58, PLAY.centery, 34, kit.GREEN, kit.THIN)
    canvas.body(label, PLAY.left + 112, PLAY.centery, kit.ICE, "l", fit_size(label, kit.BODY + 2, PLAY.w - 136, "body"))


@cached
def speed(max_label: str, chosen: int) -> LitImage:
    """The three speeds, the selected one lit; top left at (0, 0)."""
    layer = Layer(0, 0, SPEED.w, SPEED.h)
    layer.glow.line(kit.cut_box(0, 0, SPEED.w, SPEED.h, 16), kit.BLUE, kit.THIN, True)
    for i, (label, name) in enumerate(zip((*SPEEDS[:-1], max_label), SPEED_SIGNS, strict=True)):
        x, w = speed_part(i)
        on = i == chosen
        if on:
            layer.canvas.crisp.fill(kit.cut_box(x + 8, 8, w - 16, SPEED.h - 16, 10), kit.dim(kit.BLUE, 0.3))
        width = kit.text_width(label, kit.BODY)
        left = x + (w - width - 44) / 2
        kit.icon(layer.canvas.crisp, name, left + 16, SPEED.h / 2, 17, kit.BLUE if on else kit.STEEL, kit.THIN)
        layer.canvas.crisp.text(label, kit.BODY, left + 44, SPEED.h / 2, kit.ICE if on else kit.MIST, "head")
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
    color: kit.Color = kit.FOCUS if focus else kit.ICE
    lines = wrap_balanced(label, 2)
    layer = Layer(-104, 60, 208, 90)
    for i, line in enumerate(lines):
        y = 84 + 40 * i + (20 if len(lines) == 1 else 0)
        layer.canvas.body(line, 0, y, color, "c", fit_size(line, kit.BODY, 200, "body"))
    return layer.render()


@cached
def code(line: str, focus: bool) -> LitImage:
    """The reward as code, in its box; top left at (0, 0)."""
    layer = Layer(0, 0, *LINE.size)
    layer.canvas.crisp.line(kit.cut_box(0, 0, *LINE.size, 12), kit.STEEL, kit.THIN, True)
    shown, size = fit_text(line, kit.BODY, LINE.w - 48, "body")
    layer.canvas.body(shown, 24, LINE.h / 2, kit.FOCUS if focus else kit.ICE, "l", size)
    return layer.render()


@cached
def side_switch(chosen: int, sides: int) -> LitImage:
    """The robots A and B, the chosen one lit in the colour of its curve; top left at (0, 0)."""
    w, h = SIDES.size
    layer = Layer(0, 0, w, h)
    layer.glow.line(kit.cut_box(0, 0, w, h, 12), kit.BLUE, kit.THIN, True)
    for i, letter in enumerate(SIDE_LETTERS):
        x, on = i * w / 2, i == chosen
        if on:
            layer.canvas.crisp.fill(kit.cut_box(x + 6, 6, w / 2 - 12, h - 12, 8), kit.dim(kit.BLUE, 0.3))
        label = letter if i < sides else "+" + letter
        color = SIDE_COLORS[i] if i < sides and sides > 1 else kit.ICE if on else kit.MIST
        layer.canvas.crisp.text(label, kit.BODY - 4, x + w / 4, h / 2, color, "head", "c")
    return layer.render()


@cached
def notice(label: str) -> LitImage:
    """Notice beside a clock above the centre of the plot, which early curves do not reach."""
    layer = Layer(PLOT.x, PLOT.y - 10, PLOT.w, 92)
    kit.icon(layer.canvas.crisp, "clock", PLOT.x + 40, PLOT.y + 34, 22, kit.MIST, kit.THIN)
    for i, line in enumerate(wrap_balanced(label, 2)):
        size = fit_size(line, kit.BODY, PLOT.w - 92, "body")
        layer.canvas.body(line, PLOT.x + 80, PLOT.y + 12 + 44 * i, kit.MIST, "l", size)
    return layer.render()


@cached
def tag(label: str) -> Sprite:
    """Text on a black plate, relative to its top left."""
    w = round(kit.text_width(label, kit.BODY, "body")) + 40
    ink = kit.GlowCanvas(w + 48, 102).set_transform(24, 24)
    ink.solid(kit.cut_box(0, 0, w, 54, 12)).line(kit.cut_box(0, 0, w, 54, 12), kit.STEEL, 3, True)
    ink.text(label, kit.BODY, w / 2, 27, kit.ICE, "body", "c")
    return Sprite(ink.sprite(0.5), -24, -24)


@cached
def bar_knob() -> LitImage:
    """Position marker on the bar, centred on (0, 0)."""
    ink = kit.GlowCanvas(80, 80).disc(40, 40, 17, kit.WHITE)
    return LitImage(ink.lit(0.5), (-40, -40))


def outline(box: pygame.Rect, c: float = 16) -> kit.Points:
    """Box outline with cut corners."""
    return kit.cut_box(box.x, box.y, box.w, box.h, c)
