"""A batch of matches gives the same results as single matches, plain or compiled."""

from dataclasses import replace

import numpy as np
import pytest

from pigaming_app.ai.learning.batch import initial_states, matches, step_all
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.sim.action import set_action
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import HZ
from tests.matches import run

TICKS = 400
VARIANTS = ("pickups", "plain", "classic", "pickups", "plain")


def setups():
    return [
        Setup(
            "pitanks", "classic", (Seat("human", 0), Seat("human", 1), Seat("human", 2), Seat("off", 3)), 1, i, variant
        )
        for i, variant in enumerate(VARIANTS)
    ]


def actions_at(tick):
    """Random actions of every seat of every match, (n, 4, 4), held for ten ticks."""
    luck = np.random.default_rng(tick // 10)
    sticks = luck.uniform(-1.2, 1.2, (len(VARIANTS), 4, 2))
    return np.concatenate([sticks, luck.integers(0, 2, (len(VARIANTS), 4, 2))], axis=2)


class Given:
    """A brain that plays a row of `actions_at`."""

    def __init__(self, index):
        self.index = index

    def think(self, state, seat):
        linear, angular, fire, turbo = actions_at(state.tick)[self.index][seat]
        set_action(state.actions[seat], linear, angular, int(fire), int(turbo))


@pytest.fixture(scope="module")
def alone():
    digests = []
    for i, setup in enumerate(setups()):
        match = Match(setup)
        for seat in range(4):
            match.sit(seat, Given(i))
        run(match, TICKS)
        digests.append(digest(match.state))
    return digests


def test_plain_matches_at_once_are_the_same_matches_alone(alone):
    states = initial_states(setups())
    for tick in range(TICKS):
        step_all(states, actions_at(tick).tolist())
    assert [digest(state) for state in states] == alone


@pytest.mark.parametrize("ticks", [1, 5, 10])
def test_compiled_matches_at_once_are_the_same_matches_alone(alone, ticks):
    rows = matches(setups())
    for tick in range(0, TICKS, ticks):
        step_all(rows, actions_at(tick), ticks)
    assert [digest(row) for row in rows] == alone


def test_many_ticks_at_once_are_as_many_calls_even_past_the_end():
    end = 150  # ticks: each match ends within the second call
    short = [replace(setup, minutes=end / HZ / 60) for setup in setups()]
    states, rows, once = initial_states(short), matches(short), matches(short)
    for tick in range(0, 2 * end, 100):
        step_all(states, actions_at(tick).tolist(), 100)
        step_all(rows, actions_at(tick), 100)
        for _ in range(100):
            step_all(once, actions_at(tick))
    assert once["over"].all()
    assert (once["tick"] == end).all()
    assert [digest(row) for row in rows] == [digest(row) for row in once] == [digest(state) for state in states]


def test_an_empty_batch_is_accepted():
    step_all([], [])
    step_all(matches(setups())[:0], np.zeros((0, 4, 4)))


def test_foreign_records_are_refused():
    with pytest.raises(TypeError, match="not matches of any game"):
        step_all(np.zeros(3), np.zeros((3, 4, 4)))
    with pytest.raises(TypeError, match="not matches of any game"):
        step_all([object()], [[[0] * 4] * 4])
