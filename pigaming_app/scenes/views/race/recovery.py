"""Back to the track: a beam where a simulated robot is put, and a dotted way on the floor for a real one."""

import math

import pygame

from pigaming_app.games.race.state import Race
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.race import sprites as race_signs
from pigaming_app.scenes.views.view import Pose
from pigaming_app.ui.draw import PLAYERS, THIN, WHITE, GlowCanvas, dim, mix, regular_polygon
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, Sprite, faded, master, painted, put, step, trim, turned
from pigaming_app.ui.draw.surface_cache import cached

PITCH, MARCH = 30.0, 60.0  # px between dots, px/s of their motion
CLEAR = 96.0  # px from a robot to the first dot
BEAM_LEVELS, BEAM_LASTS = 6, 0.5  # s
HIGH = 230.0  # px, of the beam


def draw_way_back(over: Batch, seat: int, pose: Pose, target: Pose, clock: float) -> None:
    """Draw moving dots from a real robot to a dashed outline with the heading that it takes there; canvas px."""
    x, y, _ = pose
    length, turn = math.dist(pose[:2], target[:2]), math.atan2(target[1] - y, target[0] - x)
    c, s = math.cos(turn), math.sin(turn)
    at = CLEAR + clock * MARCH % PITCH
    while at < length - 70.0:
        put(over, way_dot(seat), x + at * c, y + at * s)
        at += PITCH
    if length > CLEAR + 60.0:
        put(over, race_signs.tip(seat, step(turn, HEADINGS)), x + (length - 66.0) * c, y + (length - 66.0) * s)
    put(over, outline(seat, step(target[2], HEADINGS)), target[0], target[1])


def target_of(state: Race, seat: int) -> Pose:
    """Requested pose of a robot, canvas px."""
    robot = state.robots[seat]
    return LEFT + robot.recover_x, TOP + robot.recover_y, robot.recover_heading


@cached
def way_dot(seat: int) -> Sprite:
    """Dot of the way back."""
    ink = GlowCanvas(56, 56).set_transform(28, 28).solid(regular_polygon(20, 12))
    return trim(ink.disc(0, 0, 8, PLAYERS[seat]).sprite(0.8), 28, 28)


@cached
def outline(seat: int, turn: int) -> Sprite:
    """Dashed outline of a robot at heading `turn` of HEADINGS."""
    return turned(painted(_outline, (seat,)), turn, HEADINGS)


def _outline(seat: int) -> pygame.Surface:
    ink, color = master(80), PLAYERS[seat]
    ink.dashes(regular_polygon(72, 46), color, 5, 15, 9)
    return ink.fill([(70, 0), (54, 14), (54, -14)], color).sprite(0.7)


@cached
def beam(seat: int) -> tuple[Sprite, ...]:
    """Fading beam of light down to a robot, the brightest first."""
    ink = GlowCanvas(200, 360, 1).set_transform(100, 290)
    color = PLAYERS[seat]
    for i in range(12):
        half, share = 36.0 - 2.6 * i, (i + 1) / 12
        shape = [(-half, 0), (-0.55 * half, -HIGH), (0.55 * half, -HIGH), (half, 0)]
        ink.fill(shape, dim(mix(color, WHITE, 0.5 * share), 0.16 + 0.5 * share * share))
    soft = pygame.transform.gaussian_blur(ink.plain(), 7)
    fade = pygame.Surface(soft.get_size())
    for y in range(360):
        shade = round(255 * min(1.0, max(0.0, (y - 40) / 220)))
        pygame.draw.line(fade, (shade, shade, shade), (0, y), (200, y))
    soft.blit(fade, (0, 0), special_flags=pygame.BLEND_RGB_MULT)
    ring = GlowCanvas(200, 360).set_transform(100, 290).ring(0, 0, 50, mix(color, WHITE, 0.4), THIN).lit(0.9)
    soft.blit(ring, (0, 0), special_flags=pygame.BLEND_RGB_ADD)
    whole = trim(soft, 100, 290)
    return whole, *(faded(whole, level / BEAM_LEVELS) for level in range(BEAM_LEVELS - 1, 0, -1))
