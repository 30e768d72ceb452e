"""How to play PiTanks by the party rules: the knock-out, the light, the bounty, the end of a match."""

import math

import pygame

from pigaming_app.scenes.views.lessons.animation import add, drive_by
from pigaming_app.scenes.views.pitanks import banner
from pigaming_app.scenes.views.sprites import effects, party
from pigaming_app.scenes.views.sprites import pickups as things
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LINE, PLAYERS, TITLE, GlowCanvas
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.sprites import HEADINGS
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import glyph, number_width
from pigaming_app.ui.widgets.labels import blit_sprite

UP, LEFT = 3 * HEADINGS // 4, HEADINGS // 2  # headings
FLIGHT, OUT, PAUSE = 0.45, 0.8, 1.2  # s: of a shot, of the knock-out, until the next shot
BACK = 72.0  # px, of the knock-out
STAY, LIT, LEAVE = 1.6, 1.8, 1.4  # s: without and with the light, and the way out of it
FROM, SECONDS = 23, 0.3  # the first number of the clock, and s for each


def knockout(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A hit: the victim rolls back with stars round it, and the shooter scores."""
    now = seconds % (FLIGHT + OUT + PAUSE)
    since = now - FLIGHT
    left = max(0.0, 1.0 - since / OUT) if since >= 0.0 else 0.0
    ax, ay, by = x, y + 150.0, y - 70.0
    at = by - (BACK * (1.0 - left * left) if since >= 0.0 else 0.0)
    blit_sprite(screen, tank(0, UP), ax, ay)
    turn = round(left * left * HEADINGS) if since >= 0.0 else 0
    blit_sprite(screen, tank(1, (HEADINGS // 4 + turn) % HEADINGS), x, at)
    if now < 0.06:
        add(screen, effects.flash(0, 3 * effects.TURNS // 4), ax, ay - 70)
    if since < 0.0:
        add(screen, effects.bullet(0, UP), x, ay - 64 - (ay - 64 - by - 40) * now / FLIGHT)
        return None
    if left:
        add(screen, party.stars(int(seconds * 40) % party.STAR_TURNS), x, at)
    stage = int(since / 0.45 * effects.WAVE_STEPS)
    if stage < effects.WAVE_STEPS:
        add(screen, effects.wave(PLAYERS[1], stage), x, by)
    if since < 1.1:
        _rise(screen, "+1", 0, x + 126, by, since)
    return None


def light(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot that stays is lit until it drives out of the circle."""
    now = seconds % (STAY + LIT + LEAVE)
    way = max(0.0, now - STAY - LIT) / LEAVE
    px = x - 60 + 240 * way * way
    if now >= STAY and px - x + 60 < party.STAGE - 36:
        add(screen, party.spotlight(), x - 60, y)
    elif now < STAY:
        add(screen, party.stage(), x - 60, y)
    drive_by(screen, 2, px, y, 240 * way * way)
    if now < STAY:
        left = math.ceil(48 * (1.0 - now / STAY))
        add(screen, effects.timer_ring(FOCUS, left, 40), x - 60, y - 190)
    elif way == 0.0:
        _lamp().draw(screen, round(x - 60), round(y - 190))
    return None


def bounty(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A hit on the robot with the crown scores two."""
    now = seconds % (FLIGHT + OUT + PAUSE)
    since = now - FLIGHT
    left, right = x - 130.0, x + 110.0
    blit_sprite(screen, tank(1, 0), left, y)
    blit_sprite(screen, tank(3, LEFT), right, y)
    blit_sprite(screen, party.bounty(2), right, y + 88)
    if now < 0.06:
        add(screen, effects.flash(1, 0), left + 70, y)
    if since < 0.0:
        add(screen, effects.bullet(1, 0), left + 64 + (right - left - 104) * now / FLIGHT, y)
        return None
    if since < OUT:
        add(screen, party.stars(int(seconds * 40) % party.STAR_TURNS), right, y)
    stage = int(since / 0.45 * effects.WAVE_STEPS)
    if stage < effects.WAVE_STEPS:
        add(screen, effects.wave(PLAYERS[3], stage), right, y)
    if since < 1.1:
        _rise(screen, "+2", 1, right, y - 70, since)
    return None


def finale(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """The clock passes 20 s: from there on hits count double."""
    left = FROM - int(seconds / SECONDS) % (FROM + 1)
    clock = f"0:{left:02}"
    color = ALARM if left <= 10 else ICE
    at = x - number_width(clock, TITLE) / 2
    for char in clock:
        sprite, advance = glyph(char, TITLE, color)
        add(screen, sprite, at, y - 90)
        at += advance
    blit_sprite(screen, things.popup("+2" if left <= 20 else "+1", 0), x, y + 60)
    full = round(banner.ROOM * min(20, left) / 20)
    image = banner.bar(True)
    edge = (image.get_width() - banner.ROOM) // 2
    area = pygame.Rect(0, 0, edge + full, image.get_height())
    screen.blit(image, (x - image.get_width() // 2, y - 20), area, special_flags=pygame.BLEND_RGB_ADD)
    return None


def _rise(screen: pygame.Surface, points: str, player: int, x: float, y: float, since: float) -> None:
    """Rising points, `since` seconds after the hit."""
    level = things.POPUP_LEVELS if since < 0.7 else max(1, round(things.POPUP_LEVELS * (1.1 - since) / 0.4))
    blit_sprite(screen, things.popup(points, player, level), x, y - 60 * (1 - (1 - min(1.0, since / 0.8)) ** 2))


@cached
def _lamp() -> LitImage:
    """An eye: everybody sees it."""
    ink = GlowCanvas(200, 160).set_transform(100, 80)
    lid = [(52 * t / 8, -26 * math.cos(math.pi * t / 16)) for t in range(-8, 9)]
    ink.line([*lid, *[(px, -py) for px, py in reversed(lid)]], FOCUS, LINE, True)
    ink.ring(0, 0, 14, FOCUS, LINE)
    return LitImage(ink.lit(0.9), (-100, -80))
