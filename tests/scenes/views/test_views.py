"""The PiTanks view: everything is drawn, every sound plays once, and the match is not modified."""

import itertools

import pygame
import pytest

from pigaming_app.games.pitanks.state import MINE, OWN_BULLETS, POWERS, SHIELD
from pigaming_app.scenes.bench.busy_pitanks import BusyPiTanks
from pigaming_app.scenes.bench.frame_times import AllEffects
from pigaming_app.scenes.views.background import Background
from pigaming_app.scenes.views.hud.score import ScoreHud, layout
from pigaming_app.scenes.views.particles import MAX_PARTICLES
from pigaming_app.scenes.views.preview import walls
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import DT
from pigaming_app.ui.draw.frame_budget import Unfinished, budget, run_to_end
from pigaming_app.ui.i18n import Words
from tests.scenes.measuring import empty_cache

FREE = (0, 1, 2, 3)
HUMANS = ["human"] * 4


def seen(scene, players=HUMANS, taste=None):
    """A view of a match, and its state."""
    view = SCREENS["pitanks"].view(scene.arena, scene.state, list(players), taste or AllEffects(), Words("en"))
    return view, scene.state


def sounds(view, state):
    return [name for name, _, _ in view.watch(state)]


@pytest.mark.parametrize(
    ("teams", "variant"),
    [
        *((teams, "pickups") for teams in (FREE, (0, 1, -1, -1), (0, -1, 2, 3), (0, 1, 0, 1), (0, 1, 1, 1))),
        (FREE, "party"),
    ],
)
def test_a_second_of_any_company_draws_and_leaves_the_match_alone(screen, teams, variant):
    scene = BusyPiTanks(teams, variant=variant)
    view, _ = seen(scene, ["human", "level1", "level5", "fsm"])
    for _ in range(50):
        scene.tick()
        before = digest(scene.state)
        view.watch(scene.state)
        view.draw(screen, scene.state, 0.5, 0.02)
        assert digest(scene.state) == before
    assert len(view.particles.particles) <= MAX_PARTICLES


@pytest.mark.parametrize("power", range(len(POWERS)), ids=POWERS)
def test_every_power_is_seen_on_the_robot_and_in_its_panel(screen, power):
    scene = BusyPiTanks()
    view, _ = seen(scene)
    view.draw(screen, scene.state, 1.0, 0.0)
    robot, slot = scene.state.robots[0], view.hud.slots[0]
    panel = (slot.x + slot.w - 80, 34, 70, 70)
    around = (160 + int(robot.x) - 60, 140 + int(robot.y) - 60, 120, 120)
    bare = [pygame.image.tobytes(screen.subsurface(box), "RGB") for box in (panel, around)]

    scene.state.tanks[0].powers[power] = 300
    assert sounds(view, scene.state) == ["pickup"]
    view.draw(screen, scene.state, 1.0, 2.0)
    for box, old in zip((panel, around), bare, strict=True):
        assert pygame.image.tobytes(screen.subsurface(box), "RGB") != old

    scene.state.tanks[0].powers[power] = 1
    assert sounds(view, scene.state) == []
    scene.state.tanks[0].powers[power] = 0
    assert sounds(view, scene.state) == ["power_end"]


def test_a_hit_is_heard_once_and_scores_rise_over_both(screen):
    view, state = seen(BusyPiTanks())
    state.tanks[0].hits = state.tanks[2].taken = 1
    state.robots[0].score, state.robots[2].score = 1, -1

    assert view.watch(state) == [("hit", 2, state.robots[2].x)]
    assert {(popup.text, popup.player) for popup in view.particles.scores} == {("+1", 0), ("−1", 2)}
    assert view.watch(state) == []
    view.draw(screen, state, 1.0, 1.0)
    assert view.particles.scores == []


def test_a_shield_that_takes_a_hit_shatters_and_one_that_runs_out_ends():
    scene = BusyPiTanks()
    (view, _), tank = seen(scene), scene.state.tanks[1]
    tank.powers[SHIELD] = 100
    view.watch(scene.state)
    tank.powers[SHIELD] = 0
    assert sounds(view, scene.state) == ["crumble"]


def test_a_bullet_flashes_flies_between_ticks_and_ends_in_sparks(screen):
    view, state = seen(BusyPiTanks())
    bullet, robot = state.bullets[OWN_BULLETS], state.robots[1]
    bullet.alive, bullet.x, bullet.y, bullet.vx = 1, robot.x + 64, robot.y, 560.0
    state.tanks[1].shots = 1
    assert view.watch(state) == [("fire", 1, robot.x)]
    assert view.shots[OWN_BULLETS] == (robot.x + 64 - 560.0 * DT, robot.y)

    bullet.x += 11.2
    view.watch(state)
    assert view.shots[OWN_BULLETS] == (robot.x + 64, robot.y)

    bullet.alive, bullet.x = 0, bullet.x + 5
    assert view.watch(state) == [("wall", 1, bullet.x)]
    assert len(view.particles.particles) == 7


def test_a_shot_that_ends_in_the_tick_in_which_it_is_fired_is_not_lost():
    view, state = seen(BusyPiTanks())
    state.tanks[0].shots = 1
    state.bullets[0].x, state.bullets[0].y, state.bullets[0].vx = 700.0, 20.0, 560.0
    assert sounds(view, state) == ["fire", "wall"]


def test_a_wall_cracks_in_silence_and_falls_with_a_sound(screen):
    view, state = seen(BusyPiTanks())
    view.draw(screen, state, 1.0, 0.0)
    pictures = set()
    wall = state.walls[0]
    box = (160 + int(wall.ax) - 20, 140 + int(wall.ay), 40, int(wall.by - wall.ay))
    for health in (4, 3, 2, 1, 0):
        wall.health = health
        assert sounds(view, state) == (["crumble"] if health == 0 else [])
        view.particles.advance(9.0)
        view.draw(screen, state, 1.0, 0.0)
        pictures.add(pygame.image.tobytes(screen.subsurface(box), "RGB"))
    assert len(pictures) == 5


