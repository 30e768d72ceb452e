"""Sprites of Robot Factory: crates, forks, people, and symbols of teams and states.

A crate shows its state by icon and colour, its team by outline and shape (ICE: round corners, FIRE: cut corners), and
delivery by a solid fill.
"""

import math

import pygame

from pigaming_app.games.factory.state import DAMAGED, DELIVERED, DONE, HALF, ICE, RAW, A
from pigaming_app.scenes.views.sprites.teams import TEAMS
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, master, painted, trim, turned
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import signed

STATES: dict[int, kit.Color] = {
    RAW: (255, 84, 76),
    HALF: (84, 236, 120),
    DONE: (104, 176, 255),
    DAMAGED: (172, 164, 152),
    DELIVERED: kit.BLACK,
}
CRATE = 54  # px
PERSON_TURNS, STRIDE = 36, 4  # headings, frames of the walk cycle
SUIT, SKIN, BOOTS, GOLD = (80, 205, 215), (255, 205, 160), (40, 96, 110), (255, 214, 48)
COUNTS = 36  # steps of a progress ring
FROZEN = 54  # px, radius of the ring of a frozen robot that is not real


def state_icon(ink: kit.GlowCanvas, state: int, x: float, y: float, r: float, color: kit.Color) -> None:
    """State icon: raw a disc, half done half a disc, done and delivered a star, damaged a cross."""
    if state == RAW:
        ink.disc(x, y, r, color)
    elif state == HALF:
        ink.ring(x, y, r - 2, color, max(2.0, r * 0.28))
        ink.fill([(x - r * math.sin(i * math.pi / 20), y - r * math.cos(i * math.pi / 20)) for i in range(21)], color)
    elif state == DAMAGED:
        for side in (-1, 1):
            ink.line([(x - r * 0.8, y - side * r * 0.8), (x + r * 0.8, y + side * r * 0.8)], color, r * 0.4)
    else:
        ink.fill(kit.star_points(r * 1.2, x, y), color)


def outline(team: int, x: float, y: float, half: float) -> kit.Points:
    """Shape of a team's crate, `half` px to each side of (x, y)."""
    corner = half * 0.52
    if team != ICE:
        return kit.cut_box(x - half, y - half, 2 * half, 2 * half, corner)
    points = []
    for i in range(4):
        sx, sy = ((1, 1), (-1, 1), (-1, -1), (1, -1))[i]
        for k in range(6):
            a = (i + k / 5) * math.pi / 2
            points.append(
                (x + sx * (half - corner) + corner * math.cos(a), y + sy * (half - corner) + corner * math.sin(a))
            )
    return points


def draw_crate(ink: kit.GlowCanvas, team: int, state: int, x: float, y: float, size: float = CRATE) -> None:
    """Draw a crate centred on (x, y)."""
    color, half = TEAMS[team], size / 2 - 3
    shape = outline(team, x, y, half)
    ink.solid(shape)
    if state == DELIVERED:
        ink.fill(shape, color)
        ink.line(shape, color, 5, True)
        ink.fill(kit.star_points(size * 0.34, x, y), kit.BLACK)
        return
    edge = kit.dim(color, 0.45) if state == DAMAGED else color
    ink.fill(shape, kit.dim(edge, 0.10)).line(shape, edge, 5, True)
    state_icon(ink, state, x, y, size * 0.27, STATES[state])


@cached
def crate(team: int, state: int, tenths: int = 10) -> Sprite:
    """Opaque crate of a team in a state, scaled to `tenths` / 10."""
    size = CRATE * tenths / 10
    ink = kit.GlowCanvas(120, 120, 3).set_transform(60, 60)
    draw_crate(ink, team, state, 0, 0, size)
    return trim(ink.sprite(0.6), 60, 60)


@cached
def forks(team: int, turn: int, scale: float = 1.0) -> Sprite:
    """Opaque forks of a robot at heading `turn` of HEADINGS, with the team's ring, open at the front. Drawn below the
    robot and its load.
    """
    return turned(painted(_forks, (team,)), turn, HEADINGS, 24 * scale, 0.5 * scale)


def _forks(team: int) -> pygame.Surface:
    ink = master(76, 24)
    for side in (-20, 20):
        ink.solid(kit.cut_box(26, side - 7, 69, 14, 5)).line([(30, side), (90, side)], TEAMS[team], 8)
    ink.arc(0, 0, 45, 0.66, math.tau - 0.66, TEAMS[team], kit.LINE)
    return ink.sprite(0.5)


@cached
def person(turn: int, stride: int, working: bool) -> Sprite:
    """Worker from above at heading `turn` of PERSON_TURNS: yellow helmet, swinging or working hands."""
    return turned(painted(_person, (stride, working)), turn, PERSON_TURNS)


def _person(stride: int, working: bool) -> pygame.Surface:
    ink, swing = master(48), 8 * math.sin(stride * math.tau / STRIDE)
    ink.solid(kit.regular_polygon(32, 26))
    for side in (-1, 1):
        if working:
            hand = (27 + 0.4 * swing * side, 9 * side)
            ink.line([(2, 20 * side), hand], SUIT, 10).disc(*hand, 6.5, SKIN)
        else:
            ink.line([(0, 9 * side), (-swing * side * 1.5, 9 * side)], BOOTS, 12)
            ink.line([(0, 22 * side), (swing * side + 2, 24 * side)], SUIT, 10)
            ink.disc(swing * side + 8, 24 * side, 6.5, SKIN)
    ink.line([(-2, -17), (-2, 17)], SUIT, 20)
    for side in (-1, 1):
        ink.line([(-11, 12 * side), (7, 12 * side)], (255, 240, 120), 4)
    ink.disc(3, 0, 15, SKIN)
    for side in (-1, 1):
        ink.disc(13, 5.5 * side, 2.8, (30, 20, 10))
    ink.disc(-3, 0, 15.5, GOLD).arc(4.5, 0, 9, -1.3, 1.3, (255, 176, 20), 5)
    ink.line([(-14, 0), (3, 0)], (255, 246, 200), 4)
    return ink.sprite(0.5)


