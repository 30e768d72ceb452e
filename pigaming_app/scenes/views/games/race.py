"""How Robot Race appears on the screens."""

import math
from collections.abc import Callable

import pygame

from pigaming_app.games.race.state import LINES, Race
from pigaming_app.scenes.flow.used_keys import STEER, TURBO
from pigaming_app.scenes.views.game_screens import GameScreens, Placed
from pigaming_app.scenes.views.lesson import Actor, Lesson
from pigaming_app.scenes.views.preview import fitted, robots
from pigaming_app.scenes.views.race.background import GLOW, earth
from pigaming_app.scenes.views.race.ghost import delete_ghosts
from pigaming_app.scenes.views.race.lines import draw_line, draw_signed, frame, line_signs
from pigaming_app.scenes.views.race.track import draw_track
from pigaming_app.scenes.views.race.view import RaceView
from pigaming_app.scenes.views.sprites.robot import robot
from pigaming_app.scenes.views.things.on_mat import black_out, draw_all
from pigaming_app.scenes.views.things.styles import ROAD
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.rng import seeded
from pigaming_app.sim.world import HEIGHT, HZ, WIDTH
from pigaming_app.ui.draw import ADD, BLACK, ICE, LINE, MIST, PLAYERS, THIN, Color, GlowCanvas, Point, dim
from pigaming_app.ui.draw.frame_budget import Steps, run_to_end


def tile(ink: GlowCanvas, x: float, y: float) -> None:
    ink.line(_lane(x, y, 114), MIST, LINE).line(_lane(x, y, 20), MIST, LINE)
    ink.dashes(_lane(x, y, 67), dim(MIST, 0.45), 3, 20, 20, False)
    for i, j in ((i, j) for i in range(2) for j in range(6) if (i + j) % 2):
        left, top = x + 150 + 15 * i, y + 24 + 15 * j
        ink.fill([(left, top), (left + 15, top), (left + 15, top + 15), (left, top + 15)], ICE)
    for player, cx, cy, a in ((3, 446, 196, 5.8), (0, 286, 182, 0.0), (1, 150, 214, 0.0)):
        for side in (-26, 26):
            for i in range(4):
                streak = [(-108 + 18 * i, side), (-46, side)]
                ink.set_transform(x + cx, y + cy, a).line(streak, dim(PLAYERS[player], 0.16 * (i + 1)), THIN)
        robot(ink, player, x + cx, y + cy, a, 0.85)


def _lane(x: float, y: float, r: float) -> list[Point]:
    """Half a track: along the top, round a bend, back along the bottom."""
    bend = [(x + 396 + r * math.sin(math.pi * i / 40), y + 136 - r * math.cos(math.pi * i / 40)) for i in range(41)]
    return [(x + 28, y + 136 - r), *bend, (x + 28, y + 136 + r)]


def preview(arena: Arena, w: int, h: int, allies: bool) -> Steps[pygame.Surface]:
    """Preview of a track: mud, road, direction, and the lines, as no seat has been dealt them."""
    left, top, k = fitted(w, h)
    below = pygame.transform.smoothscale(earth(arena.plan), (round(k * WIDTH), round(k * HEIGHT)))
    yield
    glow, crisp = (
        GlowCanvas(w, h, 3).set_transform(left, top, 0.0, k),
        GlowCanvas(w, h, 3).set_transform(left, top, 0.0, k),
    )
    yield from draw_track(glow, crisp, arena.plan)
    for along in arena.plan.lines:
        draw_line(glow, crisp, frame(arena.plan.course, along), ICE)
    black_out(crisp, arena.things)
    draw_all(glow, ROAD, arena.things)
    yield
    light = yield from glow.lit_steps(GLOW)
    out = pygame.Surface((w, h))
    out.blit(below, (round(left), round(top)))
    for thing in arena.things:
        pygame.draw.polygon(out, BLACK, [(left + k * x, top + k * y) for x, y in thing.outline])
    out.blit(light, (0, 0), special_flags=ADD)
    yield from crisp.downscale_onto(out)
    return out


def floor(ink: GlowCanvas, arena: Arena) -> None:
    """Road, direction, and the lines."""
    run_to_end(draw_track(ink, ink, arena.plan))
    for along in arena.plan.lines:
        draw_line(ink, ink, frame(arena.plan.course, along), ICE)


def deal(ink: GlowCanvas, arena: Arena, state: Race) -> None:
    """The lines in the colours of the seats to which they were dealt, and the robots' starts."""
    for along, sign in zip(arena.plan.lines, line_signs(state), strict=True):
        line = frame(arena.plan.course, along)
        ink.solid([line.at(a, b * line.half) for a, b in ((-BARE, -1), (BARE, -1), (BARE, 1), (-BARE, 1))])
        draw_signed(ink, ink, line, sign)
    robots(ink, arena, state)


def chequer(ink: GlowCanvas, placed: Placed, size: float, shape: int, color: Color) -> None:
    """Confetti: a piece of a chequered flag."""
    whole = placed([(-size, -size), (size, -size), (size, size), (-size, size)])
    ink.solid(whole).fill(whole, color)
    for x, y in ((-size, -size), (0.0, 0.0)):
        ink.fill(placed([(x, y), (x + size, y), (x + size, y + size), (x, y + size)]), BLACK)


def _in_lap(line: int, passed: int) -> Callable[[Race], None]:
    """A lesson in which the first racer's own line is `line`, and it has crossed `passed` lines of its lap."""

    def prepare(state: Race) -> None:
        racer, other = state.racers[0], next(racer for racer in state.racers if racer.line == line)
        other.line, racer.line = racer.line, line
        racer.passed, racer.lap_start = passed, -LAP_SO_FAR

    return prepare


def _without_turbo(state: Race) -> None:
    state.robots[0].turbo = 0.0


def _oil_next(state: Race) -> None:
    """The next box contains oil."""
    state.random = seeded(7)


BARE = 30.0  # px, half the width of a line with its glow
LAP_SO_FAR = 14.0 * HZ  # ticks

LESSONS = {
    "laps": Lesson((Actor(112, 640, 270, "hand3"),), 4.0, None, _in_lap(3, LINES)),
    "lines": Lesson((Actor(1010, 116, 0, "hand3"),), 7.0, None, _in_lap(0, 0)),
    "finish": Lesson((Actor(640, 760, 166, "hand3"),), 5.0, None, _in_lap(3, LINES - 1)),
    "mud": Lesson((Actor(560, 640, 180, "go 100 640"), Actor(560, 786, 180, "hand3")), 3.0, (400.0, 700.0)),
    "draft": Lesson(
        (Actor(200, 130, 0, "go 1000 116, turbo go 1500 70"), Actor(330, 120, 0, "go 1400 120")),
        3.4,
        None,
        _without_turbo,
    ),
    "pads": Lesson((Actor(250, 120, 0, "go 400 80, go 1400 116"),), 2.6),
    "items": Lesson(
        (Actor(540, 90, 0, "go 660 80, go 760 116, go 850 116, fire go 1300 116"), Actor(400, 116, 0, "go 1400 112")),
        3.6,
        None,
        _oil_next,
    ),
    "recover": Lesson((Actor(600, 300, 90, "go 600 380, wait 1.2, fire wait 0.2, wait 0.6, go 1100 116"),), 4.0),
}

SCREENS = GameScreens(
    RaceView,
    tile,
    "hint_recover",
    preview,
    chequer,
    lessons=LESSONS,
    lesson_pages=("standard", "party"),
    floor=floor,
    deal=deal,
    first_keys=(STEER, TURBO),
    forget=delete_ghosts,
)
