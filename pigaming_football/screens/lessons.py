"""How to play Robot Football: push, catch and shoot, pass, and the golden goal."""

import math

import pygame

from pigaming_app.api.look import (
    FOCUS,
    HEADINGS,
    PLAYERS,
    TEAMS,
    GlowCanvas,
    LitImage,
    add,
    blit_sprite,
    cached,
    drive_by,
    effects,
    step,
    tank,
)

from .sprites import PHASES, RADIUS, ball, draw_goal

TOUCH = 58.0  # px between the centres of robot and ball
GOAL, HALF = 125.0, 92.0  # px: the goal's line right of the middle, and half its width


def push(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot pushes the ball over the line."""
    now = seconds % 3.4
    _goal().draw(screen, round(x), round(y))
    robot_x = min(-190.0 + 150.0 * now, GOAL - 40.0)
    ball_x = max(-40.0, robot_x + TOUCH)
    if ball_x > GOAL - 4.0:
        ball_x = min(GOAL + 30.0, GOAL - 4.0 + 200.0 * (now - (GOAL - 4.0 - TOUCH + 190.0) / 150.0))
    drive_by(screen, 0, x + robot_x, y, robot_x + 190.0)
    _ball(screen, x, y, ball_x, 0.0, ball_x / RADIUS, 0.0)
    if ball_x > GOAL:
        _cheer(screen, x + GOAL, y, now - 2.1)
    return None


def shoot(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot catches the ball, charges, aims and shoots."""
    now = seconds % 3.6
    _goal().draw(screen, round(x), round(y))
    left, low = x - 120.0, y + 90.0
    aim = math.atan2(-120.0, GOAL + 120.0)
    charge = min(1.0, max(0.0, (now - 0.6) / 1.0))
    heading = aim * min(1.0, max(0.0, (now - 0.4) / 0.8))
    c, s = math.cos(heading), math.sin(heading)
    far = TOUCH + (max(0.0, 0.6 - now) * 150.0) + max(0.0, now - 2.0) * 620.0
    far = min(far, (GOAL + 150.0) / math.cos(aim))
    bx, by = left + far * c, low + far * s
    if 0.6 <= now < 2.0:
        add(screen, effects.timer_ring(PLAYERS[0], max(3, 3 * math.ceil(16 * charge)), 34), bx, by)
    blit_sprite(screen, tank(0, step(heading, HEADINGS)), left, low)
    blit_sprite(screen, ball(step(heading, 24), step(far / RADIUS, PHASES), False), bx, by)
    if now > 2.5:
        _cheer(screen, x + GOAL, by, now - 2.5)
    return "football.release" if now >= 2.0 else "football.hold" if now >= 0.6 else None


def passes(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A pass past the opponent to the mate, who scores."""
    now = seconds % 4.0
    _goal().draw(screen, round(x), round(y))
    one, mate, rival = (-160.0, 110.0), (20.0, -120.0), (40.0, 84.0)
    to_mate = math.atan2(mate[1] - one[1], mate[0] - one[0])
    to_goal = math.atan2(20.0 - mate[1], GOAL - mate[0])
    turn = min(1.0, max(0.0, (now - 1.5) / 0.7))
    heading = (to_mate + math.pi) * (1.0 - turn) + (to_goal + math.tau * (to_goal < 0.0)) * turn
    if now < 1.5:
        far = TOUCH + min(1.0, max(0.0, (now - 0.5) / 1.0)) * (math.dist(one, mate) - 2.0 * TOUCH)
        bx, by = one[0] + far * math.cos(to_mate), one[1] + far * math.sin(to_mate)
    else:
        far = TOUCH + max(0.0, now - 2.4) * 520.0
        far = min(far, (GOAL + 28.0 - mate[0]) / math.cos(to_goal))
        bx, by = mate[0] + far * math.cos(heading), mate[1] + far * math.sin(heading)
    blit_sprite(screen, tank(0, step(to_mate, HEADINGS)), x + one[0], y + one[1])
    blit_sprite(screen, tank(2, step(heading, HEADINGS)), x + mate[0], y + mate[1])
    blit_sprite(screen, tank(1, step(math.pi, HEADINGS)), x + rival[0], y + rival[1])
    _ball(screen, x, y, bx, by, now * 6.0, heading)
    if now > 2.75:
        _cheer(screen, x + GOAL, y + 10.0, now - 2.75)
    return None


def golden(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """By the party rules a golden ball counts two; level at the end, the next goal wins."""
    now = seconds % 3.0
    _goal().draw(screen, round(x), round(y))
    far = min(GOAL + 30.0, -200.0 + 300.0 * max(0.0, now - 0.3))
    blit_sprite(screen, ball(0, step(far / RADIUS, PHASES), True), x + far, y)
    if far > GOAL:
        _cheer(screen, x + GOAL, y, now - 1.47)
        _two().draw(screen, round(x), round(y - 150.0))
    return None


def _ball(screen: pygame.Surface, x: float, y: float, dx: float, dy: float, rolled: float, way: float) -> None:
    blit_sprite(screen, ball(step(way, 24), step(rolled, PHASES), False), x + dx, y + dy)


def _cheer(screen: pygame.Surface, x: float, y: float, since: float) -> None:
    stage = int(since / 0.45 * effects.WAVE_STEPS)
    if 0 <= stage < effects.WAVE_STEPS:
        add(screen, effects.wave(TEAMS[0], stage), x, y)


@cached
def _goal() -> LitImage:
    ink = GlowCanvas(400, 320).set_transform(200, 160)
    draw_goal(ink, 1, 0.0, 0.0, HALF)
    return LitImage(ink.lit(0.8), (round(GOAL) - 200, -160))


@cached
def _two() -> LitImage:
    ink = GlowCanvas(200, 140).text("+2", 72, 100, 70, FOCUS, "hero", "c")
    return LitImage(ink.lit(0.8), (-100, -70))
