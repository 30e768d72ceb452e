"""Real things in the views: dark where they stand, light around them, cheap to move."""

import pygame
import pytest

from pigaming_app.games.arenas import arenas, load, parse
from pigaming_app.games.match import Match
from pigaming_app.scenes.bench.frame_times import AllEffects
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.pitanks.events import PiTanksEventDetector
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.scenes.views.things.on_mat import halo, place
from pigaming_app.scenes.views.things.styles import NEON
from pigaming_app.sim.arena import replace_things
from pigaming_app.sim.things.spec import ThingSpec, Use, written
from pigaming_app.ui.draw.frame_budget import run_to_end
from pigaming_app.ui.i18n import Words
from tests.matches import setup_of

X, Y, HALF, MARGIN = 800.0, 400.0, 30.0, 5.0


def square(x=X, y=Y, use=Use.WALL, half=HALF):
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    return ThingSpec(use, tuple((x + u * half, y + v * half) for u, v in corners), MARGIN)


def begun(game, *things):
    """A match that has not begun, on the game's first arena with things, and its view."""
    name = arenas(game)[0]
    arena = parse(game, load(game, name).source + written(things), f"{name}.toml")
    match = Match(setup_of(game, ["human"] * 4, name, 1.0, 3), arena=arena)
    return match, SCREENS[game].view(arena, match.state, ["human"] * 4, AllEffects("full", True), Words("en"))


def drawn(screen, match, view):
    """Draw until all light has been built."""
    for _ in range(20):
        view.draw(screen, match.state, 1.0, 0.0)


def brightness(screen, x, y):
    return max(screen.get_at((round(LEFT + x), round(TOP + y)))[:3])


def brightest_of_body(screen):
    box = pygame.Rect(0, 0, 2 * HALF, 2 * HALF)
    box.center = LEFT + X, TOP + Y
    return max(max(screen.get_at((x, y))[:3]) for x in range(box.left, box.right) for y in range(box.top, box.bottom))


@pytest.mark.parametrize("game", list(SCREENS))
def test_no_light_falls_on_a_thing_and_much_around_it(screen, game):
    match, view = begun(game, square())
    for side in (-1.0, 1.0):  # light that the match would throw on it
        view.particles.glow(LEFT + X, TOP + Y, (255, 255, 255))
        view.particles.burst(LEFT + X + 20 * side, TOP + Y, (255, 255, 255), 20, 4, 60)
    drawn(screen, match, view)
    view.draw(screen, match.state, 1.0, 0.01)
    assert brightest_of_body(screen) == 0
    edge = HALF + MARGIN + 5.0
    assert min(brightness(screen, X + u * edge, Y + v * edge) for u, v in ((1, 0.1), (0.1, 1))) > 0
    assert max(brightness(screen, X + edge, Y + v) for v in range(-20, 20)) > 150


@pytest.mark.parametrize(("game", "use"), [("pitanks", Use.MUD), ("pitanks", Use.LINE), ("race", Use.LINE)])
def test_flat_things_are_lit_and_robots_drive_over_them(screen, game, use):
    match, view = begun(game, square(use=use))
    drawn(screen, match, view)
    assert brightest_of_body(screen) > 60
    x, y, _ = view.pose(0, 1.0)
    before = screen.get_at((round(x), round(y)))
    view.show_things([square(x - LEFT, y - TOP, use)])
    drawn(screen, match, view)
    assert screen.get_at((round(x), round(y))) == before


def test_the_walls_of_the_arena_are_drawn_and_the_capsules_of_things_are_not(screen):
    match, view = begun("pitanks", square())
    view.draw(screen, match.state, 1.0, 0.0)
    assert len(view.walls.sprites) == len(match.arena.walls) < match.state.wall_count


def test_a_thing_that_is_moved_goes_dark_there_at_once_and_is_no_event(screen):
    match, view = begun("pitanks", square())
    detector = PiTanksEventDetector(match.state)
    view.draw(screen, match.state, 1.0, 0.0)
    moved = square(X + 300.0, Y)
    replace_things(match.state, [moved, square(X, Y + 250.0)], len(match.arena.walls))
    assert detector.detect(match.state) == []
    view.show_things([moved])
    view.draw(screen, match.state, 1.0, 0.0)
    assert brightness(screen, X + 300.0, Y) == 0
    assert brightness(screen, X + HALF + MARGIN + 5.0, Y) < 30
    view.show_things([])
    view.draw(screen, match.state, 1.0, 0.0)
    assert brightness(screen, X + 300.0 + HALF + MARGIN + 5.0, Y) < 30


def test_a_block_that_glides_needs_no_new_sprite():
    first, second = place(square()), place(square(X + 3.3, Y - 7.7))
    assert first[2:6] == second[2:6]
    assert halo(NEON, *first[2:6]) is halo(NEON, *second[2:6])


@pytest.mark.parametrize("game", list(SCREENS))
def test_a_preview_shows_things(screen, game):
    match, _ = begun(game, square(half=60.0))
    bare, furnished = (
        run_to_end(SCREENS[game].picture(arena, 400, 230, False))
        for arena in (load(game, arenas(game)[0]), match.arena)
    )
    middle = pygame.Rect(0, 0, 16, 16)
    middle.center = 200, 103
    assert max(pygame.transform.average_color(furnished, middle)[:3]) < 25  # halos alone
    assert furnished.get_buffer().raw != bare.get_buffer().raw
