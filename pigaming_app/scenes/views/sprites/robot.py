"""The robot: a disc on two wheels, white headlights, red tail lights, a turret in the player's shape.

Used in the arena, on the title screen and in the lobby.
"""

import math

import pygame

from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, master, painted, step, trim, turned
from pigaming_app.ui.draw.surface_cache import cached

HALF, ARM = 80, 13  # px: half the extent of a rotated tank, and the offset of its centre
TRIANGLE_BACK = 4  # px by which player 2's turret sits further back


def draw_tank(ink: kit.GlowCanvas, player: int, rim: kit.Color | None = None) -> kit.GlowCanvas:
    """Draw a robot at the origin of `ink`, heading +x, radius 36 px, without its number. `rim`: colour of hull, wheels
    and barrel, if it is not the player's.
    """
    color = rim or kit.PLAYERS[player]
    ink.solid(kit.regular_polygon(64, 37))
    hull = [(34 * math.cos(a / 20), 34 * math.sin(a / 20)) for a in range(-20, 21)]
    ink.neon(hull, color, kit.LINE).neon([(-x, y) for x, y in hull], color, kit.LINE)
    for side in (-1, 1):
        ink.solid(kit.cut_box(-19, side * 33 - 10, 38, 20, 6)).fill(kit.cut_box(-16, side * 33 - 7, 32, 14, 4), color)
        for x in (-8, 0, 8):
            ink.void([(x, side * 33 - 7), (x, side * 33 + 7)], 3, 0.3)
        ink.disc(25, side * 15, 5, kit.WHITE)
        ink.line([(-26, side * 9), (-24, side * 14)], kit.ALARM, kit.THIN)
    barrel = [(10, -9), (46, -9), (46, -14), (61, -14), (61, 14), (46, 14), (46, 9), (10, 9)]
    ink.solid([(x * 1.05, y * 1.3) for x, y in barrel]).fill(barrel, kit.mix(color, kit.WHITE, 0.5)).void(
        [(28, 0), (52, 0)], kit.THIN
    )
    turret = [(x - _back(player), y) for x, y in kit.shape_points(player, 23)]
    return ink.solid([(x * 1.16, y * 1.16) for x, y in turret]).fill(turret, kit.PLAYERS[player])


def robot(
    ink: kit.GlowCanvas, player: int, x: float, y: float, angle: float, scale: float = 1.0, rim: kit.Color | None = None
) -> kit.GlowCanvas:
    """Draw the robot of seat 0..3 at (x, y), heading `angle` rad, with its number upright. `rim`: colour of its team,
    if its ring has that.
    """
    draw_tank(ink.set_transform(x, y, angle, scale), player, rim)
    back, size = _back(player), _number_size(player)
    ink.set_transform(x, y, 0, scale)
    ink.text(str(player + 1), size, -back * math.cos(angle), -back * math.sin(angle), kit.BLACK, "hero", "c")
    return ink.set_transform(0, 0)


@cached
def tank(player: int, turn: int, rim: kit.Color | None = None, scale: float = 1.0) -> Sprite:
    """Robot at heading `turn` of HEADINGS, number upright. Premultiplied alpha: opaque with a glow. `rim`: see
    `draw_tank`; `scale`: of its usual size.
    """
    image, dx, dy = turned(painted(_tank, (player, rim)), turn, HEADINGS, ARM * scale, 0.5 * scale)
    size = round(_number_size(player) * scale)
    angle, back, face = turn * math.tau / HEADINGS, _back(player) * scale, kit.font("hero", size)
    number = face.render(str(player + 1), True, kit.BLACK)
    x = -dx - back * math.cos(angle) - number.get_width() / 2
    y = -dy - back * math.sin(angle) + 0.35 * size - face.get_ascent()
    image.blit(number, (round(x), round(y)))
    return Sprite(image, dx, dy)


@cached
def ghost(player: int, scale: float = 1.0) -> Sprite:
    """Off phase of a blinking robot: a dim ring and its number."""
    half = round(56 * scale)
    ink = kit.GlowCanvas(2 * half, 2 * half).set_transform(half, half, 0, scale)
    ink.solid(kit.regular_polygon(64, 36)).ring(0, 0, 34, kit.dim(kit.PLAYERS[player], 0.55), kit.THIN)
    ink.text(str(player + 1), 34, 0, 0, kit.dim(kit.PLAYERS[player], 0.8), "hero", "c")
    return trim(ink.sprite(0.6), half, half)


@cached
def team_mark(team: int, turn: int, scale: float = 1.0) -> Sprite:
    """Team bars behind a robot at heading `turn` of 48: one for the first team, two for the second."""
    return turned(painted(_team_mark, (team,)), turn, 48, -46 * scale, 0.5 * scale)


def _tank(player: int, rim: kit.Color | None) -> pygame.Surface:
    return draw_tank(master(HALF, ARM), player, rim).sprite(0.9)


def _team_mark(team: int) -> pygame.Surface:
    ink = master(36, -46)
    for middle in ((0.0,), (-0.28, 0.28))[min(team, 1)]:
        half = 0.42 if team == 0 else 0.18
        ink.arc(0, 0, 47, math.pi + middle - half, math.pi + middle + half, kit.ICE, 5)
    return ink.lit(0.7)


def _back(player: int) -> int:
    return TRIANGLE_BACK if player == 1 else 0


def _number_size(player: int) -> int:
    return 29 if player == 1 else 34


def seat_robot(player: int, angle: float, scale: float = 2.1) -> Sprite:
    """Robot of seat 0..3, scaled by `scale` relative to the arena, heading `angle` rad. Blit with PRE."""
    return _seat_robot(player, step(angle, HEADINGS), scale)


@cached
def _seat_robot(player: int, turn: int, scale: float) -> Sprite:
    half = round(84 * scale)
    ink = kit.GlowCanvas(2 * half, 2 * half)
    return trim(robot(ink, player, half, half, turn * math.tau / HEADINGS, scale).sprite(0.9), half, half)
