"""The factory brain in party and together, and the human weaknesses of the weakest one."""

import numpy as np
import pytest

from pigaming_app.ai.explanations.registry import thoughts_of
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import BRAINS, make_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.state import DONE, ENTRY, EXIT, FIRE, ICE, INPUT, MACHINE_SLOTS, SHARED, A, B
from pigaming_app.games.setup import make_setup
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import DT, HZ
from tests.bench.fairness_factory import measure
from tests.bench.trial import Trial
from tests.games.factory.test_party import loose, party, put
from tests.matches import match_of, mind_of, run

FLOORS = arenas("factory")


def first_aim(shop, seat=0):
    """The target slot of a strong driver half a second after it sets out."""
    brain = make_brain("factory", "hand3", seat)
    brain.mind.resting = 0
    shop.match.sit(seat, brain)
    shop.tick(round(0.6 * HZ))
    return shop.loads[seat].aim - 1


def told(match):
    return thoughts_of(match, 0)


def without_loose(shop):
    """Take the loose pallets off the floor, and the rush from all orders."""
    for pallet in shop.pallets:
        pallet.rush = 0
    for p in loose(shop):
        shop.slots[shop.pallets[p].at].pallet = 0
        shop.pallets[p].exists = shop.pallets[p].place = 0
    return shop


# --------------------------------------------------------------------------------------------------------------- party


def test_it_takes_a_loose_pallet_that_lies_near():
    shop = party(present=(0, 1), seed=6)
    p = loose(shop)[-1]  # near a machine B
    slot = shop.slots[shop.pallets[p].at]
    shop.rails.poses[0] = (slot.x - 120.0, slot.y, 0.0)
    aim = first_aim(shop)
    assert shop.slots[aim].kind == SHARED
    assert shop.slots[aim].pallet
    assert (told(shop.match).behaviour, told(shop.match).reason) == ("take", "anybody")


def test_it_steals_what_the_others_have_left_in_a_machine():
    shop = without_loose(party(present=(0, 1)))
    p, out = shop.own(FIRE)[0], shop.output_of(B)
    put(shop, p, DONE, FIRE, out, waited=shop.state.rules.claim)
    shop.rails.poses[0] = (shop.slots[out].x - 120.0, shop.slots[out].y, 0.0)
    assert first_aim(shop) == out
    assert (told(shop.match).behaviour, told(shop.match).reason) == ("take", "anybody")


def test_it_leaves_to_its_owner_what_is_not_free_yet():
    shop = without_loose(party(present=(0, 1)))
    p, out = shop.own(FIRE)[0], shop.output_of(B)
    put(shop, p, DONE, FIRE, out)
    shop.rails.poses[0] = (shop.slots[out].x - 120.0, shop.slots[out].y, 0.0)
    assert first_aim(shop) != out


@pytest.mark.parametrize("which", [0, 1, 3])
def test_a_rush_order_comes_first(which):
    shop = without_loose(party(present=(0, 1)))
    rush = shop.slot(ENTRY, ICE, which=which)
    shop.pallets[shop.slots[rush].pallet - 1].rush = shop.state.rules.rush
    shop.rails.poses[0] = (300.0, 228.0, 3.14)
    assert first_aim(shop) == rush
    assert (told(shop.match).behaviour, told(shop.match).reason) == ("fetch", "rush")


def test_a_rush_order_without_a_chance_is_an_ordinary_one():
    shop = without_loose(party(present=(0, 1)))
    far = shop.slot(ENTRY, ICE, which=3)
    shop.pallets[shop.slots[far].pallet - 1].rush = 8 * HZ
    shop.rails.poses[0] = (200.0, 96.0, 3.14)
    assert first_aim(shop) == shop.slot(ENTRY, ICE)


@pytest.mark.parametrize("fast", [0, 1])
def test_it_contests_the_fast_machine(fast):
    """From the middle both machines A are as near; the fast one is chosen."""
    shop = without_loose(party(present=(0, 1)))
    shop.state.turns[:] = [fast, 1 - fast, 2, 3]
    shop.press(0, shop.slot(ENTRY, ICE))
    shop.rails.poses[0] = (800.0, 300.0, -1.57)
    aim = first_aim(shop)
    assert (shop.slots[aim].kind, shop.slots[aim].machine) == (INPUT, fast)
    assert (told(shop.match).behaviour, told(shop.match).reason) == ("bring", "fast")


@pytest.mark.long
def test_both_teams_score_steal_and_deliver_rush_orders():
    match = match_of("factory", ("hand3",) * 4, "yard", goal=0, minutes=3.0, variant="party")
    doubles = 0
    before = [0, 0]
    while not match.over and match.seconds < 90.0:
        match.tick()
        for team in (ICE, FIRE):
            doubles += match.state.points[team] - before[team] == 2
            before[team] = match.state.points[team]
    assert min(match.state.points) >= 4
    assert doubles >= 2
    assert sum(load.stolen for load in match.state.loads) >= 1
    assert sum(load.spoiled for load in match.state.loads) == 0


