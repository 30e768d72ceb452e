"""Sprites of PiTanks by the party rules: stars of a knock-out, the spotlight, the bounty."""

import math

import pygame

from pigaming_app.games.pitanks.state import PiTanksRules
from pigaming_app.sim.world import RADIUS
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.sprites import Sprite, master, painted, trim, turned
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import signed

STARS, STAR_TURNS = 5, 8  # stars round a robot; rotation steps from one star to the next
STAR_R = 58  # px from a robot to its stars
STAGE = round(PiTanksRules().camp_radius + RADIUS)  # px: a lit robot that drives out of the light is free of it
LAMP = (255, 232, 170)


@cached
def stars(turn: int, r: int = STAR_R) -> Sprite:
    """Stars on a circle of `r` px, rotated by `turn` of STAR_TURNS."""
    return turned(painted(_stars, (r,)), turn, STARS * STAR_TURNS)


def _stars(r: int) -> pygame.Surface:
    ink = master(r + 32)
    for i in range(STARS):
        a = i * math.tau / STARS
        shape = kit.star_points(14, r * math.cos(a), r * math.sin(a), a)
        ink.fill(shape, kit.FOCUS).line(shape, kit.mix(kit.FOCUS, kit.WHITE, 0.6), 2, True)
    return ink.lit(1.0)


@cached
def spotlight() -> Sprite:
    """Light from above on the circle that a robot has not left, additive."""
    half = STAGE + 40
    ink = kit.GlowCanvas(half, half, 1)
    for i in range(12):
        ink.disc(half / 2, half / 2, STAGE / 2 * (1.0 - i / 14), kit.dim(LAMP, 0.10 + 0.045 * i))
    pool = pygame.transform.smoothscale(pygame.transform.gaussian_blur(ink.plain(), 4), (2 * half, 2 * half))
    rim = kit.GlowCanvas(2 * half, 2 * half).ring(half, half, STAGE, LAMP, kit.LINE).lit(1.0)
    pool.blit(rim, (0, 0), special_flags=pygame.BLEND_RGB_ADD)
    return trim(pool, half, half)


@cached
def stage() -> Sprite:
    """The edge of that circle, dashed, shortly before the light comes on."""
    half = STAGE + 24
    ink = kit.GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    for i in range(16):
        a = i * math.tau / 16
        ink.arc(0, 0, STAGE, a, a + 0.2, kit.dim(LAMP, 0.7), kit.THIN)
    return trim(ink.lit(0.6), half, half)


@cached
def bounty(points: int) -> Sprite:
    """A crown and the points that a hit on this robot scores, on black."""
    text = signed(points)
    w = round(kit.text_width(text, kit.LABEL, "hero")) + 74
    ink = kit.GlowCanvas(w + 48, 112).set_transform(w / 2 + 24, 56)
    box = kit.cut_box(-w / 2, -28, w, 56, 12)
    ink.solid(box).line(box, kit.FOCUS, kit.THIN, True)
    kit.icon(ink, "crown", -w / 2 + 34, 2, 20, kit.FOCUS, kit.THIN)
    ink.text(text, kit.LABEL, -w / 2 + 60, 0, kit.FOCUS, "hero", "l")
    return trim(ink.sprite(0.6), w / 2 + 24, 56)
