"""How Robot Factory appears on the screens."""

import math
from collections.abc import Callable

import pygame

from pigaming_app.games.factory.pallets import move
from pigaming_app.games.factory.start import floor_of
from pigaming_app.games.factory.state import (
    DONE,
    FIRE,
    HALF,
    IN_SLOT,
    MACHINE_SLOTS,
    MAX_PALLETS,
    ON_ROBOT,
    RAW,
    SHARED_SLOTS,
    Factory,
)
from pigaming_app.scenes.views.factory.background import colors_of, draw_floor, draw_storage, draw_warehouse, warehouses
from pigaming_app.scenes.views.factory.view import FactoryView
from pigaming_app.scenes.views.game_screens import GameScreens, Placed
from pigaming_app.scenes.views.lesson import Actor, Lesson
from pigaming_app.scenes.views.preview import fitted, robots
from pigaming_app.scenes.views.sprites.robot import robot as draw_robot
from pigaming_app.scenes.views.sprites.teams import TEAMS
from pigaming_app.scenes.views.things.on_mat import black_out, draw_all
from pigaming_app.scenes.views.things.styles import WORKSHOP
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HEIGHT, HZ, WIDTH
from pigaming_app.ui.draw import ALARM, BLUE, GREEN, ICE, LINE, MIST, THIN, Color, GlowCanvas, cut_box, dim
from pigaming_app.ui.draw.frame_budget import Steps, run_to_end

GLOW = 0.75


def tile(ink: GlowCanvas, x: float, y: float) -> None:
    for cx, color in ((62, ALARM), (280, GREEN), (498, BLUE)):
        _pallet(ink, x + cx, y + 78, color)
    _machine(ink, x + 171, y + 78, "A")
    _machine(ink, x + 389, y + 78, "B")
    for cx in (100, 242, 318, 460):
        ink.line([(x + cx - 5, y + 68), (x + cx + 4, y + 78), (x + cx - 5, y + 88)], MIST, THIN)
    for player, cx, color in ((2, 132, GREEN), (3, 356, BLUE)):
        draw_robot(ink, player, x + cx, y + 206, 0, 1.05)
        _pallet(ink, x + cx + 92, y + 206, color)


def _machine(ink: GlowCanvas, x: float, y: float, label: str) -> None:
    ink.line(cut_box(x - 56, y - 56, 112, 112, 16), MIST, LINE, True).ring(x, y, 27, MIST, LINE)
    for i in range(8):
        c, s = math.cos(i * math.tau / 8 + 0.2), math.sin(i * math.tau / 8 + 0.2)
        ink.line([(x + 30 * c, y + 30 * s), (x + 37 * c, y + 37 * s)], MIST, 8)
    ink.text(label, 32, x, y, ICE, "hero", "c")


def _pallet(ink: GlowCanvas, x: float, y: float, color: Color, r: float = 22) -> None:
    box = cut_box(x - r, y - r, 2 * r, 2 * r, 5)
    ink.solid(box).line(box, color, 5, True)
    ink.line([(x - r, y), (x + r, y)], color, THIN).line([(x, y - r), (x, y + r)], color, THIN)


def preview(arena: Arena, w: int, h: int, allies: bool) -> Steps[pygame.Surface]:
    """Preview of a factory floor: machines, the aisle, and the warehouses, as no team has been dealt them."""
    left, top, k = fitted(w, h)
    glow, crisp = (
        GlowCanvas(w, h, 3).set_transform(left, top, 0.0, k),
        GlowCanvas(w, h, 3).set_transform(left, top, 0.0, k),
    )
    yield from draw_floor((glow, crisp), arena.plan, (dim(MIST, 0.3),) * 2)
    glow.line(cut_box(0, 0, WIDTH, HEIGHT, 28), MIST, THIN / k, True)
    black_out(crisp, arena.things)
    draw_all(glow, WORKSHOP, arena.things)
    out = yield from glow.lit_steps(GLOW)
    yield from crisp.downscale_onto(out)
    return out


def floor(ink: GlowCanvas, arena: Arena) -> None:
    """Machines, the aisle, and the warehouses with what stands beside them."""
    run_to_end(draw_floor((ink, ink), arena.plan, TEAMS))
    for slots in warehouses(arena.plan):
        draw_storage((ink, ink), slots, TEAMS[slots[0].team])


def deal(ink: GlowCanvas, arena: Arena, state: Factory) -> None:
    """The warehouses and the robots' starts in the colours of the teams to which they were dealt."""
    colors = colors_of(bool(state.rules.allies))
    for slots in warehouses(floor_of(state, arena)):
        draw_warehouse((ink, ink), slots, colors[slots[0].team])
    for robot in state.robots:
        if robot.present:
            ink.ring(robot.x, robot.y, 36, colors[robot.team], 8)
    robots(ink, arena, state)


