"""The race view: everything is drawn and heard once when it happens, and the race is not modified."""

import json
from dataclasses import replace
from itertools import groupby
from pathlib import Path
from typing import Any

import pygame
import pytest

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.race.course import CoursePosition, locate
from pigaming_app.games.race.state import LINES
from pigaming_app.scenes.bench.busy_race import BusyRace
from pigaming_app.scenes.bench.frame_times import AllEffects
from pigaming_app.scenes.views.games.race import preview
from pigaming_app.scenes.views.particles import MAX_PARTICLES
from pigaming_app.scenes.views.race import ghost as ghosts
from pigaming_app.scenes.views.race import hud_cards as race_cards
from pigaming_app.scenes.views.race.events import SETTLE, SHOWN_FROM
from pigaming_app.scenes.views.race.ghost import Ghost, file_of, ghost_of, load_ghost
from pigaming_app.scenes.views.race.hud import figure
from pigaming_app.scenes.views.race.hud_cards import RaceCard, card_bits
from pigaming_app.scenes.views.race.lines import sign_post
from pigaming_app.scenes.views.race.track import edges
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import DT, HEIGHT, WIDTH
from pigaming_app.storage.safe_files import write_with_backup
from pigaming_app.ui.draw.frame_budget import run_to_end
from pigaming_app.ui.draw.layers import glyph
from pigaming_app.ui.draw.theme import read_large
from pigaming_app.ui.i18n import LANGUAGES, Words, signed
from tests import tags
from tests.cases import one_in

HUMANS = ["human"] * 4
CARD = pygame.Rect(160, 0, 316, 136)


def seen(scene, players=HUMANS, taste=None, language="en"):
    """A view of a match, and its state."""
    effects = taste or AllEffects()
    return SCREENS["race"].view(scene.arena, scene.state, list(players), effects, Words(language)), scene.state


def sounds(view, state):
    return [name for name, _, _ in view.watch(state)]


def shown(screen, view, state, box, seconds=0.0):
    """Pixels of a part of the canvas."""
    view.draw(screen, state, 1.0, seconds)
    return pygame.image.tobytes(screen.subsurface(box), "RGB")


