"""PiTanks by the party rules, as seen and heard: points, stars, lights, bounties, the banner."""

import math

import pygame
import pytest

from pigaming_app.games.pitanks.rules import judge
from pigaming_app.games.pitanks.state import OWN_BULLETS
from pigaming_app.scenes.bench.frame_times import AllEffects
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.hud.parts import CLOCK
from pigaming_app.scenes.views.pitanks.banner import CELLS
from pigaming_app.scenes.views.pitanks.view import PiTanksView
from pigaming_app.scenes.views.sprites import party as sprites
from pigaming_app.sim.world import HZ
from pigaming_app.ui.i18n import Words
from tests.floor import arena, pitanks

POSES = [(400.0, 450.0, 0.0), (800.0, 450.0, math.pi), (1200.0, 450.0, math.pi)]
MARKER = 72  # px, radius of the disc of a real robot


def match(variant="party"):
    """The state of a match, and its view."""
    state = pitanks(POSES, variant=variant)
    state.next_pickup = 1_000_000
    return state, PiTanksView(arena(poses=POSES), state, ["human"] * 4, AllEffects(), Words("en"))


def hit(state, shooter, victim):
    robot, bullet = state.robots[victim], state.bullets[shooter * OWN_BULLETS]
    bullet.alive, bullet.fresh, bullet.x, bullet.y = 1, 0, robot.x, robot.y - 48.0
    bullet.vx, bullet.vy = 0.0, 560.0


def sounds(view, state, ticks=1):
    heard = []
    for _ in range(ticks):
        judge(state)
        heard += [name for name, _, _ in view.watch(state)]
    return heard


def clock(screen, view, state):
    view.draw(screen, state, 1.0, 0.0)
    return pygame.image.tobytes(screen.subsurface(CLOCK), "RGB")


def test_the_points_rise_at_the_hit_in_the_colour_of_the_shooter():
    state, view = match()
    state.robots[1].score = 5
    sounds(view, state)
    hit(state, 0, 1)
    assert "hit" in sounds(view, state)
    (popup,) = view.particles.scores
    assert (popup.text, popup.player, popup.x) == ("+2", 0, LEFT + 800.0)


@pytest.mark.parametrize(("variant", "dots"), [("party", 5), ("pickups", 5), ("plain", 0)])
def test_dots_above_a_robot_are_the_shots_it_has_left(screen, variant, dots):
    state, view = match(variant)
    x, y, _ = POSES[0]
    places = [(x + 60.0 * math.sin(0.3 * i), y - 60.0 * math.cos(0.3 * i)) for i in range(-2, 3)]
    for shots in range(5):
        view.draw(screen, state, 1.0, 0.0)
        lights = [screen.get_at((round(LEFT + px), round(TOP + py)))[2] for px, py in places]
        assert [light > 200 for light in lights] == [i < dots - shots for i in range(5)], shots
        assert [light > 40 for light in lights] == [i < dots for i in range(5)]
        state.actions[0].fire, state.tanks[0].cooldown = 1, 0
        sounds(view, state)
        for bullet in state.bullets:
            bullet.alive = 0


def test_of_two_hits_in_one_tick_both_points_rise():
    state, view = match()
    hit(state, 0, 1)
    hit(state, 1, 2)
    sounds(view, state)
    assert sorted((popup.text, popup.player) for popup in view.particles.scores) == [("+1", 0), ("+1", 1)]


def test_a_hit_that_scores_nothing_in_overtime_raises_no_points():
    state, view = match()
    state.tick, state.robots[0].score, state.robots[1].score = state.rules.ticks - 1, 3, 3
    sounds(view, state)
    hit(state, 2, 1)
    assert "hit" in sounds(view, state)
    assert not view.particles.scores


def test_by_other_rules_both_robots_show_their_change():
    state, view = match("plain")
    hit(state, 0, 1)
    sounds(view, state)
    assert sorted(popup.text for popup in view.particles.scores) == ["+1", "−1"]


def test_light_finale_and_overtime_are_heard_once():
    state, view = match()
    assert sounds(view, state, 5 * HZ).count("missed") == 3
    state.tick = state.rules.ticks - 20 * HZ - 2
    assert sounds(view, state, 10).count("last_lap") == 1
    state.tick = state.rules.ticks - 2
    found = sounds(view, state, 10)
    assert (found.count("go"), found.count("pickup")) == (1, 0)


def test_the_banner_follows_the_phases_of_the_match(screen):
    state, view = match()
    ticks = state.rules.ticks
    pictures = []
    for tick, content in (
        (ticks - 20 * HZ - 1, None),
        (ticks - 20 * HZ, ("finale", 20)),
        (ticks - 1, ("finale", 1)),
        (ticks, ("overtime", CELLS)),
        (ticks + 16 * HZ, ("overtime", 7)),
    ):
        state.tick = tick
        assert view.hud.banner.content(state) == content
        pictures.append(clock(screen, view, state))
    assert len(set(pictures)) == len(pictures)
    state.over = 1
    assert view.hud.banner.content(state) is None


def test_in_overtime_all_who_may_score_have_the_crown(screen):
    state, view = match()
    state.tick = state.rules.ticks - 1
    state.robots[0].score = state.robots[2].score = 4
    sounds(view, state)
    view.draw(screen, state, 1.0, 0.0)
    crowns = [view.hud.parts.shown[slot][1] for slot in view.hud.slots]
    assert crowns == [True, False, True]


def brightness(screen, x, y, r):
    return sum(pygame.transform.average_color(screen.subsurface((LEFT + x - r, TOP + y - r, 2 * r, 2 * r)))[:3])


def test_a_lit_robot_stands_in_light_and_a_warning_comes_before(screen):
    state, view = match()
    shown = []
    for camped, lit in ((0, 0), (3.5 * HZ, 0), (4 * HZ, 1)):
        tank = state.tanks[0]
        tank.camp_x, tank.camp_y, tank.camped, tank.lit = 400.0, 450.0, int(camped), lit
        view.draw(screen, state, 1.0, 0.0)
        shown.append(brightness(screen, 400, 450, sprites.STAGE))
    assert shown[0] < shown[1] < shown[2] - 20


def test_the_stars_of_a_real_robot_keep_off_its_marker(screen):
    state, view = match()
    state.tanks[0].knocked_out = 20
    state.robots[0].x = 400.0
    view.real = frozenset({0})
    view.draw(screen, state, 1.0, 0.0)
    star = sprites.stars(0, view.reach(0, sprites.STAR_R))
    lit = pygame.mask.from_threshold(star.image, (0, 0, 0), (12, 12, 12, 255))
    lit.invert()
    nearest = min(
        math.hypot(x + star.dx, y + star.dy)
        for x in range(0, star.image.get_width(), 2)
        for y in range(0, star.image.get_height(), 2)
        if lit.get_at((x, y))
    )
    assert nearest > MARKER


@pytest.mark.parametrize("y", [60.0, 450.0, 850.0])
def test_a_bounty_stays_in_the_arena(screen, y):
    state, view = match()
    state.robots[0].y, state.robots[0].x = y, 40.0
    sounds(view, state)
    view.draw(screen, state, 1.0, 0.0)
    bare = screen.copy()
    state.tanks[0].bounty = 1
    view.draw(screen, state, 1.0, 0.0)
    difference = pygame.mask.from_threshold(screen, (0, 0, 0), (1, 1, 1, 255), bare)
    difference.invert()
    box = difference.get_bounding_rects()
    changed = box[0].unionall(box[1:])
    assert pygame.Rect(LEFT, TOP, 1600, 900).contains(changed)
    assert changed.w > 80
