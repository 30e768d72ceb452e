"""Sprites of Robot Football: the rolling ball, its trail, goals, lines of the pitch."""

import math

import pygame

from pigaming_app.api.look import (
    ADD,
    FOCUS,
    HAIR,
    ICE,
    LEFT,
    LINE,
    MIST,
    STEEL,
    TEAMS,
    THIN,
    TOP,
    WHITE,
    Color,
    GlowCanvas,
    Sprite,
    Starts,
    Steps,
    cached,
    dim,
    faded,
    mix,
    painted,
    regular_polygon,
    resumable,
    trim,
    turned,
    walled_floor,
)

RADIUS = 22  # px, of the ball
DIRECTIONS, PHASES = 24, 20  # of the rolling ball
TRAIL = 7  # brightnesses of the trail
DEEP = 62.0  # px, of a goal
CIRCLE, SPOT = 150.0, 9.0  # px, radii
PATCH = 0.36  # rad, angular radius of a patch


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
    color = FOCUS if gold else ICE
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
        ink.fill(patch, dim(STEEL, 0.35))
    return ink.ring(0.0, 0.0, r - 2.0, mix(color, WHITE, 0.3), THIN)


@cached
def ball(turn: int, phase: int, gold: bool) -> Sprite:
    """The ball, rolling in direction `turn` of DIRECTIONS, in position `phase` of PHASES."""
    return turned(painted(_ball, (phase, gold)), turn, DIRECTIONS)


def _ball(phase: int, gold: bool) -> pygame.Surface:
    half = RADIUS + 22
    ink = GlowCanvas(4 * half, 4 * half, 2).set_transform(2 * half, 2 * half, 0.0, 2.0)
    return draw_ball(ink, phase * math.tau / PHASES, gold).sprite(0.8)


@cached
def trail(level: int, gold: bool) -> Sprite:
    """A spot of the trail of a fast ball, as light; `level` 1..TRAIL: the last is the brightest."""
    if level < TRAIL:
        return faded(trail(TRAIL, gold), level / TRAIL)
    ink = GlowCanvas(96, 96).disc(48, 48, RADIUS - 7, dim(FOCUS if gold else ICE, 0.30))
    return trim(ink.lit(0.8), 48, 48)


@cached
def shadow() -> Sprite:
    """The light that the ball throws on the dark floor instead of a shadow."""
    spot = pygame.transform.gaussian_blur(GlowCanvas(64, 64, 1).disc(32, 32, 15, dim(ICE, 0.30)).plain(), 8)
    return trim(pygame.transform.smoothscale(spot, (160, 160)), 80, 80)


@cached
def aim(level: int, color: Color) -> Sprite:
    """A dot of the line along which a held ball will be shot; `level` 1..4."""
    ink = GlowCanvas(64, 64).disc(32, 32, 5, dim(color, 0.2 + 0.2 * level))
    return trim(ink.lit(0.8), 32, 32)


@cached
def kick_off_arrow(right: bool) -> Sprite:
    """A chevron on the side to which the ball will roll."""
    sign = 1.0 if right else -1.0
    ink = GlowCanvas(120, 120).set_transform(60, 60)
    ink.line([(-8 * sign, -20), (12 * sign, 0), (-8 * sign, 20)], TEAMS[int(right)], LINE)
    return trim(ink.lit(0.9), 60, 60)


def draw_goal(
    ink: GlowCanvas, side: int, x: float, y: float, half: float, bold: float = 1.0, inside: bool = False
) -> None:
    """A goal with its net beside the point (x, y) of the rim: side 0 to the left of it, 1 to the right.

    `inside`: on the other side of the rim, where a picture has no room beyond it.
    """
    sign, color = (-1.0 if (side == 0) != inside else 1.0), TEAMS[side]
    deep = DEEP * bold
    for i in range(1, 4):
        ink.line(
            [(x + sign * deep * i / 4, y - half), (x + sign * deep * i / 4, y + half)], dim(color, 0.30), HAIR * bold
        )
    rows = max(2, round(2 * half / (deep / 4)))
    for i in range(1, rows):
        at = y - half + 2 * half * i / rows
        ink.line([(x, at), (x + sign * deep, at)], dim(color, 0.30), HAIR * bold)
    corner = 14.0 * bold
    frame = [
        (x, y - half),
        (x + sign * (deep - corner), y - half),
        (x + sign * deep, y - half + corner),
        (x + sign * deep, y + half - corner),
        (x + sign * (deep - corner), y + half),
        (x, y + half),
    ]
    ink.neon(frame, color, LINE * bold)
    for post in (-1, 1):
        ink.disc(x, y + post * half, 9 * bold, color).disc(x, y + post * half, 5 * bold, WHITE)


def draw_lines(ink: GlowCanvas, x: float, y: float, w: float, h: float, half: float, k: float = 1.0) -> None:
    """Halfway line, centre circle and goal areas of a pitch of w x h px at (x, y), drawn `k` times as thick."""
    cx, cy, color = x + w / 2, y + h / 2, dim(mix(STEEL, MIST, 0.25), 0.75)
    circle, deep, area = CIRCLE * w / 1600, 165 * w / 1600, half + 75 * w / 1600
    for a, b in ((y + 16 * k, cy - circle), (cy + circle, y + h - 16 * k)):
        ink.line([(cx, a), (cx, b)], color, THIN * k)
    ink.line([(cx, cy - circle), (cx, cy + circle)], dim(color, 0.6), HAIR * k)
    ink.ring(cx, cy, circle, color, THIN * k).disc(cx, cy, SPOT * k, color)
    for side, sign in ((0, 1.0), (1, -1.0)):
        at = x if side == 0 else x + w
        box = [(at, cy - area), (at + sign * deep, cy - area), (at + sign * deep, cy + area), (at, cy + area)]
        ink.line(box, dim(mix(TEAMS[side], STEEL, 0.55), 0.7), THIN * k)
        spot = at + sign * deep
        ink.arc(
            spot,
            cy,
            60 * w / 1600,
            *((-math.pi / 2, math.pi / 2) if side == 0 else (math.pi / 2, 3 * math.pi / 2)),
            dim(color, 0.8),
            THIN * k,
        )


MARGIN = 96  # px of the pitch's picture around it


@cached
@resumable
def pitch(starts: Starts, half: float) -> Steps[pygame.Surface]:
    """The floor with all lines and both goals; `half`: half the width of these, px."""
    w, h = 1600, 900
    out = walled_floor(starts).copy()
    yield
    ink = GlowCanvas(w + 2 * MARGIN, h)
    draw_lines(ink, MARGIN, 0, w, h, half)
    draw_goal(ink, 0, MARGIN - 2, h / 2, half)
    draw_goal(ink, 1, MARGIN + w + 2, h / 2, half)
    yield
    out.blit((yield from ink.lit_steps(0.7)), (LEFT - MARGIN, TOP), special_flags=ADD)
    return out
