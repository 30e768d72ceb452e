"""Robot Factory as PPO learns it: success is that of the results, work counts once, and minutes make a strong pair."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import product

import pytest

from pigaming_app.ai.networks.factory_progress import progress_of_pallets, success
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.training import Training, in_threads
from pigaming_app.games.factory.pallets import move
from pigaming_app.games.factory.state import (
    DELIVERED,
    DONE,
    HALF,
    IN_MACHINE,
    IN_SLOT,
    MACHINE_SLOTS,
    ON_ROBOT,
    RAW,
    SHELVES,
    SHIPPED,
    A,
    B,
)
from pigaming_app.games.match import victory
from pigaming_app.sim.kernel import can_compile
from tests.matches import match_of


@pytest.mark.parametrize("variant", ["standard", "party"])
def test_success_is_the_victory_that_the_results_show(variant):
    match = match_of("factory", "idle idle idle idle", "hall", variant=variant)
    state = match.state
    for ours, theirs, done, undone in product(range(5), range(5), (0, 3), (0, 3)):
        state.delivered[:] = state.points[:] = [ours, theirs]
        state.loads[0].steps, state.loads[3].steps = done, undone
        for seat in range(4):
            expected = 2.0 * victory(match.game, state, seat) - 1.0
            assert success(state, state.robots[seat].team) == expected, (ours, theirs, done, undone, seat)


def test_success_of_allies_is_a_third_for_each_star():
    state = match_of("factory", "idle idle", "hall", variant="together").state
    found = []
    for state.stars in range(4):
        found.append(success(state, 0))
    assert found == pytest.approx([-1.0, 1 / 3, 2 / 3, 1.0])


def test_a_pallet_makes_three_steps_from_its_entry_to_its_exit():
    state = match_of("factory", "idle idle", "hall").state
    kinds = [machine.kind for machine in state.machines]
    first, last = kinds.index(A), kinds.index(B)
    into, out = MACHINE_SLOTS + 2 * first, MACHINE_SLOTS + 2 * first + 1
    stations = [
        (RAW, ON_ROBOT, 0, 0.25),
        (RAW, IN_SLOT, into, 0.5),
        (RAW, IN_MACHINE, first, 0.5),
        (HALF, IN_SLOT, out, 1.0),
        (HALF, ON_ROBOT, 0, 1.25),
        (HALF, IN_SLOT, MACHINE_SLOTS + 2 * last, 1.5),
        (HALF, IN_MACHINE, last, 1.5),
        (DONE, IN_SLOT, MACHINE_SLOTS + 2 * last + 1, 2.0),
        (DONE, ON_ROBOT, 0, 2.25),
    ]
    assert progress_of_pallets(state, 0) == progress_of_pallets(state, 1) == 0.0
    for state.pallets[0].state, place, at, expected in stations:
        move(state, 0, place, at)
        assert progress_of_pallets(state, 0) == expected
    state.pallets[0].state, state.delivered[0] = DELIVERED, 1
    move(state, 0, IN_SLOT, SHELVES)
    assert progress_of_pallets(state, 0) == 3.0
    move(state, 0, SHIPPED, 0)
    assert progress_of_pallets(state, 0) == 3.0
    assert progress_of_pallets(state, 1) == 0.0


@pytest.mark.long
@pytest.mark.again  # a minute of training, and as much of compiling
@pytest.mark.skipif(not can_compile(), reason="numba is not installed")
def test_a_minute_of_training_beats_the_third_level():
    with ThreadPoolExecutor(2) as threads:
        training = Training(replace(TASKS["factory"], rivals=("level3",)), 1, 300)
        (before,) = training.measure(10, threads).values()
        for _ in range(60):
            training.update(in_threads(training, threads), threads)
        (after,) = training.measure(20, threads).values()
    assert before.share < 0.1
    assert after.interval[0] > 0.5
