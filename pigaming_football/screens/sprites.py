"""Sprites of Robot Football: the rolling ball, its trail, goals, lines of the pitch."""

import math

from pigaming_app.api.look import STYLE, GlowCanvas, dim, light_sprite, regular_polygon, turning_sprite
from pigaming_app.api.rules import HEIGHT, WIDTH

Color = tuple[int, int, int]
RADIUS = 22  # px, of the ball
DIRECTIONS, PHASES = 24, 20  # of the rolling ball
DROPS = 8  # sizes of the falling ball
TRAIL = 7  # brightnesses of the trail
DEEP = 62.0  # px, of a goal
CIRCLE, SPOT = 150.0, 9.0  # px, radii
PATCH = 0.36  # rad, angular radius of a patch


def blend(one: Color, other: Color, share: float) -> Color:
    """A colour between two, `share` (0..1) of the way to the other."""
    r, g, b = (round(x + (y - x) * share) for x, y in zip(one, other, strict=True))
    return r, g, b


def _patches() -> tuple[tuple[float, float, float], ...]:
    """Directions of the twelve patches of a ball: the corners of an icosahedron."""
    golden, corners = (1.0 + math.sqrt(5.0)) / 2.0, []
    for a in (-1.0, 1.0):
        for b in (-golden, golden):
            corners += [(0.0, a, b), (a, b, 0.0), (b, 0.0, a)]
    size = math.hypot(1.0, golden)
    return tuple((x / size, y / size, z / size) for x, y, z in corners)


PATCHES = _patches()


def draw_ball(ink: GlowCanvas, phase: float, gold: bool, r: float = RADIUS) -> GlowCanvas:
    """Draw a ball at the origin of `ink` that has rolled by `phase` rad in the direction +x."""
    color = STYLE.focus if gold else STYLE.ice
    ink.solid(regular_polygon(48, r + 4.0)).fill(regular_polygon(48, r), dim(color, 0.78))
    c, s = math.cos(phase), math.sin(phase)
    for x, y, z in PATCHES:
        x, z = c * x + s * z, c * z - s * x
        if z < -0.25:
            continue
        angle, tilt = math.atan2(y, x), math.acos(max(-1.0, min(1.0, z)))
        patch = []
        for i in range(5):
            a = i * math.tau / 5
            along, aside = tilt + PATCH * math.cos(a), PATCH * math.sin(a)
            radial, across = math.sin(min(along, math.pi / 2)), math.sin(aside)
            px = radial * math.cos(angle) - across * math.sin(angle)
            py = radial * math.sin(angle) + across * math.cos(angle)
            far = max(1.0, math.hypot(px, py))
            patch.append((0.93 * r * px / far, 0.93 * r * py / far))
        ink.fill(patch, dim(STYLE.steel, 0.35))
    return ink.ring(0.0, 0.0, r - 2.0, blend(color, STYLE.white, 0.3), STYLE.thin)


@turning_sprite(RADIUS + 22, DIRECTIONS)
def ball(ink: GlowCanvas, phase: int, gold: bool) -> None:
    """The ball, rolling in one of DIRECTIONS, in position `phase` of PHASES."""
    draw_ball(ink, phase * math.tau / PHASES, gold)


@light_sprite(48)
def trail(ink: GlowCanvas, level: int, gold: bool) -> None:
    """A spot of the trail of a fast ball; `level` 1..TRAIL: the last is the brightest."""
    ink.disc(0, 0, RADIUS - 7, dim(STYLE.focus if gold else STYLE.ice, 0.30 * level / TRAIL))


@light_sprite(84, 0.0)
def shadow(ink: GlowCanvas) -> None:
    """The light that the ball throws on the dark floor instead of a shadow."""
    for r in range(80, 0, -2):
        ink.disc(0, 0, r, dim(STYLE.ice, 0.30 * (1.0 - r / 80.0) ** 2))


@light_sprite(32)
def aim(ink: GlowCanvas, level: int, seat: int) -> None:
    """A dot of the line along which a held ball will be shot; `level` 1..4."""
    ink.disc(0, 0, 5, dim(STYLE.players[seat], 0.2 + 0.2 * level))


@light_sprite(320, 0.7)
def team_name(ink: GlowCanvas, word: str, team: int) -> None:
    """The name of a team in its colour."""
    ink.text(word, 120, 0, 0, STYLE.teams[team], "hero", "c")


@turning_sprite(96, 1)
def falling(ink: GlowCanvas, drop: int) -> None:
    """The ball as it falls from above; the last of DROPS lies on the ground."""
    draw_ball(ink, 0.3 * (DROPS - 1 - drop), False, RADIUS * (1.0 + 2.0 * (1.0 - drop / (DROPS - 1))))


@light_sprite(100)
def bracket(ink: GlowCanvas, corner: int) -> None:
    """A corner of the picture of a replay: 0 and 1 above, 0 and 2 on the left."""
    right, down = (1 if corner % 2 == 0 else -1), (1 if corner < 2 else -1)
    ink.line([(70 * right, 0), (0, 0), (0, 70 * down)], STYLE.focus, STYLE.line)


