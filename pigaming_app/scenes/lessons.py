"""The moving pictures of "how to play": each paints itself round a point for a moment of time, and repeats for ever.

They are made of the very sprites that the game itself shows. A picture may answer the key of a word to put under it.
"""

import math
from collections.abc import Callable
from functools import cache

import pygame

from pigaming_app.games.pitanks.state import POWERS
from pigaming_app.scenes import effects, things
from pigaming_app.scenes.ink import ADD, FOCUS, HAIR, ICE, LINE, MIST, PLAYERS, STEEL, THIN, Ink, Point, cut, icon
from pigaming_app.scenes.page import stamp
from pigaming_app.scenes.pane import Lit
from pigaming_app.scenes.sprites import HEADINGS, Sprite, step
from pigaming_app.scenes.tank import tank
from pigaming_app.scenes.wall import wall

Picture = Callable[[pygame.Surface, float, float, float], str | None]

LOOP_W, LOOP_H, BEND, SPEED = 236.0, 300.0, 78.0, 190.0  # px, px/s of the lap in the first picture
TREADS, TREAD_GAP = 16, 18.0  # marks behind the robot, and px between them
DUEL, FLIGHT = 2.0, 0.42  # seconds from shot to shot; that a shot flies
SHOT, SHOTS = 0.75, 7  # seconds from shot to shot at the wall; the last two find nothing left
POWER = 1.3  # seconds for each pick-up


