"""The factory brain: it damages nothing, finishes every match, divides the work, yields, and announces its target."""

from functools import cache
from math import hypot

import pytest

from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.pallets import move
from pigaming_app.games.factory.state import (
    DAMAGED,
    DONE,
    ENTRY,
    EXIT,
    FIRE,
    HALF,
    ICE,
    IN_SLOT,
    INPUT,
    MAX_PALLETS,
    ON_ROBOT,
    RAW,
    SLOTS,
    A,
    B,
)
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import HZ
from tests.cases import one_in, repeated
from tests.games.factory.shop import Shop
from tests.matches import finished, match_of, run

FLOORS = arenas("factory")


@cache
def played(brains, floor="hall", seed=1, pallets=4):
    match = finished(match_of("factory", brains, floor, seed=seed, goal=pallets))
    return match


STRENGTHS = ("level1", "level3", "level5")


def total(match, name):
    return sum(getattr(load, name) for load in match.state.loads)


# -------------------------------------------------------------------------------------------------------- whole matches


@pytest.mark.parametrize("seed", one_in(2, [1, 2]))
@pytest.mark.parametrize("floor", FLOORS)
def test_four_hard_drivers_spoil_nothing_and_one_team_delivers_everything(floor, seed):
    """The longest of 1000 such matches took less than 90 s."""
    match = played(("hand3",) * 4, floor, seed)
    assert total(match, "spoiled") == 0
    assert match.state.winner
    assert match.seconds < 120.0
    assert total(match, "hits") <= 2


@pytest.mark.parametrize(("floor", "strength"), [*zip(FLOORS, STRENGTHS, strict=True)])
def test_every_strength_alone_against_another_delivers_everything(floor, strength):
    match = played((strength, strength, "off", "off"), floor, pallets=2)
    assert match.state.winner
    assert total(match, "spoiled") == 0


def test_mixed_company_gets_to_the_end():
    assert played(("hand1", "hand2", "hand3", "hand2"), seed=5).state.winner


@pytest.mark.parametrize("floor", one_in(3, FLOORS))
def test_eight_pallets_are_no_dead_end(floor):
    """Machines and entries are always full then."""
    assert played(("hand3",) * 4, floor, 3, pallets=8).state.winner


