"""How to play Robot Factory, party: rush orders, loose pallets, pallets left too long, the fast machine."""

import math

import pygame

from pigaming_app.games.factory.state import DELIVERED, DONE, FIRE, HALF, ICE, A, B
from pigaming_app.scenes.views.factory.background import draw_machine, draw_slot
from pigaming_app.scenes.views.lessons.animation import add
from pigaming_app.scenes.views.sprites import factory as crates
from pigaming_app.scenes.views.sprites import factory_signs as signs
from pigaming_app.scenes.views.sprites import pickups as things
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.ui.draw import WALL, GlowCanvas
from pigaming_app.ui.draw.frame_budget import run_to_end
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.sprites import HEADINGS
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import blit_sprite

FORK = 64  # px from a robot to its load
UP, DOWN, RIGHT, LEFT = 3 * HEADINGS // 4, HEADINGS // 4, 0, HEADINGS // 2  # headings
RUSH_WAY, RUSH_SHOW = 2.4, 1.6  # s: drive to the exit, then the points
LOOSE_WAY, LOOSE_SHOW = 1.4, 1.6  # s: both robots approach, then one drives off with the pallet
CLAIM, OPEN, TAKE = 1.8, 0.8, 1.6  # s: the pallet is its owner's, anybody's, and is taken
TURN, RUN = 2.6, 0.9  # s: a machine is the fast one; it works
SLOT = 126  # px from a machine to its slots


def rush(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot takes a rush order to the exit while its time runs out: two points."""
    now = seconds % (RUSH_WAY + RUSH_SHOW)
    slot().draw(screen, round(x), round(y - 130))
    if now < RUSH_WAY:
        py = y + 150 - 216 * ease(now / RUSH_WAY)
        robot(screen, 0, ICE, x, py, UP)
        blit_sprite(screen, crates.crate(ICE, DONE), x, py - FORK)
        part = math.ceil(signs.RUSH_STEPS * (1.0 - 0.8 * now / RUSH_WAY))
        add(screen, signs.rush_ring(part, part <= signs.RUSH_STEPS // 3), x, py - FORK)
        blit_sprite(screen, signs.times_two(), x + 34, py - FORK - 34)
    else:
        blit_sprite(screen, crates.crate(ICE, DELIVERED), x, y - 130)
        robot(screen, 0, ICE, x, y - 66 + 110 * min(1.0, (now - RUSH_WAY) / 0.8), UP)
        blit_sprite(screen, things.popup("+2", 0), x + 104, y - 130)
    return None


def loose(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """Two robots of different teams race for a loose pallet; the one that lifts it keeps it."""
    round_, now = divmod(seconds, LOOSE_WAY + LOOSE_SHOW)
    first = int(round_) % 2
    slot().draw(screen, round(x), round(y))
    near = ease(min(1.0, now / LOOSE_WAY))
    off = ease(max(0.0, now - LOOSE_WAY) / LOOSE_SHOW)
    for team in (ICE, FIRE):
        side, wins = (-1 if team == ICE else 1), team == first
        px = x + side * (150 - (150 - FORK if wins else 40) * near + (80 * off if wins else 0))
        robot(screen, team, team, px, y, RIGHT if team == ICE else LEFT)
        if wins and now >= LOOSE_WAY:
            blit_sprite(screen, crates.crate(team, HALF), px - side * FORK, y)
    if now < LOOSE_WAY:
        blit_sprite(screen, signs.loose_crate(HALF), x, y)
        add(screen, signs.open_to_all(int(seconds * 5) % signs.OPEN_TURNS), x, y)
    return None


def claim(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A pallet in an output belongs to its team until the ring is used up; then a robot of the other team takes it."""
    now = seconds % (CLAIM + OPEN + TAKE)
    machine_y, out = y - 100, y - 100 + SLOT
    machine(B).draw(screen, round(x), round(machine_y))
    taken = now >= CLAIM + OPEN
    py = out + 190 - (190 - FORK) * ease(min(1.0, now / (CLAIM + OPEN)))
    robot(screen, 0, ICE, x, py + 96 * ease(max(0.0, now - CLAIM - OPEN) / TAKE), UP)
    if taken:
        blit_sprite(screen, crates.crate(ICE, DONE), x, out + 96 * ease((now - CLAIM - OPEN) / TAKE))
        return None
    blit_sprite(screen, crates.crate(FIRE, DONE), x, out)
    if now < CLAIM:
        add(screen, signs.claimed(FIRE, math.ceil(signs.CLAIM_STEPS * (1.0 - now / CLAIM))), x, out)
    else:
        add(screen, signs.open_to_all(int(seconds * 5) % signs.OPEN_TURNS), x, out)
    return None


def fast(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """The fast machine works by itself, and the next one takes its turn."""
    turn, now = divmod(seconds, TURN)
    for i, kind in enumerate((A, B)):
        my = y + (-122 if i == 0 else 98)
        machine(kind, sideways=True).draw(screen, round(x), round(my))
        if i != int(turn) % 2:
            continue
        if 0.3 <= now < 0.3 + RUN:
            blit_sprite(screen, crates.busy(ICE, kind), x, my)
            part = int(crates.COUNTS * (now - 0.3) / RUN)
            add(screen, crates.progress(HALF if kind == A else DONE, part), x, my)
        elif now >= 0.3 + RUN:
            blit_sprite(screen, crates.crate(ICE, HALF if kind == A else DONE), x + SLOT, my)
        add(screen, signs.fast(int(seconds * 14) % signs.FAST_STAGES), x, my)
    return None


def robot(screen: pygame.Surface, seat: int, team: int, x: float, y: float, turn: int) -> None:
    """Draw a robot of a team at heading `turn`."""
    add(screen, crates.forks(team, turn), x, y)
    blit_sprite(screen, tank(seat, turn), x, y)


def ease(share: float) -> float:
    """Progress of a motion that starts and stops gently; `share` is clamped to 0..1."""
    share = max(0.0, min(1.0, share))
    return share * share * (3 - 2 * share)


@cached
def slot() -> LitImage:
    """A slot at (0, 0)."""
    ink = GlowCanvas(120, 120).set_transform(60, 60)
    draw_slot(ink, 0, 0, WALL)
    return LitImage(ink.lit(0.3), (-60, -60))


@cached
def machine(kind: int, sideways: bool = False) -> LitImage:
    """A machine at (0, 0) with its output below, or with both slots beside it."""
    half = 230
    glow, crisp = (GlowCanvas(2 * half, 2 * half).set_transform(half, half) for _ in range(2))
    draw_machine((glow, crisp), kind, 0, 0)
    for sx, sy in ((-1, 0), (1, 0)) if sideways else ((0, 1),):
        draw_slot(crisp, sx * SLOT, sy * SLOT, WALL)
    out = glow.lit(0.6)
    run_to_end(crisp.downscale_onto(out))
    return LitImage(out, (-half, -half))