@light_sprite(56)
def ring(ink: GlowCanvas, color: Color, left: int) -> None:
    """A ring round the ball, `left` of 48, which empties clockwise from the top."""
    if left:
        ink.arc(0, 0, 34, math.tau * (0.75 - left / 48), math.tau * 0.75, color, STYLE.line)


@light_sprite(96, 0.9)
def rays(ink: GlowCanvas, team: int) -> None:
    """The glow round a ball that a team holds, and that counts two."""
    for r in range(66, 36, -2):
        ink.disc(0, 0, r, dim(STYLE.teams[team], 0.4 * (1.0 - r / 68.0)))
    for k in range(8):
        turn = math.tau * k / 8
        ends = [(r * math.cos(turn), r * math.sin(turn)) for r in (46, 58)]
        ink.line(ends, STYLE.teams[team], STYLE.line)


@light_sprite(60, 0.9)
def kick_off_arrow(ink: GlowCanvas, right: bool) -> None:
    """A chevron on the side to which the ball will roll."""
    sign = 1.0 if right else -1.0
    ink.line([(-8 * sign, -20), (12 * sign, 0), (-8 * sign, 20)], STYLE.teams[int(right)], STYLE.line)


def draw_goal(
    ink: GlowCanvas, side: int, x: float, y: float, half: float, bold: float = 1.0, inside: bool = False
) -> None:
    """A goal with its net beside the point (x, y) of the rim: side 0 to the left of it, 1 to the right.

    `inside`: on the other side of the rim, where a picture has no room beyond it.
    """
    sign, color = (-1.0 if (side == 0) != inside else 1.0), STYLE.teams[side]
    deep = DEEP * bold
    for i in range(1, 4):
        ink.line(
            [(x + sign * deep * i / 4, y - half), (x + sign * deep * i / 4, y + half)],
            dim(color, 0.30),
            STYLE.hair * bold,
        )
    rows = max(2, round(2 * half / (deep / 4)))
    for i in range(1, rows):
        at = y - half + 2 * half * i / rows
        ink.line([(x, at), (x + sign * deep, at)], dim(color, 0.30), STYLE.hair * bold)
    corner = 14.0 * bold
    frame = [
        (x, y - half),
        (x + sign * (deep - corner), y - half),
        (x + sign * deep, y - half + corner),
        (x + sign * deep, y + half - corner),
        (x + sign * (deep - corner), y + half),
        (x, y + half),
    ]
    ink.neon(frame, color, STYLE.line * bold)
    for post in (-1, 1):
        ink.disc(x, y + post * half, 9 * bold, color).disc(x, y + post * half, 5 * bold, STYLE.white)


def draw_lines(ink: GlowCanvas, x: float, y: float, w: float, h: float, half: float, k: float = 1.0) -> None:
    """Halfway line, centre circle and goal areas of a pitch of w x h px at (x, y), drawn `k` times as thick."""
    cx, cy, color = x + w / 2, y + h / 2, dim(blend(STYLE.steel, STYLE.mist, 0.25), 0.75)
    circle, deep, area = CIRCLE * w / 1600, 165 * w / 1600, half + 75 * w / 1600
    for a, b in ((y + 16 * k, cy - circle), (cy + circle, y + h - 16 * k)):
        ink.line([(cx, a), (cx, b)], color, STYLE.thin * k)
    ink.line([(cx, cy - circle), (cx, cy + circle)], dim(color, 0.6), STYLE.hair * k)
    ink.ring(cx, cy, circle, color, STYLE.thin * k).disc(cx, cy, SPOT * k, color)
    for side, sign in ((0, 1.0), (1, -1.0)):
        at = x if side == 0 else x + w
        box = [(at, cy - area), (at + sign * deep, cy - area), (at + sign * deep, cy + area), (at, cy + area)]
        ink.line(box, dim(blend(STYLE.teams[side], STYLE.steel, 0.55), 0.7), STYLE.thin * k)
        spot = at + sign * deep
        ink.arc(
            spot,
            cy,
            60 * w / 1600,
            *((-math.pi / 2, math.pi / 2) if side == 0 else (math.pi / 2, 3 * math.pi / 2)),
            dim(color, 0.8),
            STYLE.thin * k,
        )


def draw_pitch(ink: GlowCanvas, half: float) -> None:
    """All lines and both goals; `half`: half the width of these, px."""
    draw_lines(ink, 0, 0, WIDTH, HEIGHT, half)
    draw_goal(ink, 0, -2, HEIGHT / 2, half)
    draw_goal(ink, 1, WIDTH + 2, HEIGHT / 2, half)


def phase_of(rolled: float) -> int:
    """The position, of PHASES, of a ball that has rolled by an angle, rad."""
    return round(rolled / math.tau * PHASES) % PHASES
