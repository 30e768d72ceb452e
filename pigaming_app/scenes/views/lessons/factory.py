"""How to play Robot Factory: lift a pallet, machine A, then B, deliver, avoid people."""

import math
from itertools import pairwise

import pygame

from pigaming_app.games.factory.state import DELIVERED, DONE, FIRE, HALF, ICE, RAW, A, B
from pigaming_app.scenes.views.factory.background import draw_lorry, draw_machine, draw_slot
from pigaming_app.scenes.views.lessons.animation import add
from pigaming_app.scenes.views.sprites import factory as crates
from pigaming_app.scenes.views.sprites import pickups as things
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.ui.draw import FOCUS, LINE, MIST, STEEL, THIN, WALL, GlowCanvas, cut_box, dim
from pigaming_app.ui.draw.frame_budget import run_to_end
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.sprites import HEADINGS
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import blit_sprite

SHELF, PITCH, FORK = -128, 88, 64  # px: x of the warehouse, slot pitch, distance from a robot to its load
FAR, NEAR = 116.0, float(SHELF + FORK)  # px: x of a robot's start, and of its stop for lifting and setting down
DRIVE, WAIT, REST = 1.3, 0.7, 1.2  # seconds: drive (one way), stop at the slot, pause off screen
LEFT = HEADINGS // 2  # the heading
MACHINE, SLOT = 105, 126  # px from the middle to a machine, and from a machine to its slots
FEED, PROCESS, CARRY, SHOW = 0.8, 2.4, 1.3, 1.4  # seconds
MEET, FREEZE, WHOLE = 1.1, 3.0, 6.2  # seconds: until the meeting, stop, whole loop


