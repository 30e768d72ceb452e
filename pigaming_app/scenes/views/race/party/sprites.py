"""Sprites of `party`: boost pads, item boxes, oil, air in a slipstream, spins, and changes of place."""

import math
import random

import pygame

from pigaming_app.games.race.state import PAD_HALF
from pigaming_app.scenes.views.race.hud_cards import GAIN, LOSS
from pigaming_app.scenes.views.race.lines import WIDE_LINE, LineFrame
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, faded, master, painted, trim, turned
from pigaming_app.ui.draw.surface_cache import cached

PAD_PHASES = 8
BOX_TURNS = 12  # in a sixth of a turn
OIL_SHAPES = 3
OIL_LEVELS = 3
AIR_TURNS, AIR_LEVELS = 48, 3
SWIRL_TURNS = 12
SHIELD_SWAY = 3  # of 24 turns: few, as a shield takes much of the sprites' memory
PULSE_LEVELS = 4
OIL: kit.Color = (168, 120, 255)
SHEEN: kit.Color = (70, 215, 200)


@cached
def pad(turn: int, phase: int, color: kit.Color) -> Sprite:
    """Boost pad at heading `turn` of HEADINGS: three chevrons that light up in driving direction."""
    return turned(painted(_pad, (phase, color)), turn, HEADINGS)


def _pad(phase: int, color: kit.Color) -> pygame.Surface:
    ink, h = master(58), PAD_HALF
    for x in (-h, h):
        for y in (-h, h):
            inward = [(x - math.copysign(16, x), y), (x, y), (x, y - math.copysign(16, y))]
            ink.line(inward, kit.dim(color, 0.45), kit.THIN)
    for i in range(3):
        lag = (phase / PAD_PHASES - i / 3) % 1.0
        bright = 0.28 + 0.72 * max(0.0, 1.0 - 2.2 * lag)
        x = -22.0 + 20.0 * i
        ink.line([(x - 8, -24), (x + 12, 0), (x - 8, 24)], kit.dim(color, bright), 9)
    return ink.lit(0.9)


@cached
def item_box(turn: int) -> Sprite:
    """Item box at `turn` of BOX_TURNS: a hexagon round a question mark."""
    ink = kit.GlowCanvas(112, 112, 3).set_transform(56, 56)
    frame = kit.regular_polygon(6, 31, turn * math.tau / 6 / BOX_TURNS)
    ink.solid(frame).neon(frame, kit.FOCUS, 5, True)
    ink.text("?", 40, 0, 0, kit.mix(kit.FOCUS, kit.WHITE, 0.5), "hero", "c")
    return trim(ink.sprite(0.9), 56, 56)


@cached
def box_gone() -> Sprite:
    """Place of an item box that was taken."""
    ink = kit.GlowCanvas(96, 96).set_transform(48, 48)
    return trim(ink.dashes(kit.regular_polygon(6, 30), kit.dim(kit.FOCUS, 0.4), 3, 9, 9).sprite(0.2), 48, 48)


@cached
def oil(shape: int, level: int) -> Sprite:
    """Oil slick in one of OIL_SHAPES, brightness `level` of OIL_LEVELS."""
    if level < OIL_LEVELS:
        return faded(oil(shape, OIL_LEVELS), level / OIL_LEVELS)
    rng, ink = random.Random(40 + shape), kit.GlowCanvas(128, 128, 3).set_transform(64, 64)
    waves = [(k, share, rng.uniform(0.0, math.tau)) for k, share in ((2, 0.10), (3, 0.07), (5, 0.02))]

    def ring(radius: float, first: int = 0, last: int = 48) -> list[tuple[float, float]]:
        points = []
        for i in range(first, last):
            a = i * math.tau / 48
            r = radius * (1.0 + sum(share * math.sin(k * a + phase) for k, share, phase in waves))
            points.append((r * math.cos(a), 0.86 * r * math.sin(a)))
        return points

    ink.solid(ring(37)).fill(ring(35), kit.dim(OIL, 0.22)).line(ring(35), OIL, kit.THIN, True)
    ink.line(ring(24, 26, 44), SHEEN, kit.THIN).line(ring(23, 4, 15), kit.mix(OIL, kit.WHITE, 0.4), kit.THIN)
    ink.line(ring(12, 28, 42), kit.dim(SHEEN, 0.7), 3)
    return trim(ink.sprite(0.7), 64, 64)


@cached
def air(turn: int, level: int) -> Sprite:
    """Streak of air at heading `turn` of AIR_TURNS, brightness `level` of AIR_LEVELS."""
    if level < AIR_LEVELS:
        return faded(air(turn, AIR_LEVELS), level / AIR_LEVELS)
    return turned(painted(_air, ()), turn, AIR_TURNS)


def _air() -> pygame.Surface:
    ink = master(30)
    for i in range(6):
        ink.line([(-20 + 3 * i, 0), (18, 0)], kit.dim(kit.ICE, 0.16 * (i + 1)), 1.5 + 0.4 * i)
    return ink.lit(0.5)


@cached
def swirl(turn: int, r: int) -> Sprite:
    """Arcs around a spinning robot, `r` px from its centre, at `turn` of SWIRL_TURNS in a third of a turn."""
    return turned(painted(_swirl, (r,)), turn, 3 * SWIRL_TURNS)


def _swirl(r: int) -> pygame.Surface:
    ink = master(r + 22)
    for i in range(3):
        a = i * math.tau / 3
        for k in range(5):
            ink.arc(0, 0, r, a + 0.18 * k, a + 0.9, kit.dim(OIL, 0.24 * (k + 1) - 0.2), 3 + k)
    return ink.lit(0.9)


@cached
def finish_pulse(line: LineFrame, level: int) -> Sprite:
    """Light over the rails of the finish line during the last lap, brightness `level` of PULSE_LEVELS."""
    if level < PULSE_LEVELS:
        return faded(finish_pulse(line, PULSE_LEVELS), level / PULSE_LEVELS)
    half = math.ceil(line.half) + 40
    ink = kit.GlowCanvas(2 * half, 2 * half).set_transform(half - line.x, half - line.y)
    for rail in (-WIDE_LINE, WIDE_LINE):
        ink.line([line.at(rail, 3 - line.half), line.at(rail, line.half - 3)], kit.FOCUS, 9)
    return trim(ink.lit(1.3), half, half)


@cached
def place_change(seat: int, up: bool, place: str) -> Sprite:
    """A place gained or lost by a seat: a small plate with an arrow and the new place."""
    color, side = (GAIN, -1) if up else (LOSS, 1)
    width = round(kit.text_width(place, kit.BODY, "hero")) + 104
    ink = kit.GlowCanvas(width, 96)
    x, y = 46.0, 48.0
    plate = kit.cut_box(18, 20, width - 36, 56, 10)
    ink.solid(plate).line(plate, kit.dim(kit.PLAYERS[seat], 0.7), 3, True)
    ink.fill([(x - 15, y - 11 * side), (x + 15, y - 11 * side), (x, y + 15 * side)], color)
    ink.text(place, kit.BODY, x + 24, y, color, "hero")
    return trim(ink.sprite(0.7), width / 2, 48)