@cached
def progress(state: int, part: int) -> Sprite:
    """Progress ring of a machine, `part` of COUNTS, in the colour of its product."""
    ink = kit.GlowCanvas(150, 150).set_transform(75, 75)
    if part:
        ink.arc(0, 0, 44, -math.pi / 2, -math.pi / 2 + math.tau * part / COUNTS, STATES[state], 10)
    return trim(ink.lit(0.9), 75, 75)


@cached
def busy(team: int, kind: int) -> Sprite:
    """Machine of a kind in use: it shows the team's outline."""
    ink, body = kit.GlowCanvas(230, 230).set_transform(115, 115), kit.cut_box(-66, -66, 132, 132, 20)
    ink.solid(kit.cut_box(-69, -69, 138, 138, 21)).fill(body, kit.dim(TEAMS[team], 0.10)).line(
        body, TEAMS[team], 8, True
    )
    ink.ring(0, 0, 44, kit.dim(TEAMS[team], 0.26), 10)
    ink.text("A" if kind == A else "B", 62, 0, 0, kit.WHITE, "hero", "c")
    return trim(ink.sprite(0.8), 115, 115)


@cached
def frozen(part: int, r: int) -> Sprite:
    """Timer ring of a frozen robot, radius `r` px, `part` of COUNTS left."""
    half = r + 31
    ink = kit.GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    ink.ring(0, 0, r, kit.dim(kit.ALARM, 0.3), 8)
    if part:
        ink.arc(0, 0, r, -math.pi / 2, -math.pi / 2 + math.tau * part / COUNTS, kit.ALARM, 8)
    return trim(ink.lit(0.9), half, half)


@cached
def awaited(seconds: int) -> Sprite:
    """Marker and countdown for the next pallet."""
    ink = kit.GlowCanvas(110, 110, 3).set_transform(55, 55)
    ink.dashes(kit.regular_polygon(40, 27), kit.dim(STATES[RAW], 0.85), kit.THIN, 8, 8)
    ink.text(str(seconds), 40, 0, 0, kit.WHITE, "hero", "c")
    return trim(ink.lit(0.5), 55, 55)


@cached
def exclaim() -> Sprite:
    """Exclamation mark."""
    ink = kit.GlowCanvas(120, 130, 3).set_transform(60, 60)
    ink.solid(kit.cut_box(-30, -30, 60, 56, 10)).fill([(-10, 24), (10, 24), (-12, 44)], kit.ALARM)
    ink.line(kit.cut_box(-30, -30, 60, 56, 10), kit.ALARM, 5, True).line([(0, -18), (0, 2)], kit.WHITE, 8).disc(
        0, 15, 5, kit.WHITE
    )
    return trim(ink.sprite(0.7), 60, 60)


@cached
def cross() -> Sprite:
    """Refusal cross."""
    ink = kit.GlowCanvas(110, 110, 3).set_transform(55, 55)
    ink.solid(kit.regular_polygon(32, 30)).ring(0, 0, 27, kit.ALARM, 5)
    for side in (-1, 1):
        ink.line([(-11, -11 * side), (11, 11 * side)], kit.ALARM, 8)
    return trim(ink.sprite(0.8), 55, 55)


@cached
def digit(number: int) -> Sprite:
    """Large countdown digit over a frozen robot."""
    ink = kit.GlowCanvas(130, 140, 3).set_transform(65, 70)
    ink.solid(kit.regular_polygon(8, 40, math.pi / 8)).text(str(number), 76, 0, 0, kit.WHITE, "hero", "c")
    return trim(ink.sprite(0.6), 65, 70)


@cached
def target(color: kit.Color, small: bool) -> Sprite:
    """Corners around a targeted slot."""
    half, reach, width = (38, 12, 4) if small else (44, 22, 7)
    ink = kit.GlowCanvas(150, 150, 3).set_transform(75, 75)
    for sx in (-1, 1):
        for sy in (-1, 1):
            corner = [(sx * half, sy * (half - reach)), (sx * half, sy * half), (sx * (half - reach), sy * half)]
            ink.line(corner, color, width)
    return trim(ink.lit(0.7), 75, 75)


@cached
def arrow(color: kit.Color, turn: int) -> Sprite:
    """Head of a dashed arrow at heading `turn` of HEADINGS."""
    return turned(painted(_arrow, (color,)), turn, HEADINGS)


def _arrow(color: kit.Color) -> pygame.Surface:
    return master(32).fill([(20, 0), (-12, -19), (-12, 19)], color).lit(0.7)


@cached
def dash(color: kit.Color, turn: int) -> Sprite:
    """Dash of an arrow at heading `turn` of HEADINGS."""
    return turned(painted(_dash, (color,)), turn, HEADINGS)


def _dash(color: kit.Color) -> pygame.Surface:
    return master(24).line([(-8, 0), (8, 0)], color, 7).lit(0.6)


@cached
def count(number: int, team: int) -> Sprite:
    """Number of further pallets beside a warehouse."""
    ink = kit.GlowCanvas(160, 80, 3).set_transform(80, 40)
    ink.text(signed(number), 40, 0, 0, TEAMS[team], "hero", "c")
    return trim(ink.lit(0.5), 80, 40)
