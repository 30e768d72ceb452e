"""The view of Robot Factory: everything is drawn, every sound plays once, and the match is not modified."""

import math

import pygame
import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.pallets import move
from pigaming_app.games.factory.state import (
    DAMAGED,
    DELIVERED,
    DONE,
    ENTRY,
    FIRE,
    HALF,
    ICE,
    IN_MACHINE,
    IN_SLOT,
    INPUT,
    MACHINE_SLOTS,
    MAX_PALLETS,
    ON_ROBOT,
    RAW,
    SHELVES,
    SHIPPED,
    WAITING,
    A,
    B,
)
from pigaming_app.scenes.bench.frame_times import AllEffects
from pigaming_app.scenes.views.factory.next_step import next_slot
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.record import digest
from pigaming_app.ui.i18n import Words
from tests.cases import repeated
from tests.matches import match_of

HUMANS = ["human"] * 4
INPUT_A, OUTPUT_A = MACHINE_SLOTS, MACHINE_SLOTS + 1
EXIT_ICE = SHELVES


def begun(floor="hall", goal=4, brains=("human",) * 4):
    return match_of("factory", brains, floor, 5.0, 1, "standard", goal)


def seen(match, players=HUMANS, taste=None):
    """A view of a match, and its state."""
    view = SCREENS["factory"].view(match.arena, match.state, list(players), taste or AllEffects(), Words("en"))
    return view, match.state


def sounds(view, state):
    return [name for name, _, _ in view.watch(state)]


def picture(screen, view, state, x, y, half=60):
    """Pixels around a point of the arena, after all particles have faded."""
    view.particles.advance(9.0)
    view.draw(screen, state, 1.0, 0.0)
    box = pygame.Rect(160 + int(x) - half, 140 + int(y) - half, 2 * half, 2 * half).clip(screen.get_rect())
    return pygame.image.tobytes(screen.subsurface(box), "RGB")


def feed(state, p, s, kind=IN_SLOT):
    """Put pallet p somewhere, as the rules do."""
    move(state, p, kind, s)


@pytest.mark.long
@pytest.mark.parametrize(("goal", "floor"), repeated((goal, floor) for goal in (8, 2) for floor in arenas("factory")))
def test_a_match_among_drivers_draws_and_is_left_alone(screen, floor, goal):
    match = begun(floor, goal, ("level5",) * 4)
    view, _ = seen(match, ["level5"] * 4)
    heard = set()
    for tick in range(1500):
        match.tick()
        before = digest(match.state)
        heard |= set(sounds(view, match.state))
        if tick % 25 == 0:
            view.draw(screen, match.state, 0.5, 0.5)
        assert digest(match.state) == before
    assert {"lift", "set_down", "machine_done"} <= heard


def test_a_pallet_is_heard_once_when_lifted_and_once_when_set_down(screen):
    view, state = seen(begun())
    robot = state.robots[0]
    feed(state, 0, 0, ON_ROBOT)
    assert view.watch(state) == [("lift", 0, robot.x)]
    assert view.watch(state) == []
    feed(state, 0, INPUT_A)
    assert view.watch(state) == [("set_down", 0, state.slots[INPUT_A].x)]
    assert view.watch(state) == []


def test_a_pallet_that_was_just_moved_is_larger_for_a_moment(screen):
    view, state = seen(begun())
    feed(state, 0, INPUT_A)
    feed(state, 0, 0, ON_ROBOT)
    view.watch(state)
    assert view.pops.tenths(0, view.particles.clock) > 10
    assert view.pops.tenths(1, view.particles.clock) == 10
    view.particles.advance(1.0)
    assert view.pops.tenths(0, view.particles.clock) == 10


def test_a_load_lies_on_the_forks(screen):
    view, state = seen(begun())
    robot = state.robots[0]
    x, y = robot.x + 64 * math.cos(robot.heading), robot.y + 64 * math.sin(robot.heading)
    empty = picture(screen, view, state, x, y, 20)
    feed(state, 0, 0, ON_ROBOT)
    view.watch(state)
    assert picture(screen, view, state, x, y, 20) != empty


@pytest.mark.parametrize("team", [ICE, FIRE])
def test_every_state_of_a_pallet_of_each_team_looks_its_own(screen, team):
    view, state = seen(begun())
    p = team * MAX_PALLETS
    slot = state.slots[INPUT_A]
    feed(state, p, INPUT_A)
    pictures = set()
    for form in (RAW, HALF, DONE, DAMAGED, DELIVERED):
        state.pallets[p].state = form
        pictures.add(picture(screen, view, state, slot.x, slot.y, 26))
    assert len(pictures) == 5