def test_a_mine_is_heard_when_it_goes_off_not_when_it_rots():
    view, state = seen(BusyPiTanks())
    mine = state.mines[0]
    mine.alive, mine.x, mine.y = 1500, 300.0, 300.0
    assert sounds(view, state) == ["power_end"]
    mine.alive = 0
    assert view.watch(state) == [("mine", 0, 300.0)]
    mine.alive = 1
    view.watch(state)
    mine.alive = 0
    assert sounds(view, state) == []
    assert MINE == 5


def test_a_robot_turns_the_short_way_between_ticks(screen):
    scene = BusyPiTanks()
    (view, _), robot = seen(scene), scene.state.robots[0]
    robot.heading = 6.2
    view.watch(scene.state)
    robot.heading = 0.1
    view.watch(scene.state)
    view.draw(screen, scene.state, 0.5, 0.0)
    drawn = view.pose(0, 0.5)[2]
    assert 6.2 < drawn < 6.4


def test_marks_are_stamped_by_the_way_and_fade(screen):
    scene = BusyPiTanks()
    (view, _), robot = seen(scene), scene.state.robots[0]
    for _ in range(20):
        robot.x += 6.5
        view.watch(scene.state)
        view.draw(screen, scene.state, 1.0, 0.02)
    assert 8 <= len(view.treads[0].marks) <= 10
    view.draw(screen, scene.state, 1.0, 4.0)
    assert len(view.treads[0].marks) == 0


@pytest.mark.parametrize(("flashes", "shake"), [*itertools.product(("off", "soft", "full"), (False, True))])
def test_only_full_flashes_shake_the_picture(flashes, shake):
    scene = BusyPiTanks()
    view, _ = seen(scene, taste=AllEffects(flashes, shake))
    scene.state.tanks[0].taken = 1
    view.watch(scene.state)
    view.particles.advance(0.02)

    assert (view.particles.offset != (0, 0)) == (flashes == "full" and shake)
    assert len(view.particles.blooms) == {"off": 0, "soft": 1, "full": 2}[flashes]


def test_absent_seats_have_no_panel_and_two_teams_stand_on_their_sides():
    slots, sums = layout(BusyPiTanks((0, 1, -1, -1)).state.robots)
    assert [(slot.seat, slot.x) for slot in slots] == [(0, 492), (1, 1112)]
    assert sums == []

    slots, sums = layout(BusyPiTanks((0, 1, 0, 1)).state.robots)
    assert [slot.seat for slot in slots] == [0, 2, 1, 3]
    assert [panel.team for panel in sums] == [0, 1]
    assert slots[0].x == 160
    assert slots[-1].x + slots[-1].w == 1760
    assert all(a.x + a.w <= b.x for a, b in itertools.pairwise(slots))


@pytest.mark.parametrize(("teams", "seats"), [((1, 0, 1, 0), [1, 3, 0, 2]), ((1, 0, -1, -1), [1, 0])])
def test_the_team_with_the_lower_number_stands_on_the_left(teams, seats):
    slots, sums = layout(BusyPiTanks(teams).state.robots)
    assert [slot.seat for slot in slots] == seats
    assert [panel.team for panel in sums] == ([0, 1] if len(seats) == 4 else [])
    assert [slot.x for slot in slots] == sorted(slot.x for slot in slots)


def test_the_clock_turns_alarm_in_the_last_ten_seconds(screen):
    view, state = seen(BusyPiTanks())
    state.tick = state.rules.ticks - 501
    view.draw(screen, state, 1.0, 0.0)
    calm = pygame.transform.average_color(screen.subsurface((820, 40, 280, 90)))
    state.tick += 1
    view.draw(screen, state, 1.0, 0.0)
    alarm = pygame.transform.average_color(screen.subsurface((820, 40, 280, 90)))
    assert calm[2] >= calm[0]
    assert alarm[0] > 2 * alarm[2]


def test_sprites_are_made_in_slices(screen):
    view, _ = seen(BusyPiTanks((0, 1, -1, -1)))
    slices = 1
    while not view.prewarm(30.0):
        slices += 1
    assert view.prewarm(0.0)
    assert slices < 400


def test_a_preview_shows_every_wall_and_start_at_any_size():
    arena = BusyPiTanks().arena
    for w, h in ((320, 200), (800, 450), (200, 300)):
        image = run_to_end(walls(arena, w, h, False))
        assert image.get_size() == (w, h)
        assert image.get_at((0, 0))[:3] == (0, 0, 0)


PLAYERS = ["human", "level3", "level3", "human"]


def picture(make, state, hurried):
    """A HUD drawn in one go, or a piece a frame."""
    background = Background(lambda: pygame.Surface((1920, 1080), depth=32))
    hud, frames = make(background, state), 0
    with empty_cache():
        while hurried:
            assert (frames := frames + 1) < 200
            try:
                with budget.frame(behind=False), budget.until(0.0):
                    hud.show(state)
                break
            except Unfinished:
                continue
        hud.show(state)
    assert frames > 3 or not hurried, "it was interrupted"
    return pygame.image.tobytes(background.surface, "RGB")


@pytest.mark.parametrize("teams", [(0, 1, 2, 3), (0, 1, 0, 1)])
def test_every_panel_is_there_though_its_pieces_come_one_by_one(teams):
    pygame.font.init()
    state = BusyPiTanks(teams).state

    def hud(background, state):
        return ScoreHud(background, state, PLAYERS)

    assert picture(hud, state, True) == picture(hud, state, False)
