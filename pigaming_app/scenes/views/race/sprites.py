"""Sprites of a race: signs and plates over robots, the ghost, arrows, clods, confetti."""

import math
import random

import pygame

from pigaming_app.scenes.views.race.hud_cards import u_turn
from pigaming_app.scenes.views.race.lines import draw_sign, flag
from pigaming_app.scenes.views.things.styles import MUD
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, faded, master, painted, trim, turned
from pigaming_app.ui.draw.surface_cache import cached

SIGN_AT = 100.0  # px from a robot to the centre of its sign
LEVELS = 5  # brightness levels of fading particles
CLODS = (3, 5, 7)  # px
GHOST_TURNS = 48
DARK_RED = (36, 6, 8)


@cached
def wrong_way(below: bool) -> Sprite:
    """Wrong-way sign: a red disc with a bent arrow pointing at the robot above or `below` it."""
    ink, up = kit.GlowCanvas(184, 184).set_transform(92, 92), -1 if below else 1
    ink.solid(kit.regular_polygon(48, 54)).solid([(-18, 44 * up), (18, 44 * up), (0, 72 * up)])
    ink.fill([(-16, 42 * up), (16, 42 * up), (0, 68 * up)], kit.ALARM)
    ink.disc(0, 0, 51, kit.ALARM).disc(0, 0, 44, DARK_RED)
    return trim(u_turn(ink, 0, -1, 0.92).sprite(0.9), 92, 92)


