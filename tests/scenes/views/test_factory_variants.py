"""The views of party and together, and what every variant announces: deliveries, countdowns, tasks of team mates."""

from typing import Any

import pygame
import pytest

from pigaming_app.games.factory.pallets import move
from pigaming_app.games.factory.state import (
    DELIVERED,
    DONE,
    ENTRY,
    EXIT,
    FIRE,
    HALF,
    ICE,
    IN_MACHINE,
    IN_SLOT,
    MACHINE_SLOTS,
    MAX_PALLETS,
    NOBODY,
    ON_ROBOT,
    SHELVES,
)
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.scenes.bench.busy_factory import BusyFactory
from pigaming_app.scenes.bench.frame_times import AllEffects
from pigaming_app.scenes.views.factory import contest, countdowns, star_panel
from pigaming_app.scenes.views.factory.hud import CALLS
from pigaming_app.scenes.views.factory.next_step import is_task
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw.surface_cache import BUDGET, surfaces
from pigaming_app.ui.i18n import LANGUAGES, Words
from tests.cases import repeated
from tests.matches import setup_of

HUMANS = ("human",) * 4
INPUT_A, OUTPUT_A = MACHINE_SLOTS, MACHINE_SLOTS + 1
EXIT_ICE = SHELVES
LEFT_PANEL, CLOCK, RIGHT_PANEL = (160, 0, 652, 136), (830, 0, 260, 136), (1108, 0, 652, 136)


def begun(variant="standard", goal=None, floor="hall"):
    minutes = float(games()["factory"].variants[variant].default_minutes)
    return Match(setup_of("factory", HUMANS, floor, minutes, 1, variant, goal))


def seen(match, players=HUMANS, language="en"):
    """A view of a match, and its state."""
    return SCREENS["factory"].view(match.arena, match.state, list(players), AllEffects(), Words(language)), match.state


def sounds(view, state):
    return [name for name, _, _ in view.watch(state)]


def pixels(screen, view, state, box):
    """Pixels of a canvas box, after all particles and words have faded."""
    view.particles.advance(9.0)
    view.draw(screen, state, 1.0, 0.0)
    return pygame.image.tobytes(screen.subsurface(pygame.Rect(box).clip(screen.get_rect())), "RGB")


def around(x, y, half=60):
    return 160 + int(x) - half, 140 + int(y) - half, 2 * half, 2 * half


def deliver(state, p, k, s=EXIT_ICE, points=1):
    """Let robot k deliver pallet p, as the rules do."""
    move(state, p, IN_SLOT, s)
    state.pallets[p].state = DELIVERED
    state.delivered[state.robots[k].team] += 1
    state.robots[k].score += points
    state.loads[k].delivered += 1


# ---- every variant


@pytest.mark.parametrize("team", [ICE, FIRE])
def test_a_delivery_is_called_out_at_the_exit_with_the_jingle_of_the_team(screen, team):
    (view, state), p = seen(begun()), team * MAX_PALLETS
    move(state, p, ON_ROBOT, team)
    view.watch(state)
    deliver(state, p, team, team * 2 * SHELVES + SHELVES)
    assert sounds(view, state) == [("delivered_ice", "delivered_fire")[team]]
    (note,) = view.notes.notes
    assert note.text == "Delivered!"
    assert abs(note.x - (160 + state.slots[team * 2 * SHELVES + SHELVES].x)) < 160
    view.particles.advance(2.0)
    view.draw(screen, state, 1.0, 0.0)
    assert view.notes.notes == []


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("team", [ICE, FIRE])
def test_words_at_an_exit_stay_on_the_picture(screen, language, team):
    view, state = seen(begun(floor="yard"), language=language)
    for kind in (ENTRY, EXIT):
        for i in range(SHELVES):
            slot = state.slots[team * 2 * SHELVES + (SHELVES if kind == EXIT else 0) + i]
            view.notes.add(0.0, 160 + slot.x, 140 + slot.y, "delivered", (255, 255, 255))
            top: list[Any] = []
            view.notes.draw(top, 0.01)
            image, (x, y) = top[-1]
            assert x >= 0
            assert x + image.get_width() <= 1920
            assert y >= 0
            assert y + image.get_height() <= 1080


