"""How to play PiTanks: drive, shoot, break walls, collect."""

import math

import pygame

from pigaming_app.ai.game_ai import POINT, TURN
from pigaming_app.games.pitanks.state import POWERS
from pigaming_app.scenes.views.lessons.animation import Loop, add, drive_round
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites import pickups as things
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.scenes.views.sprites.wall import wall
from pigaming_app.ui.draw import FOCUS, HAIR, ICE, LINE, MIST, PLAYERS, STEEL, THIN, GlowCanvas, Point, cut_box, icon
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.sprites import HEADINGS, step
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import blit_sprite

ROUND, SPEED = Loop(236.0, 250.0, 78.0), 190.0  # px, px/s: the lap in the first picture
RISE = 34  # px by which it is higher than other pictures, above the name of the driving style
DUEL, FLIGHT = 2.0, 0.42  # seconds: interval between shots; flight of a shot
SHOT, SHOTS = 0.75, 7  # seconds between shots at the wall; number of shots, of which the last two pass
POWER = 1.3  # seconds per pick-up


def drive(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot drives round a stick that shows the matching deflection: a lap in each driving style."""
    way, y = seconds * SPEED, y - RISE
    turning = drive_round(screen, 0, ROUND, x, y, way)
    heading = ROUND.at(way)[2]
    _stick().draw(screen, round(x), round(y))
    style = (TURN, POINT)[int(way / ROUND.length) % 2]
    knob = (0.7, -0.7) if turning else (0.0, -1.0)
    if style == POINT:
        knob = math.cos(heading), math.sin(heading)
    _knob().draw(screen, round(x + 26 * knob[0]), round(y + 26 * knob[1]))
    return f"lobby.drive_{style}"


def shoot(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """Two robots hit each other in turn, with their score changes."""
    places = ((x - 104, y + 118), (x + 104, y - 118))
    turn, since = divmod(seconds, DUEL)
    shooter = int(turn) % 2
    angle = math.atan2(places[1][1] - places[0][1], places[1][0] - places[0][0])
    for i, (px, py) in enumerate(places):
        blit_sprite(screen, tank(i, step(angle + math.pi * i, HEADINGS)), px, py)
    heading = angle + math.pi * shooter
    (ax, ay), (bx, by) = places[shooter], places[1 - shooter]
    since -= 0.35
    if 0.0 <= since < 0.06:
        muzzle = ax + 70 * math.cos(heading), ay + 70 * math.sin(heading)
        add(screen, effects.flash(shooter, step(heading, effects.TURNS)), *muzzle)
    if 0.0 <= since < FLIGHT:
        share = (64 + (since / FLIGHT) * (math.dist((ax, ay), (bx, by)) - 100)) / math.dist((ax, ay), (bx, by))
        shot = effects.bullet(shooter, step(heading, HEADINGS))
        add(screen, shot, ax + (bx - ax) * share, ay + (by - ay) * share)
    elif since >= FLIGHT:
        _hit(screen, shooter, places, since - FLIGHT)
    return None


def _hit(screen: pygame.Surface, shooter: int, places: tuple[Point, Point], since: float) -> None:
    """The shock wave on the robot hit, and the score changes of both."""
    stage = int(since / 0.45 * effects.WAVE_STEPS)
    if stage < effects.WAVE_STEPS:
        add(screen, effects.wave(PLAYERS[1 - shooter], stage), *places[1 - shooter])
    if since < 1.1:
        level = things.POPUP_LEVELS if since < 0.7 else max(1, round(things.POPUP_LEVELS * (1.1 - since) / 0.4))
        rise = 60 * (1 - (1 - min(1.0, since / 0.8)) ** 2)
        for seat, change in ((shooter, "+1"), (1 - shooter, "−1")):
            px, py = places[seat]
            side = 96 if seat == 0 else -96
            blit_sprite(screen, things.popup(change, seat, level), px + side, py + 30 - rise)


def walls(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """Five shots destroy a wall."""
    shot, since = divmod(seconds, SHOT)
    number = int(shot) % SHOTS
    ax, bx = x - 128, x + 108
    hits = min(5, number + (since > FLIGHT))
    blit_sprite(screen, wall(250, 34, math.pi / 2, 5 - hits, 7), bx, y + 26)
    blit_sprite(screen, tank(2, 0), ax, y + 26)
    if number < 5:
        if since < 0.06:
            add(screen, effects.flash(2, 0), ax + 70, y + 26)
        if since < FLIGHT:
            add(screen, effects.bullet(2, 0), ax + 64 + (bx - ax - 84) * since / FLIGHT, y + 26)
        elif since < FLIGHT + 0.25:
            for i in range(9):
                a = 2.0 + i * 0.29
                r = 20 + 260 * (since - FLIGHT)
                sprite = effects.sparks((168, 176, 204), 3, step(a, effects.SPARK_TURNS))[-1]
                add(screen, sprite, bx - 20 + r * math.cos(a), y + 26 + r * math.sin(a))
    for i in range(5):
        _cell(i < hits).draw(screen, round(x - 104 + 52 * i), round(y - 186))
    return None


def pickups(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """All six pick-ups, one highlighted and named."""
    named, since = divmod(seconds, POWER)
    chosen = int(named) % len(POWERS)
    for i, name in enumerate(POWERS):
        px, py = x - 82 + 164 * (i % 2), y - 168 + 114 * (i // 2)
        lift = round(6 * math.sin(math.pi * min(1.0, since / 0.3))) if i == chosen else 0
        blit_sprite(screen, things.pickup(name), px, py - lift)
        if i == chosen:
            _halo().draw(screen, round(px), round(py - lift))
    return f"powers.{POWERS[chosen]}"


@cached
def _stick() -> LitImage:
    ink = GlowCanvas(200, 200).set_transform(100, 100)
    ink.ring(0, 0, 40, MIST, THIN)
    for name, dx, dy in (("up", 0, -62), ("down", 0, 62), ("left", -62, 0), ("right", 62, 0)):
        icon(ink, name, dx, dy, 13, STEEL, THIN)
    return LitImage(ink.lit(0.6), (-100, -100))


@cached
def _knob() -> LitImage:
    return LitImage(GlowCanvas(96, 96).disc(48, 48, 19, ICE).lit(0.8), (-48, -48))


@cached
def _cell(lit: bool) -> LitImage:
    ink, box = GlowCanvas(96, 96), cut_box(32, 26, 32, 44, 7)
    return LitImage((ink.fill(box, FOCUS) if lit else ink.line(box, STEEL, 3, True)).lit(0.8), (-48, -48))


@cached
def _halo() -> LitImage:
    ink = GlowCanvas(200, 200).set_transform(100, 100)
    for i in range(8):
        a = i * math.tau / 8
        ink.line([(62 * math.cos(a), 62 * math.sin(a)), (72 * math.cos(a), 72 * math.sin(a))], FOCUS, LINE - HAIR)
    return LitImage(ink.lit(1.0), (-100, -100))
