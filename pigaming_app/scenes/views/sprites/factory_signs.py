"""Sprites with which Robot Factory announces: deliveries, countdowns at machines, the tasks of AI team mates."""

import math
from itertools import pairwise

from pigaming_app.games.factory.state import FIRE, ICE
from pigaming_app.scenes.views.sprites.factory import COUNTS, CRATE, STATES, outline, state_icon
from pigaming_app.scenes.views.sprites.pickups import edged
from pigaming_app.scenes.views.sprites.teams import TEAMS
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.sprites import Sprite, faded, trim
from pigaming_app.ui.draw.surface_cache import cached

SHOUT = 60  # px, size of a shouted word
POPS, LEVELS = 3, 4  # cached sizes and brightnesses of a shouted word
OPEN_TURNS, FAST_STAGES = 8, 6  # cached stages of two animations
CLAIM_STEPS, RUSH_STEPS = 16, 24  # of two rings
RING, OPEN_RING = 56, 44  # px, radii of the rings around a slot: time left, and whose its pallet is


@cached
def shout(text: str, color: kit.Color, pop: int, level: int) -> Sprite:
    """A shouted word, larger for a smaller `pop` (0..POPS - 1), at `level` of LEVELS."""
    if level < LEVELS:
        return faded(shout(text, color, pop, LEVELS), level / LEVELS)
    return edged(text, round(SHOUT * (1.0 + 0.5 * (1.0 - (pop + 1) / POPS))), color)


@cached
def time_left(part: int, urgent: bool) -> Sprite:
    """Ring of the time left around a slot, `part` of COUNTS."""
    half = RING + 30
    color = kit.ALARM if urgent else kit.FOCUS
    ink = kit.GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    ink.ring(0, 0, RING, kit.dim(color, 0.22), 7)
    if part:
        ink.arc(0, 0, RING, -math.pi / 2, -math.pi / 2 + math.tau * part / COUNTS, color, 7)
    return trim(ink.lit(0.8), half, half)


@cached
def seconds_left(number: int) -> Sprite:
    """Plate with the last seconds of a countdown at a machine."""
    ink = kit.GlowCanvas(120, 120, 3).set_transform(60, 60)
    plate = kit.regular_polygon(8, 30, math.pi / 8)
    ink.solid(kit.regular_polygon(8, 33, math.pi / 8)).line(plate, kit.ALARM, 4, True)
    ink.text(str(number), 44, 0, 0, kit.WHITE, "hero", "c")
    return trim(ink.sprite(0.7), 60, 60)


@cached
def stuck(bright: bool) -> Sprite:
    """Outline of a jammed machine; blinks with `bright`."""
    ink, color = kit.GlowCanvas(240, 240).set_transform(120, 120), kit.ALARM if bright else kit.dim(kit.ALARM, 0.4)
    ink.line(kit.cut_box(-74, -74, 148, 148, 22), color, kit.LINE, True)
    return trim(ink.lit(0.9), 120, 120)


@cached
def jam() -> Sprite:
    """Warning sign at a corner of a jammed machine."""
    ink = kit.GlowCanvas(120, 120, 3).set_transform(60, 60)
    ink.solid(kit.regular_polygon(3, 44, -math.pi / 2)).line(
        kit.regular_polygon(3, 34, -math.pi / 2), kit.ALARM, 5, True
    )
    ink.line([(0, -12), (0, 3)], kit.WHITE, 6).disc(0, 11, 3.6, kit.WHITE)
    return trim(ink.sprite(0.7), 60, 60)


@cached
def task(seat: int, lifts: bool) -> Sprite:
    """Task of an AI team mate: the player's shape with an arrow, up to lift a pallet, down to set one down."""
    color = kit.PLAYERS[seat]
    ink = kit.GlowCanvas(130, 130, 3).set_transform(65, 65)
    shape = [(y, -x) for x, y in kit.shape_points(seat, 27)]
    ink.solid([(1.2 * x, 1.2 * y) for x, y in shape]).line(shape, color, kit.THIN, True)
    way, tone = (-1 if lifts else 1), kit.mix(color, kit.WHITE, 0.5)
    ink.line([(0, -11 * way), (0, 9 * way)], tone, 5).line([(-9, 2 * way), (0, 11 * way), (9, 2 * way)], tone, 5)
    return trim(ink.sprite(0.7), 65, 65)


@cached
def dot(color: kit.Color) -> Sprite:
    """Dot of the thin line to a task."""
    return trim(kit.GlowCanvas(40, 40, 3).disc(20, 20, 4, color).lit(0.6), 20, 20)


# ---- party


@cached
def loose_crate(state: int, tenths: int = 10) -> Sprite:
    """Opaque crate that either team may take: one half of its outline is ICE's, the other FIRE's."""
    size = CRATE * tenths / 10
    ink = kit.GlowCanvas(120, 120, 3).set_transform(60, 60)
    draw_loose_crate(ink, state, 0, 0, size)
    return trim(ink.sprite(0.6), 60, 60)


