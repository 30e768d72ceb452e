"""How to play Robot Race, party: slipstream, boost pads, item boxes and oil, and the way back to the track."""

import math

import pygame

from pigaming_app.scenes.views.lessons.animation import add, drive_by
from pigaming_app.scenes.views.lessons.race import WIDE, edge, lit, sheets
from pigaming_app.scenes.views.race.party import sprites as things
from pigaming_app.scenes.views.race.recovery import beam
from pigaming_app.scenes.views.race.sprites import clods
from pigaming_app.scenes.views.race.track import EDGE
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.ui.draw import FOCUS, PLAYERS, WHITE, GlowCanvas, dim, icon
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, step, trim
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import blit_sprite

STRAIGHT = 84.0  # px: half the width of the straight road
CELLS = 12  # of the turbo meter
DRAFT, PASS = 3.0, 1.4  # s: behind the other robot, and past it
GAP, ASIDE = 168.0, 38.0  # px between two robots: one behind the other, and side by side
SLOW, FAST = 170.0, 430.0  # px/s
BOX_AT, OIL_AT, NEAR = -60.0, 40.0, 20.0  # px: where a box lies, where the oil is dropped, and above the middle
TAKE, SPIN = 1.6, 1.2  # s: until the oil is dropped; one turn on it
STRAY, BACK, REST = 1.7, 0.5, 1.4  # s: into the mud, the button, and on the road again


def draft(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot drives behind another until its turbo is full, then passes it."""
    now = seconds % (DRAFT + PASS)
    _road().draw(screen, round(x), round(y - 30))
    full, past = min(1.0, now / DRAFT), max(0.0, now - DRAFT) / PASS
    lead, behind = x + 84 - 60 * past, x + 84 - GAP + 330 * past * past
    down = -30 - ASIDE * min(1.0, 3 * past)
    drive_by(screen, 1, lead, y - 30 + ASIDE * min(1.0, 3 * past), 400)
    if past == 0.0:
        for k, row in enumerate((-34.0, -20.0, 20.0, 34.0)):
            for i in range(4):
                at = lead - 44 - (i * 44 + seconds * 300 + 17 * k) % 170
                add(screen, things.air(things.AIR_TURNS // 2, things.AIR_LEVELS), at, y - 30 + row)
    else:
        add(screen, effects.flame(0, 0, int(seconds * 30) % 2), behind, y + down)
    drive_by(screen, 0, behind, y + down, 400)
    left = full if past == 0.0 else 1.0 - past
    _meter(round(CELLS * left), past == 0.0).draw(screen, round(x), round(y + 130))
    return None


def pads(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot speeds up on a boost pad."""
    _road().draw(screen, round(x), round(y))
    slow = (WIDE + 90.0) / SLOW
    now = seconds % (slow + 0.9)
    way = now * SLOW if now < slow else WIDE + 90.0 + (now - slow) * FAST
    add(screen, things.pad(0, int(seconds * 1.4 * things.PAD_PHASES) % things.PAD_PHASES), x, y)
    if now > slow:
        add(screen, effects.flame(0, 0, int(seconds * 30) % 2), x - WIDE - 90 + way, y)
    drive_by(screen, 0, x - WIDE - 90 + way, y, way)
    return None


def items(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot takes a box and drops oil from it; the one behind spins on it."""
    _road().draw(screen, round(x), round(y))
    speed = 200.0
    now = seconds % (TAKE + SPIN + 1.6)
    first, taken = x - WIDE - 40 + now * speed, now * speed > WIDE + 40 + BOX_AT
    turn = int(seconds * 4) % things.BOX_TURNS
    blit_sprite(screen, things.box_gone() if taken else things.item_box(turn), x + BOX_AT, y - NEAR)
    dropped, slips = now > TAKE, TAKE + 0.9
    if dropped and now < slips:
        blit_sprite(screen, things.oil(0, things.OIL_LEVELS), x + OIL_AT, y - NEAR)
    drive_by(screen, 0, first, y - NEAR, now * speed)
    if taken and not dropped:
        add(screen, _held(), first, y - NEAR - 74)
    at = min(x + OIL_AT, x + OIL_AT - (slips - now) * speed)
    if slips < now < slips + SPIN:
        share = (now - slips) / SPIN
        add(screen, things.swirl(int(seconds * 30) % things.SWIRL_TURNS, 52), at, y - NEAR)
        blit_sprite(screen, tank(1, step(share * math.tau, HEADINGS)), at, y - NEAR)
    else:
        drive_by(screen, 1, at + max(0.0, now - slips - SPIN) * speed, y - NEAR, 200)
    return None


def recover(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot in the mud is put back on the road."""
    edge().draw(screen, round(x), round(y))
    now = seconds % (STRAY + BACK + REST)
    if now < STRAY + BACK:
        way = 110.0 * min(now, STRAY)
        px, py = x - 130 + way, y + 60 + 0.45 * way
        for i in range(6):
            lag = 40.0 + 11.0 * i
            add(screen, clods(3 + 2 * (i % 3))[3], px - lag, py - 0.45 * lag + 26 * math.sin(7.0 * i))
        hidden = now > STRAY + 0.3
        if not hidden:
            blit_sprite(screen, tank(2, step(0.42, HEADINGS)), px, py)
        if now > STRAY:
            add(screen, effects.wave(PLAYERS[2], min(effects.WAVE_STEPS - 1, int((now - STRAY) * 32))), px, py)
        return None
    since = now - STRAY - BACK
    rx = x - 60 + 130 * max(0.0, since - 0.5)
    frames = beam(2)
    if since < 0.5:
        add(screen, frames[int(since / 0.5 * len(frames))], rx, y - 96)
    drive_by(screen, 2, rx, y - 96, 130 * max(0.0, since - 0.5))
    return None


@cached
def _road() -> LitImage:
    glow, crisp = sheets()
    for side in (-1, 1):
        glow.neon([(-WIDE, side * STRAIGHT), (WIDE, side * STRAIGHT)], EDGE, 5)
    return lit(glow, crisp)


@cached
def _meter(cells: int, slip: bool) -> LitImage:
    """A turbo meter with the first cells lit."""
    ink = GlowCanvas(400, 120).set_transform(200, 60)
    for i in range(CELLS):
        x = (i - CELLS / 2) * 27.0
        color = (WHITE if slip else PLAYERS[0]) if i < cells else dim(PLAYERS[0], 0.25)
        ink.fill([(x + 5, -14), (x + 25, -14), (x + 20, 14), (x, 14)], color)
    return LitImage(ink.lit(0.7), (-200, -60))


@cached
def _held() -> Sprite:
    """The item that a robot holds."""
    ink = GlowCanvas(96, 96, 3).set_transform(48, 48)
    return trim(icon(ink, "oil", 0, 0, 22, FOCUS, 5).lit(0.8), 48, 48)
