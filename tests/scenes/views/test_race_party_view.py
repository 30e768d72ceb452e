"""The view of a party race: what lies on the course, what each robot holds, and how robots come back to the track."""

from math import hypot
from typing import Any

import pygame
import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.race.course import locate, point_at
from pigaming_app.games.race.state import LINES, OIL, OWN_OILS, SHIELD, TURBO
from pigaming_app.scenes.bench.busy_race import BusyRace
from pigaming_app.scenes.bench.frame_times import AllEffects
from pigaming_app.scenes.views.particles import MAX_PARTICLES
from pigaming_app.scenes.views.race.lines import CHECKPOINT, START, line_signs
from pigaming_app.scenes.views.race.party.events import AGAIN
from pigaming_app.scenes.views.race.party.floor import robot_ahead
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import DT, HZ
from pigaming_app.ui.draw import PLAYERS
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.i18n import LANGUAGES, Words
from tests.cases import one_in
from tests.matches import match_of

CARD = pygame.Rect(160, 0, 316, 136)
CLOCK = pygame.Rect(820, 0, 280, 136)


def seen(scene, flashes="full", language="en"):
    return SCREENS["race"].view(scene.arena, scene.state, ["human"] * 4, AllEffects(flashes, True), Words(language))


def party(seats=4, laps=5):
    """A party race in which nothing has happened yet, and its view."""
    scene = BusyRace(seats, laps=laps, variant="party")
    return scene.state, seen(scene)


def sounds(view, state):
    """The sounds of the next tick."""
    state.tick += 1
    return sorted(name for name, _, _ in view.watch(state))


def shown(screen, view, state, box, seconds=0.0):
    view.draw(screen, state, 1.0, seconds)
    return pygame.image.tobytes(screen.subsurface(box), "RGB")


def put(state, seat, x, y, heading=0.0):
    robot = state.robots[seat]
    robot.x, robot.y, robot.heading = x, y, heading
    locate(state.course, x, y, state.racers[seat].place)


def around(x, y, r=60):
    return pygame.Rect(160 + int(x) - r, 140 + int(y) - r, 2 * r, 2 * r).clip((0, 0, 1920, 1080))


# ---- whole races


@pytest.mark.long
@pytest.mark.parametrize("language", LANGUAGES)
def test_a_whole_party_draws_and_leaves_the_race_alone(screen, language):
    scene = BusyRace(laps=1, variant="party")
    view = seen(scene, language=language)
    for tick in range(600):
        scene.tick()
        before = digest(scene.state)
        view.watch(scene.state)
        if tick % 25 == 0:
            view.draw(screen, scene.state, 0.5, 0.5)
        assert digest(scene.state) == before
        assert len(view.particles.particles) <= MAX_PARTICLES


@pytest.mark.long
def test_the_busiest_party_builds_no_sprite_after_the_countdown(screen):
    scene = BusyRace(laps=9, variant="party")
    view = seen(scene)
    while not view.prewarm(1000.0):
        pass
    view.draw(screen, scene.state, 1.0, 0.02)
    made = surfaces._insertions
    for _ in range(250):
        scene.tick()
        view.watch(scene.state)
        view.draw(screen, scene.state, 1.0, 0.02)
    assert surfaces._insertions - made <= 4, "sprites of the course and its robots are prewarmed"


# ---- lines


@pytest.mark.parametrize("seed", range(3))
def test_each_line_has_the_colour_of_the_seat_that_was_dealt_it(screen, seed):
    match = match_of("race", ["random"] * 4, "classic", 10.0, seed, "standard", 3)
    view: Any = SCREENS["race"].view(match.arena, match.state, ["random"] * 4, AllEffects(), Words("en"))
    for seat, racer in enumerate(match.state.racers):
        line = match.state.lines[racer.line]
        tint = average(view.background.surface, (line.ax + line.bx) / 2, (line.ay + line.by) / 2)
        assert nearest_player(tint) == seat
        assert view.signs[racer.line] == seat


def average(surface, x, y, r=20):
    return pygame.transform.average_color(surface, pygame.Rect(160 + x - r, 140 + y - r, 2 * r, 2 * r))[:3]


def nearest_player(tint):
    """The player whose colour has the proportions of a tint."""

    def off(color):
        return sum((a / max(tint) - b / max(color)) ** 2 for a, b in zip(tint, color, strict=True))

    return min(range(4), key=lambda seat: off(PLAYERS[seat]))