def lift(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot fetches a pallet; the button is pressed while it stops at the slot."""
    share, pressed, after = _there_and_back(seconds)
    for i in range(4):
        if i != 1 or not after:
            blit_sprite(screen, crates.crate(ICE, RAW), x + SHELF, y + (i - 1.5) * PITCH)
    _warehouse().draw(screen, round(x), round(y))
    add(screen, crates.target(FOCUS, False), x + SHELF, y - 0.5 * PITCH)
    _carrier(screen, x + FAR + (NEAR - FAR) * share, y - 0.5 * PITCH, RAW if after else None)
    _button(pressed).draw(screen, round(x + 90), round(y + 104))
    return None


def deliver(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot takes a finished pallet to its team's exit."""
    share, _, after = _there_and_back(seconds)
    for i in range(3 if after else 2):
        blit_sprite(screen, crates.crate(ICE, DELIVERED), x + SHELF, y + (i - 1.5) * PITCH)
    _warehouse().draw(screen, round(x), round(y))
    add(screen, crates.target(FOCUS, False), x + SHELF, y + 0.5 * PITCH)
    _lorry().draw(screen, round(x + 96), round(y - 104))
    _carrier(screen, x + FAR + (NEAR - FAR) * share, y + 0.5 * PITCH, None if after else DONE)
    if after:
        blit_sprite(screen, things.popup("+1", 0), x + SHELF + 92, y + 1.5 * PITCH)
    return None


def work(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A pallet passes through both machines, operated by a person."""
    now = seconds % (2 * (FEED + PROCESS) + CARRY + SHOW)
    _machines().draw(screen, round(x), round(y))
    first = now - FEED
    second = first - PROCESS - CARRY - FEED
    a, b = y - MACHINE, y + MACHINE
    if first < 0.0:
        blit_sprite(screen, crates.crate(ICE, RAW), x - SLOT, a)
    elif first < PROCESS:
        _at_work(screen, x, a, A, first / PROCESS)
    elif first < PROCESS + CARRY:
        px, py = _carried((first - PROCESS) / CARRY)
        blit_sprite(screen, crates.crate(ICE, HALF), x + px, y + py)
    elif second < 0.0:
        blit_sprite(screen, crates.crate(ICE, HALF), x - SLOT, b)
    elif second < PROCESS:
        _at_work(screen, x, b, B, second / PROCESS)
    else:
        blit_sprite(screen, crates.crate(ICE, DONE), x + SLOT, b)
    at_a, at_b = 0.0 <= first < PROCESS, 0.0 <= second < PROCESS
    heading = crates.PERSON_TURNS // 4 if first > PROCESS else 3 * crates.PERSON_TURNS // 4
    stride = int(seconds * 8) % crates.STRIDE if at_a or at_b else 0
    blit_sprite(screen, crates.person(heading, stride, at_a or at_b), x, y)
    return None


def people(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot that drives over a person stops for three seconds; the person walks on."""
    now = seconds % WHOLE
    frozen = 0.0 <= now - MEET < FREEZE
    way = min(now, MEET) + max(0.0, now - MEET - FREEZE)
    px, py = x - 150 + 150 * way, y + 34
    add(screen, crates.forks(FIRE, 0), px, py)
    blit_sprite(screen, tank(1, 0), px, py)
    wx, wy = x + 74, y - 150 + 120 * now
    if wy < y + 190:
        stride = int(seconds * 6) % crates.STRIDE
        blit_sprite(screen, crates.person(crates.PERSON_TURNS // 4, stride, False), wx, wy)
    if frozen:
        left = FREEZE - (now - MEET)
        add(screen, crates.frozen(math.ceil(left / FREEZE * crates.COUNTS), crates.FROZEN), px, py)
        add(screen, crates.digit(math.ceil(left)), px, py - 116)
        if now - MEET < 1.0:
            blit_sprite(screen, crates.exclaim(), wx + 58, wy - 50)
    return None


def _there_and_back(seconds: float) -> tuple[float, bool, bool]:
    """Progress of a robot towards the slot, 0..1; whether the button is down; whether it has been pressed."""
    now = seconds % (2 * DRIVE + WAIT + REST)
    go = min(1.0, now / DRIVE) if now < DRIVE + WAIT else max(0.0, 1.0 - (now - DRIVE - WAIT) / DRIVE)
    since = now - DRIVE - 0.3
    return go * go * (3 - 2 * go), 0.0 <= since < 0.4, since >= 0.0


def _carrier(screen: pygame.Surface, x: float, y: float, state: int | None) -> None:
    """Robot 1 of team ICE, heading left, with its load."""
    add(screen, crates.forks(ICE, LEFT), x, y)
    blit_sprite(screen, tank(0, LEFT), x, y)
    if state is not None:
        blit_sprite(screen, crates.crate(ICE, state), x - FORK, y)


def _at_work(screen: pygame.Surface, x: float, y: float, kind: int, share: float) -> None:
    blit_sprite(screen, crates.busy(ICE, kind), x, y)
    add(screen, crates.progress(HALF if kind == A else DONE, int(share * crates.COUNTS)), x, y)


def _carried(share: float) -> tuple[float, float]:
    """Position of a pallet on its way from machine A to machine B."""
    corners = [(SLOT, -MACHINE), (SLOT, 0), (-SLOT, 0), (-SLOT, MACHINE)]
    way = share * sum(math.dist(a, b) for a, b in pairwise(corners))
    for (ax, ay), (bx, by) in pairwise(corners):
        leg = math.dist((ax, ay), (bx, by))
        if way <= leg:
            return ax + (bx - ax) * way / leg, ay + (by - ay) * way / leg
        way -= leg
    return corners[-1]


@cached
def _warehouse() -> LitImage:
    glow, crisp = GlowCanvas(240, 480).set_transform(120, 240), GlowCanvas(240, 480).set_transform(120, 240)
    box = cut_box(-54, -2 * PITCH - 12, 108, 4 * PITCH + 24, 16)
    glow.neon(box, crates.TEAMS[ICE], LINE, True)
    for i in range(4):
        draw_slot(crisp, 0, (i - 1.5) * PITCH, dim(crates.TEAMS[ICE], 0.6))
    return _lit(glow, crisp, SHELF - 120, -240)


@cached
def _machines() -> LitImage:
    """Both machines with their slots, and the path between them."""
    glow, crisp = GlowCanvas(460, 460).set_transform(230, 230), GlowCanvas(460, 460).set_transform(230, 230)
    for kind, y in ((A, -MACHINE), (B, MACHINE)):
        draw_machine((glow, crisp), kind, 0, y)
        for side in (-1, 1):
            draw_slot(crisp, side * SLOT, y, dim(WALL, 0.7))
            tip = side * 80
            crisp.fill([(tip + 8, y), (tip - 6, y - 13), (tip - 6, y + 13)], WALL)
    crisp.dashes([(SLOT, -58), (SLOT, 0), (-SLOT, 0), (-SLOT, 40)], MIST, THIN, 14, 12, False)
    crisp.fill([(-SLOT, 62), (-SLOT - 14, 40), (-SLOT + 14, 40)], MIST)
    return _lit(glow, crisp, -230, -230)


@cached
def _lorry() -> LitImage:
    ink = GlowCanvas(240, 180).set_transform(120, 90, 0, 1.4)
    draw_lorry(ink, 0, 0, crates.TEAMS[ICE], -1)
    return LitImage(ink.lit(0.8), (-120, -90))


@cached
def _button(pressed: bool) -> LitImage:
    ink = GlowCanvas(140, 140).set_transform(70, 70)
    ink.ring(0, 0, 36, FOCUS if pressed else STEEL, THIN)
    if pressed:
        ink.disc(0, 0, 24, FOCUS)
    else:
        ink.ring(0, 0, 24, MIST, THIN)
    return LitImage(ink.lit(0.8), (-70, -70))


def _lit(glow: GlowCanvas, crisp: GlowCanvas, x: int, y: int) -> LitImage:
    out = glow.lit(0.6)
    run_to_end(crisp.downscale_onto(out))
    return LitImage(out, (x, y))
