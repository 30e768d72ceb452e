"""Lines across a track, their signs beside it, and the start boxes, as sprites and on a preview's sheets.

A line is signed with a number: the seat whose start and finish it is, 0 to 3; in party START for the common start and
finish, and CHECKPOINT and more for the others in the order of the way round, lettered A, B, C.
"""

import math
from functools import lru_cache
from typing import NamedTuple

from pigaming_app.games.race.course import Course, CoursePosition, half_width_at, locate, point_at, segment_at
from pigaming_app.games.race.state import LINES, Race
from pigaming_app.sim.world import HEIGHT, ROBOTS, WIDTH
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import run_to_end
from pigaming_app.ui.draw.sprites import Sprite, trim
from pigaming_app.ui.draw.surface_cache import cached

START, CHECKPOINT = ROBOTS, ROBOTS + 1
LETTERS = "ABC"
WIDE_LINE = 24.0  # px from the centre of a line to its rails
NARROW_LINE = 11.0  # the same of a checkpoint
BADGE = 24.0  # px
BESIDE = (34.0, 46.0, 60.0)  # px from the edge to a sign: the first position with enough space is used
GLOW = 0.75


class LineFrame(NamedTuple):
    """Frame of a line: centre (px), unit vectors along and across the course, half the width (px)."""

    x: float
    y: float
    c: float
    s: float
    half: float

    def at(self, ahead: float, right: float) -> kit.Point:
        """Point at an offset from the line's centre, px."""
        return self.x + ahead * self.c - right * self.s, self.y + ahead * self.s + right * self.c


def frame(course: Course, along: float) -> LineFrame:
    """Frame of a line across the course."""
    (ax, ay), (bx, by) = point_at(course, along, -1.0), point_at(course, along, 1.0)
    half = half_width_at(course, *segment_at(course, along))
    return LineFrame((ax + bx) / 2, (ay + by) / 2, (by - ay) / 2, -(bx - ax) / 2, half)


def line_signs(state: Race) -> tuple[int, ...]:
    """The sign of each line in a race."""
    if state.rules.party:
        first = state.racers[0].line
        return tuple(START + (i - first) % LINES for i in range(LINES))
    owners = [0] * LINES
    for seat, racer in enumerate(state.racers):
        owners[racer.line] = seat
    return tuple(owners)


def sign_color(sign: int) -> kit.Color:
    """Colour of the sparks on a line."""
    return kit.PLAYERS[sign] if sign < ROBOTS else kit.FOCUS


def draw_sign(ink: kit.GlowCanvas, sign: int, x: float, y: float, r: float) -> None:
    """Draw a sign, `r` px to each side: a player's badge, a chequered flag, or a letter on a plate."""
    if sign < ROBOTS:
        kit.badge(ink, sign, x, y, r)
    elif sign == START:
        flag(ink, x, y, r * 0.9, kit.ICE)
    else:
        plate = kit.cut_box(x - r * 0.86, y - r * 0.86, r * 1.72, r * 1.72, r * 0.4)
        ink.fill(plate, kit.MIST).line(plate, kit.mix(kit.MIST, kit.WHITE, 0.35), max(2, r * 0.09), True)
        ink.text(LETTERS[sign - CHECKPOINT], round(r * 1.3), x, y, kit.BLACK, "hero", "c")


def draw_signed(glow: kit.GlowCanvas, crisp: kit.GlowCanvas, line: LineFrame, sign: int) -> None:
    """Draw a line on black as its sign requires: in the colour of its seat, white, or as a checkpoint."""
    wide, edge = NARROW_LINE if sign >= CHECKPOINT else WIDE_LINE, line.half - 3
    glow.solid([line.at(a, b) for a, b in ((-wide, -edge), (wide, -edge), (wide, edge), (-wide, edge))])
    if sign >= CHECKPOINT:
        draw_checkpoint(crisp, line)
    else:
        draw_line(glow, crisp, line, kit.ICE if sign == START else kit.PLAYERS[sign])