@pytest.mark.parametrize("track", one_in(4, arenas("race")))
def test_party_has_one_start_and_lettered_checkpoints_in_driving_order(track):
    state = match_of("race", ["random"] * 4, track, 10.0, 1, "party", 5).state
    signs = line_signs(state)
    first = signs.index(START)
    assert {racer.line for racer in state.racers} == {first}
    assert [signs[(first + i) % LINES] for i in range(LINES)] == [START, *range(CHECKPOINT, CHECKPOINT + 3)]


def test_checkpoints_of_a_party_have_no_colour_of_a_player(screen):
    state, view = party()
    for i, sign in enumerate(view.signs):
        if sign >= CHECKPOINT:
            line = state.lines[i]
            red, green, blue = average(view.background.surface, (line.ax + line.bx) / 2, (line.ay + line.by) / 2)
            assert 0 < max(red, green, blue) < 2 * min(red, green, blue)


# ---- the course


def test_pads_move_boxes_go_and_come_and_oil_dries_up(screen):
    state, view = party()
    pad, box, oil = state.pads[0], state.boxes[0], state.oils[OWN_OILS]
    waves = {shown(screen, view, state, around(pad.x, pad.y, 40), 0.1) for _ in range(7)}
    assert len(waves) > 4
    there = shown(screen, view, state, around(box.x, box.y, 40))
    box.pause = 100
    gone = shown(screen, view, state, around(box.x, box.y, 40))
    assert sum(gone) < 0.4 * sum(there)
    x, y = point_at(state.course, 1800.0, 0.0)
    oil.x, oil.y = x, y
    light = []
    for alive in (0, HZ // 2, 20 * HZ):
        oil.alive = alive
        light.append(sum(shown(screen, view, state, around(x, y, 40))))
    assert light == sorted(set(light))


def test_an_item_is_on_its_owners_card_until_it_is_used(screen):
    state, view = party()
    state.racers[0].rank = 1
    empty = shown(screen, view, state, CARD)
    cards = set()
    for item in (TURBO, SHIELD, OIL):
        state.racers[view.detector.order[0]].item = item
        cards.add(shown(screen, view, state, CARD))
    assert len(cards | {empty}) == 4
    state.racers[view.detector.order[0]].item = 0
    assert shown(screen, view, state, CARD) == empty


def test_there_is_no_place_for_items_on_the_cards_of_a_standard_race():
    scene = BusyRace(2)
    view = seen(scene)
    view.cards.show(scene.state, view.detector.order)
    assert view.cards.parts.shown[view.cards.xs[0]].item == "none"


def test_air_flows_between_a_robot_and_the_one_ahead_and_the_meter_is_white(screen):
    state, view = party(2)
    put(state, 0, 600.0, 116.0)
    put(state, 1, 780.0, 116.0)
    assert robot_ahead(state, 0) == 1
    assert robot_ahead(state, 1) is None
    view.watch(state)
    view.watch(state)
    between = pygame.Rect(160 + 670, 140 + 80, 30, 72)
    calm = shown(screen, view, state, between)
    x = view.cards.xs[view.detector.order.index(0)]
    card = shown(screen, view, state, pygame.Rect(x, 0, 316, 136))
    state.racers[0].slip = 1
    assert sum(shown(screen, view, state, between)) > sum(calm)
    assert shown(screen, view, state, pygame.Rect(x, 0, 316, 136)) != card
    put(state, 1, 1100.0, 116.0)
    assert robot_ahead(state, 0) is None, "out of reach"


# ---- sounds and announcements


def test_everything_of_a_party_is_heard_once():
    state, view = party()
    racer = state.racers[0]
    assert sounds(view, state) == []
    racer.item = OIL
    assert sounds(view, state) == ["pickup"]
    racer.item = 0
    assert sounds(view, state) == ["drop"]
    racer.surge = 20
    assert sounds(view, state) == ["boost"]
    racer.surge = 19
    assert sounds(view, state) == []
    racer.spin = 50
    assert sounds(view, state) == ["oil"]
    racer.spin, racer.shield = 0, 300
    assert sounds(view, state) == []
    racer.shield = 0
    assert sounds(view, state) == ["shield"]


def test_a_slipstream_is_heard_again_only_after_a_second_without_one():
    state, view = party()
    heard = []
    for slip in [1] * 5 + [0] * (AGAIN // 2) + [1] * 5 + [0] * (AGAIN + 1) + [1]:
        state.racers[2].slip = slip
        heard += sounds(view, state)
    assert heard == ["slipstream", "slipstream"]


def test_a_shield_that_runs_out_resists_nothing():
    state, view = party()
    state.racers[0].shield = 2
    view.watch(state)
    state.racers[0].shield = 1
    view.watch(state)
    state.racers[0].shield = 0
    assert sounds(view, state) == []


@pytest.mark.parametrize("variant", ["party", "standard"])
def test_overtaking_is_heard_and_marked_in_party_only(variant):
    scene = BusyRace(2, variant=variant)
    state, view = scene.state, seen(scene)
    before = list(view.detector.order)
    state.racers[before[0]].rank, state.racers[before[1]].rank = 2, 1
    heard = [name for _ in range(20) for name in sounds(view, state)]
    assert view.detector.order == before[::-1]
    assert heard == (["overtake"] if variant == "party" else [])
    assert len(view.notes.notes) == (2 if variant == "party" else 0)


def test_the_last_lap_stands_in_place_of_the_clock_once(screen):
    state, view = party(laps=2)
    clock = shown(screen, view, state, CLOCK)
    leader = view.detector.order[0]
    state.racers[leader].passed, state.robots[leader].score = 5, 1
    assert sounds(view, state) == ["last_lap"]
    assert view.party.final
    assert shown(screen, view, state, CLOCK) != clock
    other = view.detector.order[1]
    state.tick += 200
    state.racers[other].passed, state.robots[other].score = 5, 1
    view.watch(state)
    assert view.cards.notice[1] == 1, "only the first one is announced there"
    x, y = state.lines[state.racers[0].line].ax, state.lines[state.racers[0].line].ay + 60.0
    pulses = {shown(screen, view, state, around(x, y, 30), 0.1) for _ in range(6)}
    assert len(pulses) > 2, "the finish line pulses"


@pytest.mark.parametrize(("behind", "close"), [(0.08, True), (0.5, True), (0.52, False), (4.0, False)])
def test_finishes_within_half_a_second_are_announced_with_the_difference(behind, close):
    state, view = party(2)
    first, second = state.racers[:2]
    first.finished, first.finish, first.rank, state.first = 1, 1000.0, 1, 1000
    assert "photo_finish" not in sounds(view, state)
    second.finished, second.finish, second.rank = 1, 1000.0 + behind / DT, 2
    assert ("photo_finish" in sounds(view, state)) == close
    lines = view.cards.notice[0].replace("|", " ")
    assert (f"{behind:.2f}" in lines) == close


def test_party_keeps_no_ghosts(tmp_path):
    _, view = party()
    view.enable_persistence(tmp_path)
    assert view.recorder is None


# ---- back to the track


def ask(state, seat, x, y):
    """The game asks for a robot to be put at (x, y)."""
    robot = state.robots[seat]
    robot.recover, robot.recover_x, robot.recover_y, robot.recover_heading = 1, x, y, 0.0


@pytest.mark.parametrize("variant", ["standard", "party"])
@pytest.mark.parametrize(("flashes", "blooms"), [("off", 0), ("soft", 1)])
def test_a_simulated_robot_appears_in_a_beam(variant, flashes, blooms):
    scene = BusyRace(2, variant=variant)
    state, view = scene.state, seen(scene, flashes)
    put(state, 0, 800.0, 450.0)
    view.watch(state)
    view.watch(state)
    ask(state, 0, 900.0, 116.0)
    state.robots[0].recover = 0
    put(state, 0, 900.5, 116.0)
    assert "back_on_track" in sounds(view, state)
    assert len(view.particles.blooms) == blooms
    assert sounds(view, state) == []


def test_a_robot_that_turns_where_it_stands_is_back_too():
    state, view = party(2)
    put(state, 0, 900.0, 116.0, 3.1)
    view.watch(state)
    view.watch(state)
    ask(state, 0, 900.0, 116.0)
    state.robots[0].recover = 0
    put(state, 0, 900.2, 116.0, 0.02)
    assert sounds(view, state) == ["back_on_track"]


def test_a_robot_that_is_carried_somewhere_else_is_not_back():
    state, view = party(2)
    ask(state, 0, 900.0, 116.0)
    state.robots[0].recover = 0
    view.watch(state)
    put(state, 0, 500.0, 116.0)
    assert "back_on_track" not in sounds(view, state)


def test_a_real_robot_is_shown_the_way_until_it_is_back(screen):
    state, view = party(2)
    view.real = frozenset({0})
    put(state, 0, 400.0, 450.0)
    sounds(view, state)
    middle = pygame.Rect(160 + 650, 140 + 430, 60, 40)
    view.draw(screen, state, 1.0, 5.0)
    calm = shown(screen, view, state, middle)
    ask(state, 0, 1000.0, 450.0)
    assert sounds(view, state) == ["back_on_track"]
    assert sounds(view, state) == []
    dots = {shown(screen, view, state, middle, 0.1) for _ in range(4)}
    assert calm not in dots
    assert len(dots) > 1, "they move"
    assert shown(screen, view, state, around(1000.0, 450.0, 60)) != calm
    state.robots[0].recover = 0
    put(state, 0, 405.0, 450.0)
    assert sounds(view, state) == ["back_on_track"]
    assert not view.particles.blooms, "no beam for a real robot"
    view.draw(screen, state, 1.0, 5.0)
    assert shown(screen, view, state, middle) == calm


@pytest.mark.parametrize(("lost", "ticks"), [(1, 75), (3, 75), (2, 0), (4, 0)])
def test_somebody_who_is_lost_gets_a_hint_after_a_while(lost, ticks):
    state, view = party(2)
    state.racers[0].lost = lost
    for _ in range(ticks):
        view.watch(state)
    assert view.hints == {}
    view.watch(state)
    assert view.hints == {0: "race.back_hint"}
    state.robots[0].recover = 1
    view.watch(state)
    assert view.hints == {}, "it has asked already"
    state.robots[0].recover, state.racers[0].lost = 0, 0
    view.watch(state)
    assert view.hints == {}


def test_announcements_keep_off_robots_at_the_upper_edge(screen):
    for y, side in ((60.0, 1), (600.0, -1)):
        state, view = party(2)
        put(state, 0, 800.0, y)
        view.watch(state)
        view.notes.add(0.0, 0, "1.00", (255, 255, 255))
        light, top = list[Any](), list[Any]()
        view.notes.draw(light, top, [view.pose(seat, 1.0) for seat in range(4)], 0.5, set())
        middles = [at[1] + image.get_height() / 2 - 140 for image, at in light]
        assert all((middle - y) * side > 50 for middle in middles)
        assert all(hypot(middle - y, 0) < 200 for middle in middles)


def test_a_robot_shows_only_its_last_change_of_place(screen):
    state, view = party(2)
    first, second = view.detector.order
    for ranks in ((2, 1), (1, 2), (2, 1)):
        state.racers[first].rank, state.racers[second].rank = ranks
        for _ in range(20):
            state.tick += 1
            view.watch(state)
    assert sorted(note.seat for note in view.notes.notes) == [0, 1]


@pytest.mark.parametrize("last", range(4))
def test_pads_of_draft_shine_in_the_colour_of_the_last(screen, last):
    scene = BusyRace(variant="draft")
    state, view = scene.state, seen(scene)
    for seat, racer in enumerate(state.racers):
        racer.rank = (seat - last) % 4 or 4
    pad = state.pads[0]
    for robot in state.robots:
        robot.x, robot.y = pad.x + 400.0, pad.y + 200.0
    view.draw(screen, state, 1.0, 0.0)
    box = around(pad.x, pad.y, 40)
    pixels = [screen.get_at((x, y))[:3] for x in range(box.left, box.right) for y in range(box.top, box.bottom)]
    bright = max(pixels, key=lambda pixel: max(pixel) - min(pixel))  # the road is grey
    assert min(range(4), key=lambda seat: sum((a - b) ** 2 for a, b in zip(bright, PLAYERS[seat], strict=True))) == last


def test_pads_of_draft_are_grey_for_who_drives_alone(screen):
    scene = BusyRace(1, variant="draft")
    pad = scene.state.pads[0]
    scene.state.robots[0].x, scene.state.robots[0].y = pad.x + 400.0, pad.y + 200.0
    seen(scene).draw(screen, scene.state, 1.0, 0.0)
    box = around(pad.x, pad.y, 40)
    pixels = [screen.get_at((x, y))[:3] for x in range(box.left, box.right) for y in range(box.top, box.bottom)]
    assert not any(pixel[0] > pixel[2] + 40 for pixel in pixels), "gold would promise what it does not do"
