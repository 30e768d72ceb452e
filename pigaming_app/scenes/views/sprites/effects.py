"""Short-lived light effects as additive sprites: shots, flashes, flames, sparks, shards, shock waves."""

import math
import random

import pygame

from pigaming_app.ui.draw import LINE, PLAYERS, WALL, WHITE, Color, GlowCanvas, dim, mix, regular_polygon
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, faded, master, painted, trim, turned
from pigaming_app.ui.draw.surface_cache import cached

TURNS = 48  # headings of sprites with coarse rotation
SPARK_TURNS = 24
SPARK_LEVELS = 6
SPARK_SIZES = (2, 3, 5)  # px
SHARDS = 4  # shapes of debris
TREAD_LEVELS = 6
WAVE_STEPS = 16
LIGHT_LEVELS = 8
BEAM_TURNS = 64
BEAM_ARM = 114  # px from a robot to the centre of its headlight
FLAME_ARM = -66
MAGAZINE_R = 60  # px from a robot to the shots in its magazine


@cached
def beam(player: int, turn: int) -> Sprite:
    """Headlight at heading `turn` of BEAM_TURNS."""
    return turned(painted(_beam, (player,)), turn, BEAM_TURNS, BEAM_ARM, 2.0)


def _beam(player: int) -> pygame.Surface:
    ink = GlowCanvas(124, 124, 4).set_transform(62 - BEAM_ARM / 2, 62, 0.0, 0.5)
    for i in range(14, 0, -1):
        half, reach = 0.30 * (0.5 + i / 28), 40 + 10 * i
        shape = [(30, -6), (reach, -reach * half), (reach + 10, 0), (reach, reach * half), (30, 6)]
        ink.fill(shape, dim(PLAYERS[player], 0.40 * (1 - i / 14)))
    return pygame.transform.gaussian_blur(ink.plain(), 5)


@cached
def tread(player: int, turn: int, level: int) -> Sprite:
    """Marks of both wheels at heading `turn` of TURNS, brightness `level` of TREAD_LEVELS."""
    if level == TREAD_LEVELS:
        return turned(painted(_tread, (player,)), turn, TURNS)
    return faded(tread(player, turn, TREAD_LEVELS), level / TREAD_LEVELS)


def _tread(player: int) -> pygame.Surface:
    ink = master(48)
    for side in (-1, 1):
        ink.line([(-5, side * 31 - 5), (0, side * 31), (-5, side * 31 + 5)], dim(PLAYERS[player], 0.46), 3)
    return ink.plain()


@cached
def flame(player: int, turn: int, flicker: int) -> Sprite:
    """Turbo flames behind the wheels at heading `turn` of TURNS; `flicker`: 0 or 1."""
    return turned(painted(_flame, (player, flicker)), turn, TURNS, FLAME_ARM)


def _flame(player: int, flicker: int) -> pygame.Surface:
    ink, color = master(72, FLAME_ARM), PLAYERS[player]
    for side in (-1, 1):
        reach = (78, 98)[(flicker + (side > 0)) % 2]
        for k, c in ((1.0, dim(color, 0.45)), (0.7, color), (0.4, mix(color, WHITE, 0.7))):
            ink.fill([(-38, side * 30 - 9 * k), (-38 - (reach - 38) * k, side * 30), (-38, side * 30 + 9 * k)], c)
    return ink.lit(1.2)


@cached
def bullet(player: int, turn: int) -> Sprite:
    """Shot with a tail at heading `turn` of HEADINGS."""
    return turned(painted(_bullet, (player,)), turn, HEADINGS, -16)


def _bullet(player: int) -> pygame.Surface:
    ink, color = master(52, -16), PLAYERS[player]
    for i in range(8):
        ink.line([(-44 + 5 * i, 0), (0, 0)], dim(color, 0.12 + 0.11 * i), 3 + i)
    return ink.disc(0, 0, 7, color).disc(1, 0, 4.5, WHITE).lit(1.6)


@cached
def flash(player: int, turn: int) -> Sprite:
    """Muzzle flash, centred on the muzzle, at heading `turn` of TURNS."""
    return turned(painted(_flash, (player,)), turn, TURNS)


def _flash(player: int) -> pygame.Surface:
    star = []
    for i in range(12):
        a, even = i * math.tau / 12, 24 if i % 2 == 0 else 9
        star.append(((46 if i == 0 else even) * math.cos(a), (30 if i == 0 else even) * math.sin(a)))
    ink = master(72).fill(star, PLAYERS[player])
    return ink.fill([(x * 0.6 + 2, y * 0.6) for x, y in star], mix(PLAYERS[player], WHITE, 0.6)).lit(1.5)