@cached
def missed(sign: int, below: bool, words: tuple[str, ...] = ()) -> Sprite:
    """Missed-line sign: the sign of the line to return to; `words`: text of an invalid lap."""
    width = max([132.0, *(kit.text_width(text, kit.BODY) + 48 for text in words)])
    height = 84 + 46 * len(words)
    half_w, half_h = round(width / 2) + 30, height // 2 + 50
    ink, up = kit.GlowCanvas(2 * half_w, 2 * half_h).set_transform(half_w, half_h), -1 if below else 1
    ink.fill([(-17, (height / 2 - 4) * up), (17, (height / 2 - 4) * up), (0, (height / 2 + 24) * up)], kit.ALARM)
    box = kit.cut_box(-width / 2, -height / 2, width, height, 18)
    ink.solid(box).fill(box, DARK_RED).line(box, kit.ALARM, kit.LINE, True)
    for i, text in enumerate(words):
        ink.text(text, kit.BODY, 0, -height / 2 + 38 + 46 * i, kit.WHITE, "head", "c")
    middle = height / 2 - 42
    draw_sign(ink, sign, -28, middle, 25)
    ink.line([(34, middle - 22), (34, middle + 3)], kit.WHITE, 10).disc(34, middle + 21, 6.5, kit.WHITE)
    sprite = trim(ink.sprite(0.8), half_w, half_h)
    return Sprite(sprite.image, sprite.dx, sprite.dy - (height // 2 - 42) * up)


@cached
def place(seat: int, number: int, ending: str, below: bool) -> Sprite:
    """Finish sign: the place between chequered bands."""
    color = kit.PLAYERS[seat]
    text = f"{number}{ending}"
    width = max(112, round(kit.text_width(text, kit.SUB, "hero")) + 40) // 16 * 16 + 16
    half_w, half_h = width // 2 + 30, 100
    ink, up = kit.GlowCanvas(2 * half_w, 2 * half_h).set_transform(half_w, half_h), -1 if below else 1
    box = [(-width / 2, -54), (width / 2, -54), (width / 2, 54), (-width / 2, 54)]
    ink.fill([(-14, 54 * up), (14, 54 * up), (0, 76 * up)], color)
    ink.solid(box).line(box, color, kit.THIN, True)
    for row, y in ((0, -52), (1, -44), (0, 36), (1, 44)):
        for x in range(-width // 2 + 8 * row, width // 2, 16):
            ink.fill([(x, y), (x + 8, y), (x + 8, y + 8), (x, y + 8)], kit.ICE)
    ink.text(text, kit.SUB, 0, 0, kit.FOCUS if number == 1 else kit.mix(color, kit.WHITE, 0.6), "hero", "c")
    return trim(ink.sprite(0.8), half_w, half_h)


@cached
def notice(text: str, color: kit.Color, sign: str = "") -> Sprite:
    """Rising word over a robot, with a star or a flag before it."""
    lead = 64 if sign else 0
    width, height = round(kit.text_width(text, kit.LABEL, "hero")) + lead + 80, 120
    ink = kit.GlowCanvas(width, height)
    box = kit.cut_box(14, 22, width - 28, height - 44, 14)
    ink.solid(box).line(box, kit.dim(color, 0.55), kit.THIN, True)
    if sign == "star":
        ink.fill(kit.star_points(24, 62, height / 2), color)
    elif sign:
        flag(ink, 62, height / 2, 20, color)
    ink.text(text, kit.LABEL, 40 + lead, height / 2, color, "hero")
    return trim(ink.sprite(0.7), width / 2, height / 2)


@cached
def gold_star() -> Sprite:
    """Star before a best time."""
    return trim(kit.GlowCanvas(112, 112).set_transform(56, 56).fill(kit.star_points(28), kit.FOCUS).lit(0.9), 56, 56)


@cached
def ghost(turn: int) -> Sprite:
    """Ghost of the best lap ever at heading `turn` of GHOST_TURNS: a dashed outline with a star."""
    return turned(painted(_ghost, ()), turn, GHOST_TURNS)


def _ghost() -> pygame.Surface:
    ink, color = master(64), kit.mix(kit.FOCUS, kit.WHITE, 0.2)
    ink.dashes(kit.regular_polygon(72, 34), color, 5, 15, 11.7)
    ink.fill([(52, 0), (39, 13), (39, -13)], color)
    return ink.fill(kit.star_points(15), color).lit(0.8)


@cached
def dash(seat: int, turn: int) -> Sprite:
    """Dash of the path to a missed line, at heading `turn` of HEADINGS."""
    return turned(painted(_dash, (seat,)), turn, HEADINGS)


def _dash(seat: int) -> pygame.Surface:
    ink = master(32)
    ink.solid([(-13, -6), (13, -6), (13, 6), (-13, 6)])
    return ink.line([(-9, 0), (9, 0)], kit.PLAYERS[seat], 7).sprite(0.7)


@cached
def tip(seat: int, turn: int) -> Sprite:
    """Arrowhead at the end of that path, at heading `turn` of HEADINGS."""
    return turned(painted(_tip, (seat,)), turn, HEADINGS)


def _tip(seat: int) -> pygame.Surface:
    ink = master(52)
    ink.solid([(30, 0), (-22, 30), (-22, -30)])
    return ink.fill([(24, 0), (-16, 23), (-16, -23)], kit.PLAYERS[seat]).sprite(0.9)


@cached
def clods(size: int) -> tuple[Sprite, ...]:
    """Fading clod of mud: the last frame is the brightest."""
    whole = trim(kit.GlowCanvas(48, 48).set_transform(24, 24).disc(0, 0, size, MUD).lit(0.4), 24, 24)
    return *(faded(whole, level / LEVELS) for level in range(1, LEVELS)), whole


@cached
def splash(which: int) -> Sprite:
    """Splash of mud under a robot, one of three shapes."""
    rng, ink, color = random.Random(which), kit.GlowCanvas(160, 160).set_transform(80, 80), kit.dim(MUD, 0.62)
    for _ in range(17):
        a, r = rng.random() * math.tau, rng.uniform(38, 56)
        ink.line([(20 * math.cos(a), 20 * math.sin(a)), (r * math.cos(a), r * math.sin(a))], color, rng.uniform(7, 15))
    return trim(ink.disc(0, 0, 42, color).lit(0.3), 80, 80)


@cached
def confetti(color: kit.Color, turn: int) -> tuple[Sprite, ...]:
    """Fading chequered confetti at one of four angles: the last frame is the brightest."""
    ink = kit.GlowCanvas(56, 56).set_transform(28, 28, turn * math.pi / 8)
    whole = trim(ink.fill([(-6, -6), (6, -6), (6, 6), (-6, 6)], color).lit(0.6), 28, 28)
    return *(faded(whole, level / LEVELS) for level in range(1, LEVELS)), whole