def over(state, seat, w=220, h=130):
    """The area above a robot."""
    robot = state.robots[seat]
    return pygame.Rect(160 + int(robot.x) - w // 2, 140 + int(robot.y) - 40 - h, w, h).clip((0, 0, 1920, 1080))


def put(state, seat, x, y):
    """Place a robot."""
    robot = state.robots[seat]
    robot.x, robot.y = x, y
    locate(state.course, x, y, state.racers[seat].place)


# ---- whole races


@pytest.mark.parametrize("seats", one_in(3, [4, 2, 3]))
@pytest.mark.parametrize("language", one_in(2, LANGUAGES))
def test_a_whole_race_of_any_company_draws_and_leaves_the_race_alone(screen, seats, language):
    scene = BusyRace(seats, laps=1)
    view, _ = seen(scene, ["human", "level1", "level5", "level3"], language=language)
    for tick in range(600):
        scene.tick()
        before = digest(scene.state) if tick % 10 == 0 else ""
        view.watch(scene.state)
        if before:
            view.draw(screen, scene.state, 0.5, 0.2)
            assert digest(scene.state) == before
        assert len(view.particles.particles) <= MAX_PARTICLES


@pytest.mark.parametrize("track", arenas("race"))
def test_every_track_has_its_badges_in_the_mud_beside_it_and_its_edges_in_the_arena(screen, track):
    arena, place = load("race", track), CoursePosition()
    for along in arena.plan.lines:
        x, y = sign_post(arena.plan.course, along)
        locate(arena.plan.course, x, y, place)
        assert not place.on
        assert 24 <= x <= WIDTH - 24
        assert 24 <= y <= HEIGHT - 24
    assert all(0 <= x <= WIDTH and 0 <= y <= HEIGHT for edge in edges(arena.plan.course) for x, y in edge)


def test_the_road_is_black_and_beside_it_lies_mud(screen):
    picture = seen(BusyRace(2))[0].background.bare
    assert picture.get_at((160 + 450, 140 + 80))[:3] == (0, 0, 0)
    red, green, blue, _ = pygame.transform.average_color(picture.subsurface((700, 500, 400, 100)))
    assert red > 1.3 * green > 1.3 * blue


@pytest.mark.usefixtures("_glow")
@pytest.mark.parametrize("track", arenas("race"))
def test_a_preview_shows_the_track_at_any_size(screen, track):
    arena = load("race", track)
    for w, h in ((320, 200), (1000, 640), (200, 300)):
        image = run_to_end(preview(arena, w, h, False))
        assert image.get_size() == (w, h)
        assert max(pygame.transform.average_color(image)[:3]) > 8


# ---- sounds


def test_a_race_is_heard_from_the_first_line_to_the_last():
    scene = BusyRace(2, laps=2)
    (view, _), racer, robot = seen(scene), scene.state.racers[0], scene.state.robots[0]
    racer.passed = 1
    assert sounds(view, scene.state) == []
    racer.passed, racer.missed = 3, 4
    assert sounds(view, scene.state) == ["missed"]
    assert sounds(view, scene.state) == []
    racer.void = 1
    assert sounds(view, scene.state) == ["missed"]
    racer.missed, racer.passed, robot.score, racer.last_lap, racer.best_lap = 0, 5, 1, 500.0, 500.0
    assert sounds(view, scene.state) == ["last_lap"]
    racer.passed, robot.score, racer.last_lap, racer.best_lap = 9, 2, 480.0, 480.0
    racer.finished, racer.rank = 1, 1
    assert sounds(view, scene.state) == ["finish"]
    assert sounds(view, scene.state) == []


def test_a_lap_and_a_better_one_sound_different():
    scene = BusyRace(2, laps=5)
    (view, _), racer, robot = seen(scene), scene.state.racers[1], scene.state.robots[1]
    for passed, lap, best, sound in (
        (5, 520.0, 520.0, "lap"),
        (9, 500.0, 500.0, "best_lap"),
        (13, 510.0, 500.0, "lap"),
    ):
        racer.passed, racer.last_lap, racer.best_lap, robot.score = passed, lap, best, passed // LINES
        assert view.watch(scene.state) == [(sound, 1, robot.x)]


def test_mud_is_heard_on_the_way_in_and_flies_while_one_drives():
    view, state = seen(BusyRace(2))
    view.watch(state)
    put(state, 0, 800.0, 450.0)
    assert sounds(view, state) == ["mud"]
    assert sounds(view, state) == []
    state.robots[0].linear = 100.0
    before = len(view.particles.particles)
    assert sounds(view, state) == []
    assert len(view.particles.particles) > before


# ---- signs


def test_the_wrong_way_is_said_after_half_a_second_and_no_longer_than_it_lasts(screen):
    view, state = seen(BusyRace(2))
    put(state, 0, 1484.0, 560.0)
    sounds(view, state)
    calm = shown(screen, view, state, over(state, 0))
    state.racers[0].wrong = SHOWN_FROM
    assert sounds(view, state) == []
    assert shown(screen, view, state, over(state, 0)) == calm
    state.racers[0].wrong += 1
    assert sounds(view, state) == ["wrong_way"]
    assert shown(screen, view, state, over(state, 0)) != calm
    state.racers[0].wrong = 0
    assert sounds(view, state) == []
    assert shown(screen, view, state, over(state, 0)) == calm


def test_a_missed_line_is_on_the_card_over_the_robot_and_where_it_must_be_entered(screen):
    view, state = seen(BusyRace(4))
    put(state, 0, 1484.0, 560.0)
    view.watch(state)
    entry = pygame.Rect(160 + 800 + 20, 140 + 640, 110, 80)  # line 3 is driven from right to left
    boxes = (CARD, over(state, 0), entry)
    calm = [shown(screen, view, state, box) for box in boxes]
    state.racers[0].missed = 3
    view.watch(state)
    view.draw(screen, state, 1.0, 5.0)
    view.particles.particles.clear()
    assert all(shown(screen, view, state, box) != old for box, old in zip(boxes, calm, strict=True))
    third = shown(screen, view, state, over(state, 0))
    state.racers[0].missed = 4
    view.watch(state)
    view.draw(screen, state, 1.0, 5.0)
    assert shown(screen, view, state, over(state, 0)) != third
    state.racers[0].missed = 0
    view.watch(state)
    view.draw(screen, state, 1.0, 5.0)
    assert [shown(screen, view, state, box) for box in boxes] == calm


def test_a_lap_that_did_not_count_says_so_for_a_while_and_then_only_what_was_missed(screen):
    view, state = seen(BusyRace(2))
    put(state, 0, 800.0, 560.0)
    state.racers[0].missed = 2
    view.watch(state)
    view.draw(screen, state, 1.0, 5.0)
    words = over(state, 0, 300, 230)
    only = pygame.transform.average_color(screen.subsurface(words))
    state.racers[0].void = 1
    view.watch(state)
    view.draw(screen, state, 1.0, 0.02)
    assert sum(pygame.transform.average_color(screen.subsurface(words))[:3]) > sum(only[:3])
    view.draw(screen, state, 1.0, 5.0)
    assert sum(pygame.transform.average_color(screen.subsurface(words))[:3]) < sum(only[:3]) + 9


@pytest.mark.parametrize("y", [80.0, 560.0])
def test_signs_stay_in_the_picture(screen, y):
    view, state = seen(BusyRace(2))
    put(state, 0, 40.0, y)
    state.racers[0].missed, state.racers[0].void = 2, 1
    view.watch(state)
    batch: list[Any] = []
    assert view._sign(batch, state, 0, view.pose(0, 1.0))
    (image, at), *_ = batch
    assert pygame.Rect(160, 136, 1600, 944).contains(image.get_rect(topleft=at))


def test_a_place_is_shown_where_one_finished_for_a_while_and_again_in_the_end(screen):
    view, state = seen(BusyRace(2))
    put(state, 0, 800.0, 560.0)
    racer = state.racers[0]
    racer.finished, racer.finish, racer.rank, state.first = 1, 0.0, 1, 1
    view.watch(state)
    batch: list[Any] = []
    assert view._sign(batch, state, 0, view.pose(0, 1.0))
    state.tick = 301
    assert not view._sign(batch, state, 0, view.pose(0, 1.0))
    state.over = 1
    assert view._sign(batch, state, 0, view.pose(0, 1.0))


# ---- cards


def test_cards_run_in_order_and_change_places_only_when_an_order_holds(screen):
    view, state = seen(BusyRace(4))
    assert view.detector.order == [0, 1, 2, 3]
    for tick in range(3 * SETTLE):  # two robots side by side
        state.tick += 1
        state.racers[0].rank, state.racers[1].rank = (1, 2) if tick // 5 % 2 else (2, 1)
        view.watch(state)
    assert view.detector.order == [0, 1, 2, 3]
    state.racers[0].rank, state.racers[1].rank = 2, 1
    for _ in range(SETTLE + 1):
        state.tick += 1
        view.watch(state)
    assert view.detector.order == [1, 0, 2, 3]
    assert view.cards.moves[1][0] == 1
    assert view.cards.moves[0][0] == -1


def test_the_one_behind_is_as_many_seconds_behind_as_ago_the_leader_was_there():
    view, state = seen(BusyRace(2))
    leader, other = state.racers[:2]
    for _ in range(300):  # 100 px/s, the other robot 250 px behind
        state.tick += 1
        leader.progress, other.progress = 2.0 * state.tick, 2.0 * state.tick - 250.0
        view.watch(state)
    assert view.cards.gaps.gap(state, 1) == pytest.approx(2.5)
    assert view.cards.gaps.gap(state, 0) == 0.0
    leader.finished, leader.finish = 1, 400.0
    other.finished, other.finish = 1, 561.0
    assert view.cards.gaps.gap(state, 1) == pytest.approx(3.22), "after the finish, to the winner"


def test_a_gap_is_no_longer_than_four_characters():
    texts = {0.0: "0.0", 0.04: "0.0", 9.94: "+9.9", 9.96: "+10", 42.4: "+42", 599.9: "+600", -0.1: "0.0"}
    assert {seconds: figure(seconds) for seconds in texts} == texts


@pytest.mark.parametrize(("language", "gap"), [("en", "+2.5"), ("pt", "+2,5")])
def test_cards_show_place_lap_and_gap(screen, language, gap):
    view, state = seen(BusyRace(3, laps=5), language=language)
    state.robots[1].score = 3
    for _ in range(300):
        state.tick += 1
        for seat, behind in enumerate((0.0, 250.0, 4200.0)):
            state.racers[seat].progress = 2.0 * state.tick - behind
        view.watch(state)
    view.draw(screen, state, 1.0, 0.02)
    first, second, third = (view.cards.parts.shown[x] for x in view.cards.xs)
    assert (first.place, first.gap) == (1, "")
    assert (second.place, second.lap, second.laps, second.gap) == (2, 4, 5, gap)
    assert third.gap == "+6.0".replace(".", gap[2]), "since the start"


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("gap", ["+0.0", "+9.9", "+99", "+600"])
def test_the_figures_of_a_card_stand_apart_and_read_at_three_metres(screen, language, gap):
    words = Words(language)
    for place in range(1, 5):
        card = RaceCard(0, "human", place, 9, words.decimal(gap), 64, 9, "", 0, 1, False)
        picture = pygame.Surface((race_cards.W, 136))
        for image, at, area in card_bits(card, 0)[1:]:
            picture.blit(image, at, area, special_flags=pygame.BLEND_RGB_ADD)
        figures = columns(picture.subsurface((0, 34 + 26, race_cards.W, 46)))
        assert len(figures) >= 3, figures
        assert figures[0][0] >= 8
        assert figures[-1][1] <= race_cards.W - 8
    for size in (race_cards.PLACE, race_cards.FIGURE):
        assert glyph("4", size, (255, 255, 255), 0.0)[0].image.get_height() >= 40


@pytest.mark.parametrize("large", [False, True])
@pytest.mark.parametrize("place", [1, 2, 3, 4])
def test_a_card_has_three_figures_with_air_between_them(screen, large, place):
    """Place, lap of laps, seconds behind, as in 2/5 +0.5; no word beside them."""
    read_large(large)
    try:
        card = RaceCard(0, "human", place, 2, "+0.5", 64, 5, "", 0, 0, False)
        picture = pygame.Surface((race_cards.W, 136))
        for image, at, area in card_bits(card, 0)[1:]:
            picture.blit(image, at, area, special_flags=pygame.BLEND_RGB_ADD)
    finally:
        read_large(False)
    row = picture.subsurface((0, 34 + race_cards.row() - 22, race_cards.W, 44))
    bright = pygame.surfarray.array3d(row).max(axis=(1, 2)) > 150
    runs = [len(list(run)) for lit, run in groupby(bright[20:-20]) if not lit]
    least = 12 if large else 18
    assert sum(run >= least for run in runs) >= 2, runs


def columns(picture):
    """Ranges of columns with bright ink, separated by at least 6 dark px."""
    bright = [
        any(max(picture.get_at((x, y))[:3]) > 150 for y in range(picture.get_height()))
        for x in range(picture.get_width())
    ]
    ranges: list[list[int]] = []
    for x in (x for x, lit in enumerate(bright) if lit):
        if ranges and x - ranges[-1][1] <= 8:
            ranges[-1][1] = x
        else:
            ranges.append([x, x])
    return ranges


def test_the_clock_counts_up_and_then_down_for_those_who_still_race(screen):
    view, state = seen(BusyRace(3))
    box = pygame.Rect(820, 0, 280, 136)
    state.tick = 500
    shown(screen, view, state, box)
    calm = pygame.transform.average_color(screen.subsurface(box))
    state.racers[0].finished, state.first = 1, 499
    first = shown(screen, view, state, box)
    alarm = pygame.transform.average_color(screen.subsurface(box))
    assert calm[2] >= calm[0]
    assert alarm[0] > 1.3 * alarm[2]
    state.tick += 50
    assert shown(screen, view, state, box) != first


@pytest.mark.parametrize("flashes", ["off", "soft", "full"])
def test_without_flashes_nothing_lights_up(flashes):
    view, state = seen(BusyRace(2), taste=AllEffects(flashes, False))
    state.racers[0].finished, state.racers[0].passed = 1, 13
    view.watch(state)
    assert len(view.particles.blooms) == {"off": 0, "soft": 1, "full": 2}[flashes]


def test_sprites_are_made_in_slices(screen):
    view, _ = seen(BusyRace(2))
    slices = 1
    while not view.prewarm(30.0):
        slices += 1
    assert view.prewarm(0.0)
    assert slices < 400


# ---- ghosts

CROSSED = (0.0, 3.0, 5.0, 8.0)


def a_ghost(seconds: float = 10.0, line: int = 0) -> Ghost:
    """A lap around a square, one side per line."""
    poses = tuple((10.0 * i, 100.0, 0.0) for i in range(int(seconds * 10) + 1))
    return Ghost(line, seconds, CROSSED, poses)


def drive_laps(scene, view, seat, laps, first=100):
    """Drive laps of a given number of ticks, one line per quarter."""
    state = scene.state
    racer, robot = state.racers[seat], state.robots[seat]
    for number, ticks in enumerate((first, *laps)):
        for tick in range(ticks):
            state.tick += 1
            robot.x, robot.y, robot.heading = 200.0 + tick, 300.0, 0.5
            if number and tick and tick % (ticks // LINES) == 0 and racer.passed % LINES:
                racer.splits[racer.passed % LINES] = float(tick)
                racer.passed += 1
            view.watch(state)
        racer.passed += 1
        if number:
            racer.last_lap = float(ticks)
            racer.best_lap = min(racer.best_lap or 1e9, racer.last_lap)
            racer.best_splits[:] = racer.splits
            robot.score += 1
        racer.lap_start = float(state.tick)


def test_a_ghost_is_where_it_was_on_every_line():
    ghost = a_ghost()
    assert [ghost.since(0, k) for k in range(5)] == [0.0, 3.0, 5.0, 8.0, 10.0]
    assert [ghost.since(2, k) for k in range(5)] == [0.0, 3.0, 5.0, 8.0, 10.0]
    assert ghost.pose(0, 2.55) == pytest.approx((255.0, 100.0, 0.0))
    assert ghost.pose(1, 1.0) == pytest.approx((400.0, 100.0, 0.0))  # line 1 lies 3 s after line 0
    assert ghost.pose(3, 9.0) == pytest.approx((700.0, 100.0, 0.0))
    assert ghost.pose(0, -0.1) is None
    assert ghost.pose(0, 10.1) is None


def test_a_ghost_turns_the_short_way():
    ghost = ghost_of(0, 1.0, (0, 0.2, 0.4, 0.6), [(-0.01, (0.0, 0.0, 6.2)), (1.01, (102.0, 0.0, 0.1))])
    assert len(ghost.poses) == 11
    assert ghost.poses[5] == pytest.approx((51.0, 0.0, 6.2 + (0.1 - 6.2 + 6.283185) / 2), abs=0.1)


def test_a_kept_ghost_comes_back_and_another_track_of_that_name_has_none(tmp_path):
    arena = BusyRace(2).arena
    assert load_ghost(tmp_path, arena) == (None, "")
    ghosts.save_ghost(tmp_path, arena, a_ghost()).join()
    assert load_ghost(tmp_path, arena) == (a_ghost(), "")
    other = load("race", "kidney")
    assert file_of(tmp_path, arena).name.startswith("classic-")
    assert load_ghost(tmp_path, other) == (None, "")


def test_ghosts_are_cleared_with_the_scores(tmp_path):
    arena = BusyRace(2).arena
    for seconds in (12.0, 10.0):  # the second leaves a .bak
        ghosts.save_ghost(tmp_path, arena, a_ghost(seconds)).join()
    ghosts.delete_ghosts(tmp_path)
    assert load_ghost(tmp_path, arena) == (None, "")
    assert list((tmp_path / "ghosts").iterdir()) == []
    ghosts.delete_ghosts(tmp_path / "nowhere")


def test_a_ghost_of_another_engine_is_shown_if_todays_robots_could_drive_its_lap(monkeypatch):
    folder, arena = tags.FOLDER / "2.0.0", load("race", "classic")
    monkeypatch.setattr(ghosts, "engine_hash", lambda: "another")
    ghost, trouble = load_ghost(folder, arena)
    assert trouble == ""
    assert ghost
    assert ghost.seconds == 8.3718
    assert ghosts.drivable(ghost, arena)
    assert not ghosts.drivable(replace(ghost, crossed=(0.0, 1.0, 2.0, 3.0)), arena)
    monkeypatch.setattr(ghosts, "SLACK", 0.5)  # as if robots were half as fast
    assert not ghosts.drivable(ghost, arena)
    assert load_ghost(folder, arena) == (None, "old")


def test_a_ghost_of_another_engine_that_no_robot_could_drive_is_dropped_with_a_word(screen, tmp_path, caplog):
    scene = BusyRace(2)
    ghosts.save_ghost(tmp_path, scene.arena, a_ghost()).join()
    path = file_of(tmp_path, scene.arena)
    write_with_backup(path, json.dumps({**json.loads(path.read_text()), "engine": "of old"}))
    view, _ = seen(scene)
    view.enable_persistence(tmp_path)
    assert view.recorder.ghost is None
    assert view.recorder.drop_reason == "old"
    assert "no robot can drive this lap" in caplog.text
    word = pygame.Rect(400, 1040, 1120, 40)
    notice = shown(screen, view, scene.state, word)
    assert notice != shown(screen, view, scene.state, word, 9.0)


@pytest.mark.parametrize("text", ["", "no ghost", "[1]", '{"engine": "x"}', "{}", '{"engine":1e999}'])
def test_a_damaged_ghost_is_put_aside_with_a_word(tmp_path, text, caplog):
    arena = BusyRace(2).arena
    path = file_of(tmp_path, arena)
    path.parent.mkdir()
    path.write_text(text)
    assert load_ghost(tmp_path, arena) == (None, "lost")
    assert not path.exists()
    assert "cannot be read" in caplog.text


@pytest.mark.parametrize(
    "harm",
    [
        {"line": 4},
        {"line": "0"},
        {"seconds": 0.0},
        {"seconds": "ten"},
        {"crossed": [0, 1, 2]},
        {"crossed": [0, 1, 2, None]},
        {"poses": []},
        {"poses": [[1, 2]]},
        {"poses": 7},
    ],
)
def test_a_ghost_that_is_not_whole_is_none(tmp_path, harm):
    arena = BusyRace(2).arena
    ghosts.save_ghost(tmp_path, arena, a_ghost()).join()
    path = file_of(tmp_path, arena)
    path.write_text(json.dumps({**json.loads(path.read_text()), **harm}))
    assert load_ghost(tmp_path, arena) == (None, "lost")


def test_a_better_lap_of_a_person_becomes_the_ghost_and_a_worse_one_does_not(tmp_path):
    scene = BusyRace(2, laps=5)
    scene.state.racers[0].line = 2
    view, _ = seen(scene)
    view.enable_persistence(tmp_path)
    drive_laps(scene, view, 0, [600, 500, 550])
    scene.state.tick += 1
    view.watch(scene.state)
    view.recorder.writer.join()
    saved, _ = load_ghost(tmp_path, scene.arena)
    assert saved
    assert saved == view.recorder.ghost
    assert saved.seconds == 10.0
    assert saved.line == 2
    assert saved.crossed == (0.0, 2.5, 5.0, 7.5)
    assert len(saved.poses) == 101
    assert saved.poses[50] == pytest.approx((200.0 + 249.0, 300.0, 0.5), abs=2.0)


def test_laps_of_machines_and_laps_that_a_machine_took_over_are_not_kept(tmp_path):
    scene = BusyRace(2, laps=5)
    players = ["level5", "human", "off", "off"]
    view: Any = SCREENS["race"].view(scene.arena, scene.state, players, AllEffects(), Words("en"))
    view.enable_persistence(tmp_path)
    drive_laps(scene, view, 0, [600, 500])
    view.watch(scene.state)
    assert view.recorder.ghost is None

    players[1] = "level3"  # the shell's list: a person's pad was disconnected
    view.players[1] = "level3"
    drive_laps(scene, view, 1, [400])
    view.players[1] = "human"
    view.watch(scene.state)
    assert view.recorder.ghost is None
    assert not (tmp_path / "ghosts").exists()


@pytest.mark.parametrize(("line", "x"), [(1, 400.0), (3, 900.0)])
def test_the_ghost_starts_with_every_lap_of_the_first_person_and_ends_with_its_own(screen, tmp_path, line, x):
    """`x`: where the ghost is 1 s after that line."""
    scene = BusyRace(2, laps=5)
    scene.state.racers[1].line = line
    ghosts.save_ghost(tmp_path, scene.arena, a_ghost()).join()
    view, _ = seen(scene, ["level5", "human", "off", "off"])
    view.enable_persistence(tmp_path)
    state, racer = scene.state, scene.state.racers[1]
    assert view.recorder.pose(state, 1.0) is None  # it waits for the line
    racer.passed, racer.lap_start, state.tick = 1, 100.0, 150
    assert view.recorder.pose(state, 1.0) == pytest.approx((x, 100.0, 0.0))
    box = (160 + int(x) - 40, 140 + 100 - 40, 80, 80)
    with_ghost = shown(screen, view, state, box)
    state.tick = 100 + 501
    assert view.recorder.pose(state, 1.0) is None
    assert shown(screen, view, state, box) != with_ghost


def test_a_golden_difference_compares_with_the_ghost_from_line_to_line(screen, tmp_path):
    scene = BusyRace(2, laps=5)
    ghosts.save_ghost(tmp_path, scene.arena, a_ghost()).join()
    view, _ = seen(scene)
    view.enable_persistence(tmp_path)
    state, racer = scene.state, scene.state.racers[1]
    racer.passed, racer.lap_start, racer.line, state.tick = 1, 100.0, 1, 150
    view.watch(state)
    racer.passed, racer.splits[1], state.tick = 2, 90.0, 192  # line 2 follows line 1 after 2 s, 100 ticks
    view.watch(state)
    assert view.recorder.ghost_deltas[1] == (pytest.approx(-10.0), 192)
    assert [note.text for note in view.notes.notes] == ["−0.20"]
    assert (signed(-0.31, 2), signed(0.31, 2), signed(0.002, 2)) == ("−0.31", "+0.31", "0.00")


def test_without_a_person_there_is_no_ghost_and_no_file(tmp_path):
    scene = BusyRace(2)
    view, _ = seen(scene, ["level5", "level1", "off", "off"])
    assert view.recorder is None
    for _ in range(50):
        scene.tick()
        view.watch(scene.state)
    assert list(Path(tmp_path).iterdir()) == []
    assert DT == 0.02
