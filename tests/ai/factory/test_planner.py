"""The planner of Robot Factory and its five levels: near the bound alone, in time at machines, considerate, graded."""

from functools import cache
from math import hypot

import numpy as np
import pytest

from pigaming_app.ai.explanations.registry import thoughts_of
from pigaming_app.ai.factory.brains import LEVELS, PLANNER
from pigaming_app.ai.factory.navigation import FAR
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.state import HALF, ICE, MACHINE_SLOTS, A
from pigaming_app.games.game import Seat, Setup
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import DT, HZ
from tests.bench.fairness_factory import measure
from tests.bench.makespan_bound import Floor, Search, bound
from tests.bench.trial import Trial
from tests.cases import one_in
from tests.games.factory.shop import Shop
from tests.matches import finished, match_of

FLOORS = arenas("factory")
NAMES = [level.name for level in LEVELS]


@cache
def alone(floor, seed=1):
    """A match of two mates without rivals, and the distance of the nearer one from each product when it is done, px."""
    match = match_of("factory", ("planner", "off", "planner", "off"), floor, seed=seed)
    state, gaps = match.state, []
    while not match.over:
        match.tick()
        for m, machine in enumerate(state.machines):
            if machine.pallet and machine.left == 1:
                out = state.slots[MACHINE_SLOTS + 2 * m + 1]
                gaps.append(min(hypot(state.robots[i].x - out.x, state.robots[i].y - out.y) for i in (0, 2)))
    return match, gaps


# --------------------------------------------------------------------------------------------------------------- alone


@pytest.mark.parametrize("floor", FLOORS)
def test_two_alone_are_near_the_bound_and_never_below_it(floor):
    match = alone(floor)[0]
    least = bound(floor, 2, 4)
    assert match.state.winner == 1 + ICE
    assert sum(load.spoiled for load in match.state.loads) == 0
    assert least <= match.seconds <= 1.5 * least


def test_a_robot_is_there_when_the_product_is_done():
    """At half of the eight products at least a robot is within 150 px."""
    gaps = [gap for floor in FLOORS for gap in alone(floor)[1]]
    assert len(gaps) == 8 * len(FLOORS)
    assert np.mean([gap < 150.0 for gap in gaps]) >= 0.5


def test_the_bound_is_that_of_an_exhaustive_search():
    """Without pruning the same schedules are found; one pallet is a chain that can be added up by hand."""

    class Exhaustive(Search):
        def hopeless(self, *state):
            return False

        def dominated(self, *state):
            return False

    for floor in FLOORS:
        two = Floor(floor, ICE, 2, 2)
        assert Search(two).shortest() == pytest.approx(Exhaustive(two).shortest())
        one = Floor(floor, ICE, 2, 1)
        chains = [
            max(one.lifts[0] + one.bring[a], one.put + min(call[a] for call in one.call))
            + 12.0
            + max(one.carry[a, b], min(one.walk[a, b], 0.0))
            + one.deliver[b]
            for a in one.first
            for b in one.second
        ]
        assert Search(one).shortest() >= min(chains) - 1e-9


# ----------------------------------------------------------------------------------------------------------- in company


@pytest.mark.parametrize("floor", one_in(3, FLOORS))
def test_four_of_the_best_spoil_nothing_and_one_team_delivers_everything(floor):
    match = match_of("factory", ("planner",) * 4, floor, seed=2)
    while not match.over:
        match.tick()
        for seat in range(4):
            if match.state.tick % (2 * HZ) == seat:
                assert thoughts_of(match, seat)
    assert match.state.winner
    assert match.seconds < 120.0
    assert sum(load.spoiled for load in match.state.loads) == 0
    assert sum(load.hits for load in match.state.loads) <= 2


def test_the_way_round_a_machine_is_the_shorter_one():
    """From above a machine A to its output below, on the side where no worker stands."""
    shop = Shop(present=(0,))
    out, machine = shop.output_of(A), shop.state.machines[shop.slots[shop.output_of(A)].machine]
    for side in (-30.0, 30.0):
        brain = make_brain("factory", "planner", 0)
        shop.give(shop.own(ICE)[0], HALF, out)
        shop.rails.poses[0] = (machine.x + side, machine.y - 150.0, 1.57)
        shop.match.sit(0, brain)
        shop.tick(round(0.6 * HZ))
        assert shop.loads[0].aim - 1 == out
        obs = brain.mind.obs
        assert not obs.straight
        assert (obs.waypoint_x - machine.x) * side > 0.0
        assert 200.0 < brain.mind.ways.to_go < FAR


# -------------------------------------------------------------------------------------------------------------- levels


def test_the_levels_are_five_and_named_in_order():
    assert [f"level{number}" for number in range(1, 6)] == NAMES
    assert len({level.think for level in LEVELS}) == 1, "one compiled loop plays them all"


def test_higher_levels_need_less_time():
    """Alone in the hall."""
    matches = [match_of("factory", (name, "off", name, "off"), seed=2) for name in NAMES[::2]]
    for match in matches:
        finished(match)
    times = [match.seconds for match in matches]
    assert times == sorted(times, reverse=True)
    assert times[0] > 1.25 * times[-1]


@pytest.mark.long
@pytest.mark.again  # of `test_variants`, with the other levels
@pytest.mark.parametrize("variant", ["standard", "party", "together"])
@pytest.mark.parametrize("level", NAMES)
def test_no_level_stands_still_for_long(variant, level):
    found = measure(Trial("factory", variant, 12, 1, [level] * 4, fast=can_compile()))["equal teams"]
    assert all(found[floor]["standing still, median"] <= 0.15 for floor in FLOORS)
    assert all(found[floor]["pallets spoiled"] == 0 for floor in FLOORS)


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize("floor", FLOORS)
def test_the_best_are_seldom_far_from_the_bound(floor):
    """The median of 30 matches of two alone."""
    one, two, three, four = (Seat(name, i % 2) for i, name in enumerate(("planner", "off") * 2))
    setups = [Setup("factory", floor, (one, two, three, four), 5.0, seed, "standard", 4) for seed in range(1, 31)]
    batch = Batch(setups, [PLANNER, None, PLANNER, None], can_compile())
    batch.play(5 * 60 * HZ)
    assert np.median([match.tick for match in batch.ended()]) * DT <= 1.4 * bound(floor, 2, 4)
