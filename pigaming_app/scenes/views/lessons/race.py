"""How to play Robot Race: laps, four lines in order, the line that ends a lap, mud."""

import math

import pygame

from pigaming_app.scenes.views.lessons.animation import Loop, add, drive_by, drive_round
from pigaming_app.scenes.views.race.lines import LineFrame, draw_line
from pigaming_app.scenes.views.race.sprites import clods
from pigaming_app.scenes.views.race.track import EDGE
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites import pickups as things
from pigaming_app.scenes.views.things.styles import MUD
from pigaming_app.ui.draw import ALARM, ICE, PLAYERS, SUB, THIN, Color, GlowCanvas, badge, dim, mix
from pigaming_app.ui.draw.frame_budget import run_to_end
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import word

ROUND, ROAD = Loop(254.0, 310.0, 127.0), 46.0  # px: centre line and half width of the road
SPEED, LAPS = 300.0, 3  # px/s
WIDE = 200  # px: half the usable width of a panel
STRAIGHT, YOURS, THEIRS = 104.0, 92.0, -74.0  # px: half the width of the straight road; x of the lines of two players
APART = 100.0  # px from the edge of the mud to each robot
SLOW = 1.0 / 3.0
BIG = 150  # font size of the lap number
PINK: Color = mix(ALARM, (255, 255, 255), 0.45)


def laps(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A robot drives laps, counted in the middle."""
    way = seconds * SPEED
    _round(False).draw(screen, round(x), round(y))
    word(str(int(way / ROUND.length) % LAPS + 1), BIG, ICE).draw(screen, round(x), round(y))
    drive_round(screen, 0, ROUND, x, y, way)
    return None


def lines(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """Each line lights up when crossed."""
    way = seconds * SPEED * 0.8
    passed = int(4 * (way % ROUND.length) / ROUND.length)
    _round(True).draw(screen, round(x), round(y))
    for line in range(4):
        turn = line * math.pi / 2
        post = _post(line, line <= passed)
        post.draw(screen, round(x + 48 * math.sin(turn)), round(y - 76 * math.cos(turn)))
    drive_round(screen, 0, ROUND, x, y, way)
    return None


def finish(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """Another player's line has no effect; one's own counts a lap."""
    _own().draw(screen, round(x), round(y))
    whole = 2 * WIDE + 320
    way = seconds * SPEED % whole
    at = way - WIDE - 90
    drive_by(screen, 0, x + at, y, way)
    since = (at - YOURS) / SPEED
    if 0.0 <= since < 0.45:
        stage = min(effects.WAVE_STEPS - 1, int(since / 0.45 * effects.WAVE_STEPS))
        add(screen, effects.wave(PLAYERS[0], stage), x + YOURS, y)
    if since >= 0.0:
        rise = 30 * (1 - (1 - min(1.0, since / 0.6)) ** 2)
        popup = things.popup("+1", 0)
        screen.blit(popup.image, (round(x + YOURS + popup.dx), round(y + STRAIGHT + 70 - rise + popup.dy)))
    return None


def mud(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """The same robot on the road and in the mud."""
    edge().draw(screen, round(x), round(y))
    for share, down in ((1.0, -APART), (SLOW, APART)):
        way = (seconds * SPEED * share) % (2 * WIDE + 180)
        if down < 0:
            drive_by(screen, 1, x - WIDE - 90 + way, y + down, way)
            continue
        for i in range(10):
            lag = 30.0 + 11.0 * i + 9.0 * math.sin(40.0 * i)
            lump = clods(3 + 2 * (i % 3))[4 - i * 4 // 10]
            add(screen, lump, x - WIDE - 90 + way - lag, y + down + 30 * math.sin(7.0 * i))
        drive_by(screen, 1, x - WIDE - 90 + way, y + down, 0.0)
    word("1/3", SUB, PINK).draw(screen, round(x + 120), round(y + APART + 62))
    return None


@cached
def _round(lined: bool) -> LitImage:
    """A ring road, with one line or the lines of all four players."""
    glow, crisp = sheets()
    for out in (-ROAD, ROAD):
        glow.neon(ROUND.outline(out), EDGE, 5, True)
    for line in range(4 if lined else 1):
        x, y, heading, _ = ROUND.at(line * ROUND.length / 4)
        frame = LineFrame(x, y, math.cos(heading), math.sin(heading), ROAD)
        draw_line(glow, crisp, frame, PLAYERS[line])
    return lit(glow, crisp)


@cached
def _own() -> LitImage:
    """A straight road with the lines of two players."""
    glow, crisp = sheets()
    for side in (-1, 1):
        glow.neon([(-WIDE, side * STRAIGHT), (WIDE, side * STRAIGHT)], EDGE, 5)
    for line, at in ((0, YOURS), (1, THEIRS)):
        draw_line(glow, crisp, LineFrame(at, 0.0, 1.0, 0.0, STRAIGHT), PLAYERS[line])
        badge(glow, line, at, -STRAIGHT - 54, 34)
    return lit(glow, crisp)


@cached
def edge() -> LitImage:
    """The edge of the road, and contour lines of mud below it."""
    glow, crisp = sheets()
    glow.neon([(-WIDE, 0), (WIDE, 0)], EDGE, 5)
    for row in range(6):
        wave = [(u, 26 + 36 * row + 9 * math.sin(u / 34 + 1.7 * row)) for u in range(-WIDE, WIDE + 1, 10)]
        crisp.line(wave, dim(MUD, 0.55 - 0.05 * (row % 2)), THIN)
    return lit(glow, crisp)


@cached
def _post(line: int, lit: bool) -> LitImage:
    ink = GlowCanvas(120, 120).set_transform(60, 60)
    badge(ink, line, 0, 0, 25, None if lit else dim(PLAYERS[line], 0.3))
    return LitImage(ink.lit(0.6), (-60, -60))


def sheets() -> tuple[GlowCanvas, GlowCanvas]:
    """A glowing and a crisp canvas, centred on (0, 0)."""
    side = 2 * WIDE + 60
    glow, crisp = (GlowCanvas(side, side + 40).set_transform(side / 2, side / 2) for _ in range(2))
    return glow, crisp


def lit(glow: GlowCanvas, crisp: GlowCanvas) -> LitImage:
    out = glow.lit(0.6)
    run_to_end(crisp.downscale_onto(out))
    return LitImage(out, (-(WIDE + 30), -(WIDE + 30)))