def crate(ink: GlowCanvas, placed: Placed, size: float, shape: int, color: Color) -> None:
    """Confetti: a crate."""
    box = placed(cut_box(-size, -size, 2 * size, 2 * size, 0.35 * size))
    ink.solid(box).fill(box, dim(color, 0.35)).line(box, color, 4, True)


def _pallet_at(
    place: int, at: int, state: int, waited: int = 0, team: int = 0, rush: int = 0
) -> Callable[[Factory], None]:
    """A lesson that begins with the first pallet of a team in a place; `waited`, `rush`: ticks."""

    def prepare(match: Factory) -> None:
        p = team * MAX_PALLETS
        move(match, p, place, at)
        pallet = match.pallets[p]
        pallet.state, pallet.waited, pallet.rush = state, waited, rush
        match.turns[:] = range(len(match.turns))
        match.rules.process = 2 * HZ

    return prepare


def _loose_at(slot: int) -> Callable[[Factory], None]:
    """A lesson that begins with a loose pallet in a slot."""

    def prepare(match: Factory) -> None:
        if not match.slots[slot].pallet:
            move(match, next(p for p, pallet in enumerate(match.pallets) if pallet.loose), IN_SLOT, slot)

    return prepare


def _before_star(state: Factory) -> None:
    state.tick = state.rules.three_stars - 100


OUTPUT_A = MACHINE_SLOTS + 1  # of the first machine
FETCH = "wait 0.4, go 132 184, fire wait 0.2, wait 0.4, go 280 184"
BRING = "wait 0.4, go 132 628, fire wait 0.2, wait 0.3, go 280 628"
FEED = "wait 0.4, go 450 90, fire wait 0.2, wait 0.3, go 350 90"
TAKE = "wait 1.5, go 450 342, fire wait 0.2, wait 0.3, go 340 342"
PASS_ON = "turn 350 560, go 350 558, turn 520 558, go 452 558, fire wait 0.2, wait 3.2"
GRAB = "go 640 300, go 720 250, turn 800 240, fire wait 0.2, wait 0.4, go 620 300"
EXIT, AT_A = (130.0, 600.0), (470.0, 230.0)

LESSONS = {
    "lift": Lesson((Actor(300, 184, 180, FETCH),), 4.0, (200.0, 230.0)),
    "work": Lesson(
        (Actor(340, 90, 0, f"{FEED}, wait 1, go 350 342, turn 520 342, {TAKE}, {PASS_ON}"),),
        17.0,
        None,
        _pallet_at(ON_ROBOT, 0, RAW),
    ),
    "deliver": Lesson((Actor(330, 628, 180, BRING),), 4.5, EXIT, _pallet_at(ON_ROBOT, 0, DONE)),
    "people": Lesson((Actor(500, 450, 0, "go 760 450, go 640 450"),), 5.5, (640.0, 450.0)),
    "rush": Lesson((Actor(330, 628, 180, BRING),), 4.5, EXIT, _pallet_at(ON_ROBOT, 0, DONE, rush=900)),
    "loose": Lesson(
        (Actor(620, 380, -45, GRAB), Actor(1000, 300, 180, "go 890 240")),
        4.5,
        (780.0, 280.0),
        _loose_at(SHARED_SLOTS + 1),
    ),
    "claim": Lesson((Actor(300, 342, 0, TAKE),), 5.5, AT_A, _pallet_at(IN_SLOT, OUTPUT_A, HALF, 140, FIRE)),
    "fast": Lesson((Actor(300, 90, 0, f"{FEED}, wait 3"),), 5.5, AT_A, _pallet_at(ON_ROBOT, 0, RAW)),
    "allies": Lesson(
        (Actor(300, 184, 180, FETCH), *(Actor(x, y, 180, "planner") for x, y in ((340, 330), (240, 420), (400, 130)))),
        4.5,
        (230.0, 260.0),
    ),
    "stars": Lesson((Actor(900, 160, 0, "wait 9"),), 4.5, (895.0, 60.0), _before_star),
    "tasks": Lesson((Actor(300, 330, 0, "wait 9"), Actor(330, 200, 180, "planner")), 6.0, (330.0, 230.0)),
    "clear": Lesson((Actor(330, 450, 0, "wait 9"),), 6.0, (560.0, 330.0), _pallet_at(IN_SLOT, OUTPUT_A, HALF, 880)),
}

SCREENS = GameScreens(
    FactoryView,
    tile,
    "hint_lift",
    preview,
    crate,
    team_colors=True,
    lessons=LESSONS,
    lesson_pages=("standard", "party", "together"),
    floor=floor,
    deal=deal,
    awards={"delivered": "crate", "steps": "gear", "-bumps": "heart"},
)