def draw_line(glow: kit.GlowCanvas, crisp: kit.GlowCanvas, line: LineFrame, color: kit.Color) -> None:
    """Two chequered columns between two bright rails."""
    half = line.half - 3
    crisp.fill([line.at(a, b) for a, b in ((-26, -half), (26, -half), (26, half), (-26, half))], kit.BLACK)
    cells = 2 * round(half / 20)
    size = 2 * half / cells
    for row in range(cells):
        column, side = row % 2 - 1, -half + row * size
        a, b = column * (WIDE_LINE - 5), (column + 1) * (WIDE_LINE - 5)
        cell = [(a, side), (b, side), (b, side + size), (a, side + size)]
        crisp.fill([line.at(*corner) for corner in cell], kit.dim(color, 0.9))
    for rail in (-WIDE_LINE, WIDE_LINE):
        glow.neon([line.at(rail, -half), line.at(rail, half)], color, 5)


def draw_checkpoint(ink: kit.GlowCanvas, line: LineFrame) -> None:
    """A narrow dashed line in a neutral colour."""
    half = line.half - 3
    for rail in (-NARROW_LINE, NARROW_LINE):
        ink.line([line.at(rail, -half), line.at(rail, half)], kit.dim(kit.MIST, 0.5), kit.THIN - 1)
    blocks = 2 * round(half / 26) + 1
    size = 2 * half / blocks
    for i in range(0, blocks, 2):
        a, b = -half + i * size + 3, -half + (i + 1) * size - 3
        ink.fill([line.at(*corner) for corner in ((-4, a), (4, a), (4, b), (-4, b))], kit.dim(kit.MIST, 0.8))


def draw_slot(ink: kit.GlowCanvas, color: kit.Color) -> None:
    """Start box of a robot that stands at the origin of `ink` and heads for +x."""
    for side in (-1, 1):
        ink.line([(-46, side * 26), (-46, side * 46), (8, side * 46)], color, 4)


@cached
def line_sprite(line: LineFrame, sign: int) -> Sprite:
    """A line of a race, anchored at its centre. Blit with PRE."""
    half = math.ceil(line.half) + 40
    glow, crisp = (kit.GlowCanvas(2 * half, 2 * half).set_transform(half - line.x, half - line.y) for _ in range(2))
    draw_signed(glow, crisp, line, sign)
    image = glow.sprite(GLOW)
    run_to_end(crisp.downscale_onto(image))
    return trim(image, half, half)


@cached
def post_sprite(sign: int) -> Sprite:
    """Sign beside the track, as light."""
    ink = kit.GlowCanvas(128, 128).set_transform(64, 64)
    draw_sign(ink, sign, 0, 0, BADGE)
    return trim(ink.lit(GLOW), 64, 64)


@cached
def slot_sprite(seat: int, heading: float, numbered: bool) -> Sprite:
    """Start box of a seat, as light; `numbered`: with its badge behind it, as no line of its own shows it."""
    ink = kit.GlowCanvas(256, 256).set_transform(128, 128, heading)
    draw_slot(ink, kit.dim(kit.PLAYERS[seat], 0.6 if numbered else 0.30))
    image = ink.plain()
    if numbered:
        ink = kit.GlowCanvas(256, 256)
        kit.badge(
            ink, seat, 128 - 72 * math.cos(heading), 128 - 72 * math.sin(heading), 15, kit.dim(kit.PLAYERS[seat], 0.75)
        )
        image.blit(ink.plain(), (0, 0), special_flags=kit.ADD)
    return trim(image, 128, 128)


@lru_cache(maxsize=32)
def sign_post(course: Course, along: float) -> kit.Point:
    """Position of a line's sign: beside the track, on the side with more space."""
    line, place = frame(course, along), CoursePosition()
    best, room = (0.0, 0.0), -1e9
    for out in BESIDE:
        for side in (1, -1):
            x, y = line.at(0.0, side * (line.half + out))
            locate(course, x, y, place)
            free = min(abs(place.aside) - place.half, x, WIDTH - x, y, HEIGHT - y, 44.0)
            if free > room + 1.0:
                best, room = (x, y), free
    return best


def flag(ink: kit.GlowCanvas, x: float, y: float, r: float, color: kit.Color) -> None:
    """Chequered flag on a pole, `r` px to each side."""
    size = 2 * r / 4
    ink.line([(x - r, y - r), (x - r, y + r)], color, max(3, r * 0.2))
    for row in range(3):
        for column in range(4):
            if (row + column) % 2 == 0:
                a, b = x - r + column * size, y - r + row * size
                ink.fill([(a, b), (a + size, b), (a + size, b + size), (a, b + size)], color)