@pytest.mark.parametrize("variant", ["standard", "together"])
def test_one_to_go_is_a_banner_with_a_sound_once(screen, variant):
    view, state = seen(begun(variant, goal=4))
    heard = []
    looks = []
    for p, place in enumerate((0, 2, 1)):
        deliver(state, place if variant == "standard" else p, 0, EXIT_ICE + p)
        heard.append("one_to_go" in sounds(view, state))
        looks.append(pixels(screen, view, state, LEFT_PANEL))
    assert heard == [False, False, True]
    state.tick += 2 * HZ
    assert pixels(screen, view, state, LEFT_PANEL) != looks[-1]
    assert "one_to_go" not in sounds(view, state)


def test_an_output_counts_down_before_a_worker_clears_it(screen):
    view, state = seen(begun(), ["level5"] * 4)
    move(state, 0, IN_SLOT, OUTPUT_A)
    pallet, slot = state.pallets[0], state.slots[OUTPUT_A]
    pallet.state = HALF
    heard, pictures = [], set()
    for left in range(12 * HZ, -1, -1):
        pallet.waited = state.rules.collect - left
        heard += [left // HZ] * sounds(view, state).count("clearing")
        if left % HZ == 0:
            pictures.add(pixels(screen, view, state, around(slot.x, slot.y, 110)))
    assert heard == [5, 4, 3, 2, 1]
    assert len(pictures) == 11  # nothing, then one for each of ten seconds; at 0 again nothing


def test_a_machine_counts_down_before_it_jams(screen):
    view, state = seen(begun())
    machine = state.machines[0]
    move(state, 0, IN_MACHINE, 0)
    machine.reserved, machine.left = 1, 300
    move(state, 1, IN_SLOT, INPUT_A)
    view.watch(state)
    heard = []
    for left in range(300, 0, -1):
        machine.left = left
        heard += [left // HZ] * sounds(view, state).count("jamming")
    assert heard == [3, 2, 1]
    box = around(machine.x, machine.y, 90)
    move(state, 0, IN_SLOT, OUTPUT_A)
    state.pallets[0].state = HALF
    jammed = {pixels(screen, view, state, box)}
    state.tick += countdowns.BLINK
    jammed.add(pixels(screen, view, state, box))
    assert len(jammed) == 2  # it blinks
    move(state, 1, IN_SLOT, 1)
    assert pixels(screen, view, state, box) not in jammed


def test_no_jam_is_announced_while_the_input_is_empty():
    view, state = seen(begun())
    move(state, 0, IN_MACHINE, 0)
    state.machines[0].reserved, state.machines[0].left = 1, HZ + 1
    view.watch(state)
    state.machines[0].left = HZ
    assert sounds(view, state) == []


@pytest.mark.parametrize(("brain", "shown"), [("human", True), ("level5", False)])
def test_the_task_of_an_ai_is_shown_to_its_human_mate(screen, brain, shown):
    view, state = seen(begun(), [brain, "level5", "level5", "level5"])
    box = around(state.slots[0].x, state.slots[0].y, 100)
    view.guide.slots = [-1, -1, 0, -1]
    mate = pixels(screen, view, state, box)
    view.guide.slots = [-1, -1, -1, 0]  # the same slot as the aim of an opponent: only its small corners
    opponent = pixels(screen, view, state, box)
    view.guide.slots = [-1] * 4
    free = pixels(screen, view, state, box)
    assert mate != free
    assert opponent != free
    lit = [sum(a != b for a, b in zip(look, free, strict=True)) for look in (mate, opponent)]
    assert (lit[0] > 2 * lit[1]) == shown


def test_waiting_is_no_task():
    match = begun()
    state = match.state
    assert is_task(state, 0, 0)  # a raw pallet on the shelf
    assert not is_task(state, 0, EXIT_ICE)
    assert not is_task(state, 0, OUTPUT_A)
    move(state, 0, IN_MACHINE, 0)
    assert is_task(state, 0, OUTPUT_A)  # a pallet is about to come out
    move(state, 0, ON_ROBOT, 0)
    assert is_task(state, 0, INPUT_A)
    assert not is_task(state, 0, EXIT_ICE)  # it is raw
    state.pallets[0].state = DONE
    assert is_task(state, 0, EXIT_ICE)


# ---- party


def test_points_count_in_party_and_a_rush_order_shows_plus_two(screen):
    view, state = seen(begun("party"))
    move(state, 0, ON_ROBOT, 0)
    view.watch(state)
    none = pixels(screen, view, state, LEFT_PANEL)
    deliver(state, 0, 0, points=2)
    state.points[ICE] = 2
    view.watch(state)
    assert [(popup.text, popup.player) for popup in view.particles.scores] == [("+2", 0)]
    assert pixels(screen, view, state, LEFT_PANEL) != none


def test_a_rush_order_is_announced_shrinks_and_expires(screen):
    view, state = seen(begun("party"))
    pallet, slot = state.pallets[0], state.slots[state.pallets[0].at]
    view.watch(state)
    plain = pixels(screen, view, state, LEFT_PANEL), pixels(screen, view, state, around(slot.x, slot.y))
    pallet.rush = state.rules.rush
    assert "rush" in sounds(view, state)
    assert [note.text for note in view.notes.notes] == ["Rush order: ×2"]
    panels, crates = set(), set()
    for left in range(state.rules.rush, 0, -5 * HZ):
        pallet.rush = left
        view.watch(state)
        panels.add(pixels(screen, view, state, LEFT_PANEL))
        crates.add(pixels(screen, view, state, around(slot.x, slot.y)))
    assert len(panels) == len(crates) == state.rules.rush // (5 * HZ)
    pallet.rush = 1
    view.watch(state)
    pallet.rush = 0
    assert sounds(view, state) == ["expired"]
    state.tick += CALLS["expired"]
    assert (pixels(screen, view, state, LEFT_PANEL), pixels(screen, view, state, around(slot.x, slot.y))) == plain


def test_a_rush_order_that_is_delivered_in_time_does_not_expire():
    view, state = seen(begun("party"))
    state.pallets[0].rush = 1
    move(state, 0, ON_ROBOT, 0)
    view.watch(state)
    deliver(state, 0, 0, points=2)
    state.pallets[0].rush = 0
    assert sounds(view, state) == ["delivered_ice"]


def test_a_theft_is_heard_and_called_out_on_the_panel_of_the_robbed_team(screen):
    view, state = seen(begun("party"))
    move(state, 0, IN_SLOT, OUTPUT_A)
    view.watch(state)
    before = [pixels(screen, view, state, box) for box in (LEFT_PANEL, RIGHT_PANEL)]
    state.pallets[0].team, state.loads[1].stolen = FIRE, 1
    move(state, 0, ON_ROBOT, 1)
    assert sounds(view, state) == ["lift", "stolen"]
    assert view.hud.calls == {ICE: ("stolen", state.tick + CALLS["stolen"])}
    called = [pixels(screen, view, state, box) for box in (LEFT_PANEL, RIGHT_PANEL)]
    state.tick += CALLS["stolen"]
    after = [pixels(screen, view, state, box) for box in (LEFT_PANEL, RIGHT_PANEL)]
    assert len({before[0], called[0], after[0]}) == 3  # the call, then one pallet less
    assert called[1] == after[1] != before[1]


def test_a_loose_pallet_looks_like_neither_teams_until_somebody_lifts_it(screen):
    view, state = seen(begun("party"))
    p = next(p for p, pallet in enumerate(state.pallets) if pallet.exists and pallet.loose)
    slot = state.slots[state.pallets[p].at]
    assert state.pallets[p].team == NOBODY
    looks = set()
    for team in (NOBODY, ICE, FIRE):
        state.pallets[p].team = team
        looks.add(pixels(screen, view, state, around(slot.x, slot.y, 26)))
    assert len(looks) == 3


def test_a_ring_tells_whose_a_processed_pallet_is_and_when_anybody_may_take_it(screen):
    view, state = seen(begun("party"))
    move(state, 0, IN_SLOT, OUTPUT_A)
    state.pallets[0].state = HALF
    slot, looks = state.slots[OUTPUT_A], []
    for waited in (0, state.rules.claim // 2, state.rules.claim, state.rules.claim + 1):
        state.pallets[0].waited = waited
        view.particles.clock = 1.0
        view.draw(screen, state, 1.0, 0.0)
        looks.append(pygame.image.tobytes(screen.subsurface(around(slot.x, slot.y, 70)), "RGB"))
    assert len(set(looks)) == 3
    assert looks[2] == looks[3]


def test_the_fast_machine_stands_out_and_the_next_one_is_announced(screen):
    view, state = seen(begun("party"))
    (now,) = (m for m in range(4) if state.machines[m].fast)
    after = contest.next_fast(state)
    assert now != after
    boxes = [around(state.machines[m].x, state.machines[m].y, 90) for m in (now, after)]
    early = [pixels(screen, view, state, box) for box in boxes]
    state.tick = state.rules.fast_every - contest.NOTICE
    late = [pixels(screen, view, state, box) for box in boxes]
    assert late[1] != early[1]
    view.watch(state)
    state.tick = state.rules.fast_every
    state.machines[now].fast, state.machines[after].fast = 0, 1
    assert sounds(view, state) == ["fast"]
    assert pixels(screen, view, state, boxes[1]) not in (early[1], late[1])


def test_overtime_is_called_where_the_clock_was(screen):
    view, state = seen(begun("party"))
    state.tick = state.rules.ticks - 1
    last = pixels(screen, view, state, CLOCK)
    state.tick = state.rules.ticks
    call = pixels(screen, view, state, CLOCK)
    assert call != last
    state.tick += 10 * HZ
    assert pixels(screen, view, state, CLOCK) == call


# ---- together


def test_a_star_is_lost_when_the_clock_passes_its_time(screen):
    view, state = seen(begun("together"))
    limits = star_panel.limits(state)
    assert limits[0] > limits[1] > limits[2] > 0
    looks, heard = [], []
    for tick in (0, limits[2], limits[2] + 1, limits[1] + 1):
        state.tick = tick
        heard.append(sounds(view, state))
        looks.append(pixels(screen, view, state, RIGHT_PANEL))
    assert star_panel.stars_left(state) == 1
    assert heard == [[], [], ["star_lost"], ["star_lost"]]
    assert len(set(looks)) == 4  # the second one warns: the star is about to be lost


def test_the_clock_of_allies_counts_up(screen):
    match = begun("together")
    state = match.state
    assert [star_panel.clock(seconds) for seconds in (0, 9, 75)] == ["0:00", "0:09", "1:15"]
    view, _ = seen(match)
    looks = set()
    for tick in (0, HZ, 2 * HZ):
        state.tick = tick
        looks.add(pixels(screen, view, state, CLOCK))
    assert len(looks) == 3


@pytest.mark.parametrize("goal", games()["factory"].variants["together"].goals)
def test_every_pallet_of_allies_is_in_their_panel(screen, goal):
    view, state = seen(begun("together", goal=goal))
    own = [p for p, pallet in enumerate(state.pallets) if pallet.exists]
    assert len(own) == goal
    looks = {pixels(screen, view, state, LEFT_PANEL)}
    for p in own:
        state.pallets[p].state = HALF
        looks.add(pixels(screen, view, state, LEFT_PANEL))
    assert len(looks) == goal + 1
    for x in (144, 828):  # nothing sticks out at the sides
        assert max(max(screen.get_at((x, y))[:3]) for y in range(40, 120)) < 40


@pytest.mark.parametrize("variant", ["standard", "together"])
def test_allies_have_warehouses_of_one_colour(screen, variant):
    match = begun(variant)
    view, state = seen(match)
    for robot in state.robots:
        robot.present = 0
    pixels(screen, view, state, (0, 0, 1, 1))
    right = [screen.get_at((x, y)) for x in range(1640, 1750, 2) for y in range(690, 900, 2)]  # the empty exit
    assert any(color[0] > color[2] + 40 for color in right) == (variant == "standard")


# ---- memory and the match


@pytest.mark.long
@pytest.mark.usefixtures("_cache_as_in_the_arcade")
@pytest.mark.parametrize("variant", repeated(sorted(games()["factory"].variants, key="party".__ne__)))
def test_a_match_fits_the_cache_and_is_left_alone(screen, variant):
    scene = BusyFactory(variant)
    players = ["human", "human", "level1", "level5"]
    view = SCREENS["factory"].view(scene.arena, scene.state, players, AllEffects(), Words("pt"))
    while not view.prewarm(1000.0):
        pass
    assert surfaces.bytes < BUDGET
    for _ in range(500):
        scene.tick()
        before = digest(scene.state)
        view.watch(scene.state)
        view.draw(screen, scene.state, 0.5, 0.02)
        assert digest(scene.state) == before
    assert surfaces.bytes < BUDGET