@pytest.mark.long
@pytest.mark.parametrize(
    ("better", "worse", "least"), repeated([("hand3", "hand2", 6), ("hand2", "hand1", 9), ("hand3", "hand1", 9)])
)
def test_the_strengths_are_ordered(better, worse, least):
    """In nine matches on all three floors, on either side; `level3` beats `level5` in one of five."""
    won = 0
    for i, floor in enumerate(FLOORS * 3):
        brains = (worse, better) * 2 if i % 2 else (better, worse) * 2
        won += played(brains, floor, 1 + i // 3).state.winner == 1 + i % 2
    assert won >= least


def test_two_are_faster_than_one():
    one, two = (
        played(brains, "hall", 2) for brains in (("hand3", "off", "off", "off"), ("hand3", "off", "hand3", "off"))
    )
    assert two.seconds < 0.75 * one.seconds


def test_both_mates_do_their_part():
    match = played(("hand3",) * 4, "hall", 1)
    for load in match.state.loads:
        assert load.steps + load.delivered >= 2


def test_the_same_seed_is_the_same_match():
    first, again = (match_of("factory", ("hand3", "hand2", "hand1", "hand3"), "yard", seed=4) for _ in range(2))
    for match in (first, again):
        run(match, 20 * HZ)
    assert digest(first.state) == digest(again.state)


@pytest.mark.parametrize("strength", STRENGTHS)
def test_it_thinks_without_changing_anything_but_its_action(strength):
    match = match_of("factory", (strength,) * 4)
    brain = make_brain("factory", strength, 1)
    before = digest(match.state)
    for tick in (0, 5, 10, 15):
        match.state.tick = tick
        brain.think(match.state, 0)
    action = match.state.actions[0]
    assert action.aim
    action.linear = action.angular = 0.0
    action.fire = action.turbo = action.aim = match.state.tick = 0
    assert digest(match.state) == before


# ----------------------------------------------------------------------------------------------------- choice of target


def first_aim(shop, seat=0, strength="hand3", seconds=0.6):
    """Target slot of a driver after `seconds`."""
    shop.match.sit(seat, make_brain("factory", strength, seat))
    shop.tick(round(seconds * HZ))
    return shop.loads[seat].aim - 1


def test_it_says_what_it_makes_for_and_then_uses_that_slot():
    """Before every lift and put-down the driver has announced that slot for a while."""
    match = match_of("factory", ("hand3",) * 4, seed=9)
    state, shown, uses = match.state, [[0] * 25 for _ in range(4)], 0
    where = [(pallet.place, pallet.at) for pallet in state.pallets]
    while not match.over:
        match.tick()
        for load, aims in zip(state.loads, shown, strict=True):
            assert 0 <= load.aim <= SLOTS
            aims.append(load.aim)
            del aims[0]
        for p, pallet in enumerate(state.pallets):
            before, where[p] = where[p], (pallet.place, pallet.at)
            if {before[0], pallet.place} == {IN_SLOT, ON_ROBOT}:
                seat, slot = (before[1], pallet.at) if pallet.place == IN_SLOT else (pallet.at, before[1])
                assert shown[seat].count(slot + 1) >= 10
                uses += 1
    assert uses > 20


@pytest.mark.parametrize(
    ("state", "kind", "makes"), [(RAW, INPUT, A), (HALF, INPUT, B), (DONE, EXIT, None), (DAMAGED, ENTRY, None)]
)
def test_what_it_carries_goes_where_it_belongs(state, kind, makes):
    shop = Shop(present=(0,))
    shop.press(0, shop.slot(ENTRY, ICE))
    shop.pallets[shop.loads[0].pallet - 1].state = state
    slot = shop.slots[first_aim(shop)]
    assert slot.kind == kind
    if makes is not None:
        assert shop.state.machines[slot.machine].kind == makes
    else:
        assert slot.team == ICE


def test_what_is_done_comes_before_what_is_raw():
    shop = Shop(present=(0,))
    shop.rails.poses[0] = (800.0, 450.0, 0.0)
    shop.give(shop.own(ICE)[0], DONE, shop.output_of(B))
    assert first_aim(shop) == shop.output_of(B)


def test_it_leaves_alone_what_belongs_to_the_others():
    shop = Shop(present=(0, 1))
    for p in shop.own(ICE):
        shop.give(p, RAW, shop.slot(ENTRY, ICE, which=p))
    shop.give(shop.own(FIRE)[0], HALF, shop.output_of(A))
    shop.rails.poses[0] = (shop.slots[shop.output_of(A)].x - 90.0, shop.slots[shop.output_of(A)].y, 0.0)
    aim = first_aim(shop)
    assert (shop.slots[aim].kind, shop.slots[aim].team) == (ENTRY, ICE)


@pytest.mark.parametrize("floor", FLOORS)
def test_two_mates_begin_with_different_pallets(floor):
    match = run(match_of("factory", ("hand3",) * 4, floor, seed=6), HZ)
    aims = [load.aim for load in match.state.loads]
    assert all(aims)
    assert len(set(aims)) == 4


def test_two_laden_mates_never_make_for_the_same_slot():
    match = match_of("factory", ("hand3", "off", "hand3", "off"), "yard", seed=6)
    one, other = match.state.loads[0], match.state.loads[2]
    laden = 0
    while not match.over:
        match.tick()
        if one.pallet and other.pallet:
            laden += 1
            assert one.aim != other.aim
    assert laden > 2 * HZ


@pytest.mark.parametrize("brain", ["hand3", "level5"])
def test_what_it_cannot_get_rid_of_it_brings_back_after_a_while(brain):
    """Both machines B are full of the other team's pallets, which nobody removes."""
    match = match_of("factory", (brain, "idle", "off", "off"))
    state = match.state
    state.rules.collect = 10**6
    others = iter(range(MAX_PALLETS, MAX_PALLETS + 4))
    for s, slot in enumerate(state.slots):
        if slot.machine >= 0 and state.machines[slot.machine].kind == B:
            p = next(others)
            move(state, p, IN_SLOT, s)
            state.pallets[p].state = HALF if slot.kind == INPUT else DONE
    while not state.loads[0].pallet:
        match.tick()
    pallet = state.pallets[state.loads[0].pallet - 1]
    pallet.state = HALF
    while pallet.place == ON_ROBOT and match.seconds < (40.0 if brain == "hand3" else 60.0):
        match.tick()
    assert pallet.place == IN_SLOT
    assert state.slots[pallet.at].kind == ENTRY


# --------------------------------------------------------------------------------------------------- people as mates


@pytest.mark.parametrize("strength", ["hand3", "level5"])
def test_it_leaves_to_a_person_what_the_person_is_about(strength):
    """Of two pallets the driver does not take the one at which the person stands; without a plan, the other one."""
    for mine in (0, 1):
        shop = Shop(present=(0, 2))
        near, far = shop.output_of(B, 0), shop.output_of(B, 1)
        shop.give(shop.own(ICE)[0], DONE, near)
        shop.give(shop.own(ICE)[1], DONE, far)
        x = 0.5 * (shop.slots[near].x + shop.slots[far].x)
        shop.rails.poses[0] = (x, 640.0, 0.0)  # as far from the one as from the other
        person = shop.slots[(near, far)[mine]]
        shop.rails.poses[2] = (person.x, person.y - 90.0, 1.57)
        aim = first_aim(shop, strength=strength)
        assert aim != (near, far)[mine]
        assert aim == (far, near)[mine] or strength == "level5"


def test_it_wins_with_a_mate_who_does_nothing():
    match = played(("hand3", "off", "idle", "off"), "hall", 3)
    assert match.state.winner == 1 + ICE
    assert match.state.loads[0].delivered == 4


def test_it_clears_the_machine_of_a_person_who_is_busy():
    """A half-done pallet blocks an output, and the person near it is already carrying one."""
    shop = Shop(present=(0, 2))
    out = shop.output_of(A)
    shop.press(2, shop.slot(ENTRY, ICE, which=3))
    shop.give(shop.own(ICE)[0], HALF, out)
    shop.rails.poses[2] = (shop.slots[out].x + 90.0, shop.slots[out].y, 0.0)
    assert first_aim(shop) == out


@pytest.mark.parametrize("strength", STRENGTHS)
def test_it_drives_round_people(strength):
    """A person stands between it and its first pallet."""
    match = match_of("factory", (strength, "off", "off", "off"), seed=2, goal=2)
    hits = 0
    while not match.over:
        match.tick()
        for worker in match.state.workers:
            robot = match.state.robots[0]
            hits += hypot(robot.x - worker.x, robot.y - worker.y) < 56.0 and abs(robot.linear) > 20.0
    assert match.state.loads[0].hits <= 1
    assert hits <= 15


def test_somebody_else_can_take_over_at_any_time():
    """A driver hands over to one with a fresh mind, laden or not, repeatedly."""
    match = match_of("factory", ("hand3", "off", "hand3", "off"), "lines", seed=8)
    changes = 0
    while not match.over:
        match.tick()
        if match.state.tick % (4 * HZ) == 0:
            changes += 1
            match.sit(2 * (changes % 2), make_brain("factory", STRENGTHS[changes % 3], changes))
    assert match.state.winner == 1 + ICE
    assert total(match, "spoiled") == 0