def test_states_are_told_apart_without_colours(screen):
    """In greyscale at a quarter of the size, all states differ."""
    view, state = seen(begun())
    feed(state, 0, INPUT_A)
    greys = []
    for form in (RAW, HALF, DONE, DAMAGED, DELIVERED):
        state.pallets[0].state = form
        picture(screen, view, state, 0, 0)
        slot = state.slots[INPUT_A]
        box = pygame.Rect(160 + int(slot.x) - 28, 140 + int(slot.y) - 28, 56, 56)
        small = pygame.transform.smoothscale(pygame.transform.grayscale(screen.subsurface(box)), (14, 14))
        greys.append([small.get_at((x, y))[0] for x in range(14) for y in range(14)])
    for i, one in enumerate(greys):
        for other in greys[:i]:
            assert sum(abs(a - b) for a, b in zip(one, other, strict=True)) / len(one) > 8.0


def test_a_machine_shows_how_far_it_is_and_whose_pallet_it_has(screen):
    view, state = seen(begun())
    machine = state.machines[0]
    pictures = {picture(screen, view, state, machine.x, machine.y, 80)}
    for p in (0, MAX_PALLETS):
        feed(state, p, 0, IN_MACHINE)
        machine.reserved = p + 1
        for left in (290, 150, 20):
            machine.left = left
            pictures.add(picture(screen, view, state, machine.x, machine.y, 80))
        feed(state, p, p * 2 * SHELVES // MAX_PALLETS)
    assert len(pictures) == 7


def test_a_machine_that_is_done_is_heard_once(screen):
    view, state = seen(begun())
    feed(state, 0, INPUT_A)
    view.watch(state)
    feed(state, 0, 0, IN_MACHINE)
    view.watch(state)
    feed(state, 0, OUTPUT_A)
    state.pallets[0].state = HALF
    assert view.watch(state) == [("machine_done", None, state.slots[OUTPUT_A].x)]
    assert sounds(view, state) == []


def test_a_delivery_is_heard_once_sparks_and_counts(screen):
    view, state = seen(begun())
    state.pallets[0].state = DONE
    feed(state, 0, 0, ON_ROBOT)
    view.watch(state)
    view.draw(screen, state, 1.0, 9.0)
    feed(state, 0, EXIT_ICE)
    state.pallets[0].state, state.delivered[ICE] = DELIVERED, 1
    state.robots[0].score = state.loads[0].delivered = 1
    assert view.watch(state) == [("delivered_ice", 0, state.slots[EXIT_ICE].x)]
    assert view.particles.particles
    assert [(popup.text, popup.player) for popup in view.particles.scores] == [("+1", 0)]
    panel = pygame.Rect(160, 0, 652, 136)
    old = pygame.image.tobytes(screen.subsurface(panel), "RGB")
    view.draw(screen, state, 1.0, 9.0)
    assert pygame.image.tobytes(screen.subsurface(panel), "RGB") != old
    assert view.watch(state) == []


def test_a_spoiled_pallet_is_heard_and_its_replacement_is_counted_down(screen):
    view, state = seen(begun())
    feed(state, 0, 0, ON_ROBOT)
    view.watch(state)
    feed(state, 0, INPUT_A + 2)
    state.pallets[0].state = DAMAGED
    assert view.watch(state) == [("spoiled", 0, state.slots[INPUT_A + 2].x)]
    assert sounds(view, state) == []

    entry = state.slots[3]
    pictures = set()
    for waited in (10, 60, 110, 480):
        state.pallets[0].waited = waited
        pictures.add(picture(screen, view, state, entry.x - 80, entry.y - 60, 160))
    assert len(pictures) == 4

    state.pallets[0].state = RAW
    feed(state, 0, 0)
    assert view.watch(state) == [("arrived", None, state.slots[0].x)]


def test_a_press_that_can_do_nothing_shakes_the_robot_and_is_heard_once(screen):
    view, state = seen(begun())
    robot, load = state.robots[1], state.loads[1]
    still = picture(screen, view, state, robot.x, robot.y, 90)
    load.refused = 1
    assert view.watch(state) == [("refused", 1, robot.x)]
    assert picture(screen, view, state, robot.x, robot.y, 90) != still
    load.refused = 2
    assert view.watch(state) == []
    load.refused = 1  # pressed again
    assert sounds(view, state) == ["refused"]
    load.refused = 200
    assert sounds(view, state) == []
    assert picture(screen, view, state, robot.x, robot.y, 90) == still


def test_a_robot_that_drove_over_somebody_counts_down_and_the_person_shouts(screen):
    view, state = seen(begun())
    load, worker, robot = state.loads[2], state.workers[0], state.robots[2]
    calm = picture(screen, view, state, worker.x + 26, worker.y - 56, 30)
    load.frozen, worker.touched[2] = 150, 1
    assert view.watch(state) == [("freeze", 2, robot.x)]
    assert picture(screen, view, state, worker.x + 26, worker.y - 56, 30) != calm
    pictures = set()
    for left in (150, 100, 50, 0):
        load.frozen = left
        assert sounds(view, state) == []
        pictures.add(picture(screen, view, state, robot.x, robot.y - 92, 40))
    assert len(pictures) == 4


def test_people_and_robots_are_seen_between_two_ticks(screen):
    view, state = seen(begun())
    worker = state.workers[1]
    x, y = worker.x, worker.y
    view.watch(state)
    worker.x += 30.0
    view.watch(state)
    pictures = set()
    for blend in (0.0, 0.5, 1.0):
        view.draw(screen, state, blend, 0.0)
        pictures.add(pygame.image.tobytes(screen.subsurface((160 + x - 60, 140 + y - 60, 160, 120)), "RGB"))
    assert len(pictures) == 3


def test_waiting_and_delivered_pallets_are_counted_beside_the_warehouses(screen):
    view, state = seen(begun(goal=8))
    entry, out = state.slots[0], state.slots[EXIT_ICE]
    assert sum(pallet.place == WAITING for pallet in state.pallets[:MAX_PALLETS]) == 4
    four = picture(screen, view, state, entry.x - 150, entry.y - 14)
    feed(state, 7, ICE, SHIPPED)
    three = picture(screen, view, state, entry.x - 150, entry.y - 14)
    assert four != three
    gone = picture(screen, view, state, out.x - 150, out.y - 14)
    state.pallets[7].place = WAITING
    assert picture(screen, view, state, out.x - 150, out.y - 14) != gone


def test_people_are_shown_the_next_step_and_drivers_their_aim(screen):
    match = begun()
    state = match.state
    assert state.slots[next_slot(state, 0, -1)].kind == ENTRY
    feed(state, 0, 0, ON_ROBOT)
    for form, kind in ((RAW, A), (HALF, B)):
        state.pallets[0].state = form
        slot = state.slots[next_slot(state, 0, -1)]
        assert (slot.kind, state.machines[slot.machine].kind) == (INPUT, kind)
    state.pallets[0].state = DONE
    assert next_slot(state, 0, -1) in range(EXIT_ICE, EXIT_ICE + SHELVES)

    (view, _), mates = seen(match, ["human", "level5", "level5", "level5"]), state.loads[3]
    mates.aim = 1 + INPUT_A
    for _ in range(10):
        view.watch(state)
        state.tick += 1
    assert view.guide.slots[0] in range(EXIT_ICE, EXIT_ICE + SHELVES)
    assert view.guide.slots[3] == INPUT_A
    before = picture(screen, view, state, state.slots[INPUT_A].x, state.slots[INPUT_A].y)
    view.guide.slots[3] = -1
    assert picture(screen, view, state, state.slots[INPUT_A].x, state.slots[INPUT_A].y) != before


@pytest.mark.parametrize("goal", [2, 4, 7, 8])
def test_every_pallet_fits_into_its_teams_panel(screen, goal):
    view, state = seen(begun(goal=goal))
    view.draw(screen, state, 1.0, 0.0)
    whole = []
    for p in (*range(goal), *range(MAX_PALLETS, MAX_PALLETS + goal)):
        state.pallets[p].state = HALF
        view.draw(screen, state, 1.0, 0.0)
        whole.append(pygame.image.tobytes(screen.subsurface((0, 0, 1920, 136)), "RGB"))
    assert len(set(whole)) == 2 * goal
    for x in (144, 828, 1092, 1776):  # nothing sticks out at the sides of a panel
        assert max(max(screen.get_at((x, y))[:3]) for y in range(40, 120)) < 40


def test_the_clock_says_when_time_runs_out(screen):
    view, state = seen(begun())
    box = pygame.Rect(830, 0, 260, 136)
    colors = []
    for left in (60, 11, 10):
        state.tick = state.rules.ticks - 50 * left
        view.draw(screen, state, 1.0, 0.0)
        colors.append(
            max(screen.get_at((x, y))[2] for x in range(*box.topleft[:1], box.right, 2) for y in range(0, 136, 2))
        )
    assert colors[0] == colors[1] > colors[2] + 60


def test_without_flashes_a_delivery_makes_no_wave(screen):
    taste = AllEffects()
    taste.flashes = "off"
    view, state = seen(begun(), taste=taste)
    feed(state, 0, 0, ON_ROBOT)
    view.watch(state)
    feed(state, 0, EXIT_ICE)
    state.pallets[0].state, state.delivered[ICE] = DELIVERED, 1
    assert sounds(view, state) == ["delivered_ice"]
    view.draw(screen, state, 1.0, 0.01)
    assert view.particles.blooms == []