def draw_loose_crate(ink: kit.GlowCanvas, state: int, x: float, y: float, size: float = CRATE) -> None:
    """Draw a loose crate centred on (x, y)."""
    half = size / 2 - 3
    left = [p for p in outline(ICE, x, y, half) if p[0] < x]
    left.sort(key=lambda p: math.atan2(p[1] - y, x - p[0]))
    corner = half * 0.52
    right = [(x, y - half), (x + half - corner, y - half), (x + half, y - half + corner)]
    right += [(px, 2 * y - py) for px, py in reversed(right)]
    ink.solid([*right, *reversed(left)])
    ink.line([(x, y - half), *left, (x, y + half)], TEAMS[ICE], 5).line(right, TEAMS[FIRE], 5)
    state_icon(ink, state, x, y, size * 0.27, STATES[state])


@cached
def open_to_all(turn: int) -> Sprite:
    """Ring of both teams' colours around a pallet that either may take, at `turn` of OPEN_TURNS."""
    half, dash = OPEN_RING + 30, math.tau / 12
    ink = kit.GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    for i in range(12):
        start = (i + 0.12 + 2 * turn / OPEN_TURNS) * dash
        ink.arc(0, 0, OPEN_RING, start, start + 0.66 * dash, TEAMS[i % 2], 6)
    return trim(ink.lit(0.8), half, half)


@cached
def claimed(team: int, part: int) -> Sprite:
    """Ring of the time for which a pallet is its owner's, `part` of CLAIM_STEPS."""
    half = OPEN_RING + 30
    ink = kit.GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    ink.ring(0, 0, OPEN_RING, kit.dim(TEAMS[team], 0.18), 5)
    ink.arc(0, 0, OPEN_RING, -math.pi / 2, -math.pi / 2 + math.tau * part / CLAIM_STEPS, TEAMS[team], 5)
    return trim(ink.lit(0.7), half, half)


@cached
def rush_ring(part: int, urgent: bool) -> Sprite:
    """Time left of a rush order, a square ring around its crate, `part` of RUSH_STEPS."""
    half, color = 34.0, kit.ALARM if urgent else kit.FOCUS
    ink = kit.GlowCanvas(150, 150).set_transform(75, 75)
    way = [(0.0, -half), (half, -half), (half, half), (-half, half), (-half, -half), (0.0, -half)]
    ink.line(way, kit.dim(color, 0.22), 6).line(along(way, part / RUSH_STEPS), color, 6)
    return trim(ink.lit(0.9), 75, 75)


@cached
def times_two() -> Sprite:
    """Plate on a rush order: it is worth double."""
    ink = kit.GlowCanvas(110, 80, 3).set_transform(55, 40)
    ink.solid(kit.cut_box(-29, -20, 58, 40, 10)).fill(kit.cut_box(-26, -17, 52, 34, 8), kit.FOCUS)
    ink.text("×2", 32, 0, 0, kit.BLACK, "hero", "c")
    return trim(ink.sprite(0.5), 55, 40)


def along(points: list[kit.Point], share: float) -> list[kit.Point]:
    """The first part of a polyline, `share` (0..1) of its length."""
    left = share * sum(math.dist(a, b) for a, b in pairwise(points))
    part = [points[0]]
    for a, b in pairwise(points):
        way = math.dist(a, b)
        if left < way:
            t = left / way
            return [*part, (a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t)]
        part.append(b)
        left -= way
    return part


@cached
def fast(stage: int) -> Sprite:
    """Outline of the fast machine with running chevrons, at `stage` of FAST_STAGES."""
    ink = kit.GlowCanvas(280, 280).set_transform(140, 140)
    ink.line(kit.cut_box(-77, -77, 154, 154, 24), kit.FOCUS, kit.LINE, True)
    for side in range(4):
        c, s = math.cos(side * math.pi / 2), math.sin(side * math.pi / 2)
        for i in (-1, 0, 1):
            u = 26.0 * i + 26.0 * stage / FAST_STAGES - 13.0
            tip = [(u - 6, -100.0), (u + 5, -91.0), (u - 6, -82.0)]
            level = 1.0 - abs(u) / 52.0
            ink.line([(c * x - s * y, s * x + c * y) for x, y in tip], kit.dim(kit.FOCUS, level), 5)
    return trim(ink.lit(0.9), 140, 140)


@cached
def next_fast() -> Sprite:
    """Dim corners of the machine that is the fast one next."""
    ink = kit.GlowCanvas(240, 240).set_transform(120, 120)
    ink.dashes(kit.cut_box(-77, -77, 154, 154, 24), kit.dim(kit.FOCUS, 0.55), kit.THIN, 16, 18)
    return trim(ink.lit(0.6), 120, 120)