@cached
def sparks(color: Color, size: int, turn: int) -> tuple[Sprite, ...]:
    """Fading streak of light in one of SPARK_TURNS directions: the last frame is the brightest."""
    whole = turned(painted(_spark, (color, size)), turn, SPARK_TURNS)
    return *(faded(whole, level / SPARK_LEVELS) for level in range(1, SPARK_LEVELS)), whole


def _spark(color: Color, size: int) -> pygame.Surface:
    ink = master(44)
    for k in (1.0, 0.6, 0.3):
        shade = dim(mix(color, WHITE, 0.5 - 0.5 * k), 1.2 - k)
        ink.line([(-size * 6 * k, 0), (size, 0)], shade, size * (1.1 - 0.5 * k))
    return ink.lit(1.2)


@cached
def shards(shape: int, turn: int) -> tuple[Sprite, ...]:
    """Fading splinter of a wall in one of SPARK_TURNS directions: the last frame is the brightest."""
    whole = turned(painted(_shard, (shape,)), turn, SPARK_TURNS)
    return *(faded(whole, level / SPARK_LEVELS) for level in range(1, SPARK_LEVELS)), whole


def _shard(shape: int) -> pygame.Surface:
    rng = random.Random(shape)
    corners = [
        (x * rng.uniform(0.7, 1.3), y * rng.uniform(0.7, 1.3)) for x, y in regular_polygon(3 + shape % 2, 7 + 2 * shape)
    ]
    return master(40).line(corners, WALL, 3, True).lit(0.8)


@cached
def wave(color: Color, stage: int) -> Sprite:
    """Shock wave, `stage` of WAVE_STEPS: eight arcs that grow, thin out and fade."""
    image, dx, dy = _wave(stage)
    image = image.copy()
    image.fill(color, special_flags=pygame.BLEND_RGB_MULT)
    return Sprite(image, dx, dy)


@cached
def _wave(stage: int) -> Sprite:
    t, half = (stage + 1) / WAVE_STEPS, 172
    r = 30 + 110 * (1 - (1 - t) ** 2)
    ink = GlowCanvas(2 * half, 2 * half).set_transform(half, half, 0.5 * t)
    for i in range(8):
        a = i * math.tau / 8
        ink.arc(0, 0, r, a, a + 0.5 - 0.25 * t, dim(WHITE, (1 - t) ** 0.8), 1 + 9 * (1 - t))
    return trim(ink.lit(1.0), half, half)


@cached
def light(color: Color, level: int) -> Sprite:
    """Light on the ground around a hit, brightness `level` of LIGHT_LEVELS."""
    if level < LIGHT_LEVELS:
        return faded(light(color, LIGHT_LEVELS), level / LIGHT_LEVELS)
    spot = pygame.transform.gaussian_blur(GlowCanvas(45, 45, 1).disc(22, 22, 9, dim(color, 0.55)).plain(), 7)
    return trim(pygame.transform.smoothscale(spot, (360, 360)), 180, 180)


@cached
def shield(player: int, turn: int, r: int = 72) -> Sprite:
    """Shield: a hexagon of radius `r` px, rotated by `turn` / 24 of its symmetry angle."""
    return turned(painted(_shield, (player, r)), turn, 6 * 24)


def _shield(player: int, r: int) -> pygame.Surface:
    ink, color = master(r + 32), mix(PLAYERS[player], WHITE, 0.25)
    ink.fill(regular_polygon(6, r), dim(color, 0.10)).neon(regular_polygon(6, r), color, 4, True)
    for x, y in regular_polygon(6, r):
        ink.line([(x * 0.55, y * 0.55), (x, y)], dim(color, 0.35), 2)
    return ink.lit(1.0)


@cached
def timer_ring(color: Color, left: int, r: int, width: int = LINE) -> Sprite:
    """Timer ring of radius `r` px, `left` of 48, which empties clockwise from the top."""
    half = r + 22
    ink = GlowCanvas(2 * half, 2 * half)
    if left:
        ink.arc(half, half, r, math.tau * (0.75 - left / 48), math.tau * 0.75, color, width)
    return trim(ink.lit(0.8), half, half)


@cached
def magazine(player: int, left: int, size: int, r: int) -> Sprite:
    """The shots of a magazine on an arc of radius `r` px above a robot, `left` of `size` lit."""
    half = r + 22
    ink, pitch, color = GlowCanvas(2 * half, 2 * half), 0.3, PLAYERS[player]
    for i in range(size):
        a = (i - (size - 1) / 2) * pitch
        x, y = half + r * math.sin(a), half - r * math.cos(a)
        ink.disc(x, y, 6.5, color if i < left else dim(color, 0.3))
    return trim(ink.lit(0.8), half, half)