def drive(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot drives round a stick that shows how."""
    way = seconds * SPEED
    for i in range(TREADS, 0, -1):
        tx, ty, heading, _ = _lap(way - 20 - i * TREAD_GAP)
        level = max(1, effects.TREAD_LEVELS * (TREADS - i) // TREADS)
        _add(screen, effects.tread(0, step(heading, effects.TURNS), level), x + tx, y + ty)
    rx, ry, heading, turning = _lap(way)
    beam = effects.beam(0, step(heading, effects.BEAM_TURNS))
    _add(screen, beam, x + rx, y + ry)
    stamp(screen, tank(0, step(heading, HEADINGS)), x + rx, y + ry)
    _stick().draw(screen, round(x), round(y))
    knob = (0.7, -0.7) if turning else (0.0, -1.0)
    _knob().draw(screen, round(x + 26 * knob[0]), round(y + 26 * knob[1]))
    return None


def shoot(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """Two robots hit each other in turn: the points rise from them."""
    places = ((x - 104, y + 118), (x + 104, y - 118))
    turn, since = divmod(seconds, DUEL)
    shooter = int(turn) % 2
    angle = math.atan2(places[1][1] - places[0][1], places[1][0] - places[0][0])
    for i, (px, py) in enumerate(places):
        stamp(screen, tank(i, step(angle + math.pi * i, HEADINGS)), px, py)
    heading = angle + math.pi * shooter
    (ax, ay), (bx, by) = places[shooter], places[1 - shooter]
    since -= 0.35
    if 0.0 <= since < 0.06:
        muzzle = ax + 70 * math.cos(heading), ay + 70 * math.sin(heading)
        _add(screen, effects.flash(shooter, step(heading, effects.TURNS)), *muzzle)
    if 0.0 <= since < FLIGHT:
        share = (64 + (since / FLIGHT) * (math.dist((ax, ay), (bx, by)) - 100)) / math.dist((ax, ay), (bx, by))
        shot = effects.bullet(shooter, step(heading, HEADINGS))
        _add(screen, shot, ax + (bx - ax) * share, ay + (by - ay) * share)
    elif since >= FLIGHT:
        _hit(screen, shooter, places, since - FLIGHT)
    return None


def _hit(screen: pygame.Surface, shooter: int, places: tuple[Point, Point], since: float) -> None:
    """The shock on the one that was hit, and the points of both."""
    stage = int(since / 0.45 * effects.WAVE_STEPS)
    if stage < effects.WAVE_STEPS:
        _add(screen, effects.wave(PLAYERS[1 - shooter], stage), *places[1 - shooter])
    if since < 1.1:
        level = things.POPUP_LEVELS if since < 0.7 else max(1, round(things.POPUP_LEVELS * (1.1 - since) / 0.4))
        rise = 60 * (1 - (1 - min(1.0, since / 0.8)) ** 2)
        for seat, said in ((shooter, "+1"), (1 - shooter, "−1")):
            px, py = places[seat]
            side = 96 if seat == 0 else -96
            stamp(screen, things.popup(said, seat, level), px + side, py + 30 - rise)


def walls(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """Five shots, and the wall is gone."""
    shot, since = divmod(seconds, SHOT)
    number = int(shot) % SHOTS
    ax, bx = x - 128, x + 108
    hits = min(5, number + (since > FLIGHT))
    stamp(screen, wall(250, 34, math.pi / 2, 5 - hits, 7), bx, y + 26)
    stamp(screen, tank(2, 0), ax, y + 26)
    if number < 5:
        if since < 0.06:
            _add(screen, effects.flash(2, 0), ax + 70, y + 26)
        if since < FLIGHT:
            _add(screen, effects.bullet(2, 0), ax + 64 + (bx - ax - 84) * since / FLIGHT, y + 26)
        elif since < FLIGHT + 0.25:
            for i in range(9):
                a = 2.0 + i * 0.29
                r = 20 + 260 * (since - FLIGHT)
                sprite = effects.sparks((168, 176, 204), 3, step(a, effects.SPARK_TURNS))[-1]
                _add(screen, sprite, bx - 20 + r * math.cos(a), y + 26 + r * math.sin(a))
    for i in range(5):
        _cell(i < hits).draw(screen, round(x - 104 + 52 * i), round(y - 186))
    return None


def pickups(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """All six, one of them called by its name."""
    named, since = divmod(seconds, POWER)
    chosen = int(named) % len(POWERS)
    for i, name in enumerate(POWERS):
        px, py = x - 82 + 164 * (i % 2), y - 168 + 114 * (i // 2)
        lift = round(6 * math.sin(math.pi * min(1.0, since / 0.3))) if i == chosen else 0
        stamp(screen, things.pickup(name), px, py - lift)
        if i == chosen:
            _halo().draw(screen, round(px), round(py - lift))
    return f"powers.{POWERS[chosen]}"


LESSONS: dict[str, dict[str, Picture]] = {
    "pitanks": {"drive": drive, "shoot": shoot, "walls": walls, "pickups": pickups},
}


def _add(screen: pygame.Surface, sprite: Sprite, x: float, y: float) -> None:
    """Add a sprite of light where it belongs."""
    screen.blit(sprite.image, (round(x + sprite.dx), round(y + sprite.dy)), special_flags=ADD)


def _lap(way: float) -> tuple[float, float, float, bool]:
    """Place, heading and whether it turns, `way` px along a lap: clockwise round (0, 0), from the upper left bend."""
    across, down, bend = LOOP_W - 2 * BEND, LOOP_H - 2 * BEND, BEND * math.pi / 2
    way %= 2 * (across + down) + 4 * bend
    corners = ((1, -1), (1, 1), (-1, 1), (-1, -1))
    for i, straight in enumerate((across, down, across, down)):
        heading = i * math.pi / 2
        cx, cy = corners[i][0] * across / 2, corners[i][1] * down / 2  # centre of the bend that follows
        nx, ny = math.sin(heading) * BEND, -math.cos(heading) * BEND
        if way < straight:
            back = straight - way
            return cx + nx - back * math.cos(heading), cy + ny - back * math.sin(heading), heading, False
        way -= straight
        if way < bend:
            a = heading + way / BEND
            return cx + math.sin(a) * BEND, cy - math.cos(a) * BEND, a, True
        way -= bend
    return 0.0, 0.0, 0.0, False


@cache
def _stick() -> Lit:
    ink = Ink(200, 200).to(100, 100)
    ink.ring(0, 0, 40, MIST, THIN)
    for name, dx, dy in (("up", 0, -62), ("down", 0, 62), ("left", -62, 0), ("right", 62, 0)):
        icon(ink, name, dx, dy, 13, STEEL, THIN)
    return Lit(ink.lit(0.6), (-100, -100))


@cache
def _knob() -> Lit:
    return Lit(Ink(96, 96).disc(48, 48, 19, ICE).lit(0.8), (-48, -48))


@cache
def _cell(lit: bool) -> Lit:
    ink, box = Ink(96, 96), cut(32, 26, 32, 44, 7)
    return Lit((ink.fill(box, FOCUS) if lit else ink.line(box, STEEL, 3, True)).lit(0.8), (-48, -48))


@cache
def _halo() -> Lit:
    ink = Ink(200, 200).to(100, 100)
    for i in range(8):
        a = i * math.tau / 8
        ink.line([(62 * math.cos(a), 62 * math.sin(a)), (72 * math.cos(a), 72 * math.sin(a))], FOCUS, LINE - HAIR)
    return Lit(ink.lit(1.0), (-100, -100))