# ------------------------------------------------------------------------------------------------------------ together


def test_four_allies_announce_four_different_jobs():
    match = match_of("factory", ("hand3",) * 4, goal=8, minutes=3.0, variant="together")
    shared = 0
    for _ in range(20 * HZ):
        match.tick()
        aims = [load.aim for load in match.state.loads if load.aim and load.pallet]
        shared += len(aims) - len(set(aims))
    assert shared == 0, "two laden allies never make for the same slot"
    assert sum(match.state.loads[seat].steps > 0 for seat in range(4)) >= 2


# ---------------------------------------------------------------------------------------------------- human weaknesses


def ticks_of(brain, seeds):
    """Ticks of standard matches of four equal drivers on the default floor."""
    setups = [make_setup("factory", [brain] * 4, None, None, seed, None, None, [brain]) for seed in seeds]
    batch = Batch(setups, [BRAINS["factory"][brain]] * 4, can_compile())
    batch.play(5 * 60 * HZ)
    return [match.tick for match in batch.ended()]


@pytest.mark.again  # higher levels need less time: test_planner.py
@pytest.mark.long
def test_easy_needs_about_twice_as_long_as_hard():
    easy, hard = (np.mean(ticks_of(brain, range(1, 21))) * DT for brain in ("hand1", "hand3"))
    assert easy >= 120.0
    assert 55.0 <= hard <= 68.0


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize("variant", ["standard", "party"])
@pytest.mark.parametrize("brain", ["hand1", "hand2", "hand3"])
def test_robots_hardly_ever_stand_still(variant, brain):
    found = measure(Trial("factory", variant, 12, 1, [brain] * 4, fast=can_compile()))["equal teams"]
    assert found["all"]["standing still, median"] <= 0.1
    assert all(found[floor]["standing still, median"] <= 0.1 for floor in FLOORS)


def test_a_waiting_robot_moves_to_and_fro_near_its_place():
    """All machines A are occupied for good, and it carries a raw pallet."""
    match = match_of("factory", ("hand3", "off", "off", "off"), minutes=3.0)
    state = match.state
    state.rules.collect = 10**6
    while not state.loads[0].pallet:
        match.tick()
    for m, machine in enumerate(state.machines):
        if machine.kind == A:
            for s in (MACHINE_SLOTS + 2 * m, MACHINE_SLOTS + 2 * m + 1):
                state.slots[s].pallet = 16
    speeds, places = [], []
    while state.loads[0].pallet and match.seconds < 12.0:
        match.tick()
        if mind_of(match).near and match.seconds > 6.0:
            speeds.append(abs(state.robots[0].linear))
            places.append((state.robots[0].x, state.robots[0].y))
    assert len(speeds) > HZ
    assert np.median(speeds) > 20.0
    assert np.ptp(np.array(places), axis=0).max() < 300.0


def test_the_weakest_sets_out_the_wrong_way_and_says_so():
    match = match_of("factory", ("hand1", "off", "off", "off"), minutes=3.0)
    mind, wrong = mind_of(match), 0
    while not match.over and match.seconds < 60.0:
        match.tick()
        if mind.detour > 0 and mind.resting <= 0 and not mind.freeing:
            wrong += 1
            assert (told(match).behaviour, told(match).reason) == ("detour", "lost")
    assert wrong > HZ


def test_the_strongest_never_does():
    for brain, slips in (("hand1", True), ("hand2", False), ("hand3", False)):
        mind = make_brain("factory", brain, 1).mind
        assert (mind.slip > 0.0) is slips
        assert bool(mind.joint) is not slips


def test_while_it_thinks_it_draws_back_but_not_onto_a_person():
    match = match_of("factory", ("hand1", "off", "off", "off"), minutes=3.0)
    mind, robot = mind_of(match), match.state.robots[0]
    while not match.state.loads[0].pallet:
        match.tick()
    run(match, HZ)
    assert mind.resting > 0
    assert robot.linear < -20.0
    worker = match.state.workers[0]
    for _ in range(HZ // 2):
        worker.x, worker.y = robot.x + 90.0 * -np.cos(robot.heading), robot.y + 90.0 * -np.sin(robot.heading)
        match.tick()
    assert abs(robot.linear) < 20.0
    assert match.state.loads[0].hits == 0


def test_an_ordinary_pallet_is_told_as_in_standard():
    shop = without_loose(party(present=(0, 1)))
    shop.state.turns[:] = [2, 0, 1, 3]
    shop.tick()
    p = shop.own(ICE)[0]
    shop.press(0, shop.slot(ENTRY, ICE))
    shop.pallets[p].state, shop.pallets[p].rush = DONE, 0
    aim = first_aim(shop)
    assert shop.slots[aim].kind == EXIT
    assert (told(shop.match).behaviour, told(shop.match).reason) == ("deliver", "done")
