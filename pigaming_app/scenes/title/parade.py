"""The title's parade: each robot drives in, underlines the name, looks round, drives off, and repeats."""

import math
from itertools import pairwise

import pygame

from pigaming_app.scenes.title.logo import trail_path
from pigaming_app.scenes.views.sprites.robot import seat_robot, tank
from pigaming_app.ui.draw import ADD, LINE, PLAYERS, WHITE, GlowCanvas, Point, mix
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, step
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import blit_sprite

COMING, STAYING, LEAVING = 1.9, 16.0, 1.3  # seconds
STAGGER = 0.22  # seconds between successive robots
SPARK_EVERY, SPARK_SPEED = 4.0, 1500.0  # seconds, px/s: period and speed of the sparks along the lines
LOOK_ANGLES = (0.0, -0.45, 0.0, 0.5, 0.15, -0.3)  # rad, headings of a waiting robot in turn
LOOK_EVERY, LOOK_TURN = 1.7, 0.3  # seconds
FAR = 2080.0  # px along x: off screen


def parade(screen: pygame.Surface, seconds: float) -> None:
    """Draw lines and robots, `seconds` after the title appeared."""
    for player in range(4):
        age = seconds - STAGGER * player
        head, tail = _reach(age, player)
        if head > max(0.0, tail):
            lit = line(player)
            left = max(0, round(tail) - lit.at[0])
            area = (left, 0, round(head) - lit.at[0] - left, lit.image.get_height())
            screen.blit(lit.image, (lit.at[0] + left, lit.at[1]), area, special_flags=ADD)
            _spark(screen, player, age, tail, head)
    for player in range(4):
        age = seconds - STAGGER * player
        head, _ = _reach(age, player)
        if age > 0.0 and head < FAR:
            x, y, heading = _at(player, head)
            blit_sprite(screen, tank(player, step(heading + _look(age, player), HEADINGS)), x, y)


def dot_robot(seconds: float, scale: float) -> Sprite:
    """The robot that dots the i, looking round."""
    return _dot_robot(step(-0.5 + 1.3 * _look(seconds + 0.6, 2), HEADINGS), scale)


@cached
def _dot_robot(turn: int, scale: float) -> Sprite:
    return seat_robot(0, turn * math.tau / HEADINGS, scale)


@cached
@resumable
def line(player: int) -> Steps[LitImage]:
    """The complete line of a robot."""
    path = trail_path(player)
    ys = [y for _, y in path]
    layer = Layer(0, min(ys), 1920, max(ys) - min(ys))
    layer.glow.line(path, PLAYERS[player], LINE)
    yield
    return (yield from layer.render_steps())


@cached
def _light(player: int) -> LitImage:
    ink = GlowCanvas(96, 64)
    for i in range(8):
        ink.line([(16 + 4 * i, 32), (64, 32)], mix(PLAYERS[player], WHITE, 0.1 * i), 4)
    return LitImage(ink.disc(64, 32, 5, WHITE).lit(1.2), (-64, -32))


def _reach(age: float, player: int) -> tuple[float, float]:
    """x of a robot and of the tail of its line, px."""
    stop = trail_path(player)[3][0]
    if age < 0.0:
        return -80.0, -80.0
    age %= COMING + STAYING + LEAVING + 0.7
    if age < COMING:
        return -80.0 + (stop + 80.0) * (1.0 - (1.0 - age / COMING) ** 2.2), -80.0
    age -= COMING + STAYING
    if age < 0.0:
        return stop, -80.0
    gone = age / LEAVING
    return min(FAR, stop + (FAR - stop) * gone**2 * 1.6), -80.0 + (FAR + 80.0) * min(1.0, gone) ** 1.5


def _at(player: int, x: float) -> tuple[float, float, float]:
    """Position and heading on the path at x px."""
    path = trail_path(player)
    for (ax, ay), (bx, by) in pairwise(path):
        if x <= bx:
            return x, ay + (by - ay) * (x - ax) / (bx - ax), _bend(path, x)
    return x, path[-1][1], 0.0


def _bend(path: list[Point], x: float) -> float:
    """The heading, smoothed within 40 px of a corner."""
    return -math.pi / 4 * (_ramp(x - path[1][0]) - _ramp(x - path[2][0]))


def _ramp(x: float) -> float:
    return max(0.0, min(1.0, 0.5 + x / 80.0))


def _look(age: float, player: int) -> float:
    """Rotation of a waiting robot, rad; 0 while it drives."""
    waiting = age % (COMING + STAYING + LEAVING + 0.7) - COMING
    if not 0.0 < waiting < STAYING or age < 0.0:
        return 0.0
    turns, into = divmod(min(waiting, STAYING - LOOK_EVERY * 0.6) + 0.4 * player, LOOK_EVERY)
    ends = waiting > STAYING - LOOK_EVERY
    now = LOOK_ANGLES[(int(turns) * (player + 1)) % len(LOOK_ANGLES)]
    then = 0.0 if ends else LOOK_ANGLES[((int(turns) + 1) * (player + 1)) % len(LOOK_ANGLES)]
    share = max(0.0, min(1.0, (into - LOOK_EVERY + LOOK_TURN) / LOOK_TURN))
    return now + (then - now) * share * share * (3.0 - 2.0 * share)


def _spark(screen: pygame.Surface, player: int, age: float, tail: float, head: float) -> None:
    x = ((age + 1.3 * player) % SPARK_EVERY) * SPARK_SPEED - 80.0
    if tail < x < head - 40.0:
        _, y, heading = _at(player, x)
        if heading == 0.0:
            _light(player).draw(screen, round(x), round(y))
