"""Starts are dealt by the seed of a match, evenly, and in no other way."""

from collections import Counter
from itertools import permutations

import pytest

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.registry import games
from pigaming_app.sim.world import ROBOTS
from tests.matches import match_of

DEALT = [(game, name) for game in games() for name in games()[game].variants if (game, name) != ("pitanks", "classic")]
MATCHES = 600
EVEN = 4.0  # standard deviations


def begun(game, brains, seed, variant):
    return match_of(game, brains, "", 1.0, seed, variant).state


@pytest.mark.parametrize(("game", "variant"), DEALT)
def test_robots_stand_on_the_starts_that_the_state_names(game, variant):
    arena = load(game, arenas(game)[0])
    for seed in range(6):
        match = match_of(game, ["idle"] * ROBOTS, arena, 1.0, seed, variant)
        state = match.state
        assert sorted(state.starts) == [0, 1, 2, 3]
        poses = [(robot.x, robot.y) for robot in state.robots]
        expected = arena.plan.grid if (game, variant) == ("race", "party") else arena.starts
        assert poses == [(expected[k].x, expected[k].y) for k in state.starts]
        assert [(x, y) for x, y, _, _ in match.plant.sense()] == poses, "real robots are told the same places"


@pytest.mark.long
@pytest.mark.parametrize(("game", "variant"), [("pitanks", "party"), ("race", "standard"), ("factory", "standard")])
def test_every_seat_has_every_start_equally_often(game, variant):
    """Binomial: each share within four standard deviations of a quarter."""
    found = [tuple(begun(game, ["idle"] * ROBOTS, seed, variant).starts) for seed in range(MATCHES)]
    spread = EVEN * (MATCHES * 0.25 * 0.75) ** 0.5
    for seat in range(ROBOTS):
        counts = Counter(starts[seat] for starts in found)
        assert all(abs(counts[k] - MATCHES / 4) < spread for k in range(ROBOTS)), counts
    if game != "factory":  # mates have starts on one side there
        assert {*found} == {*permutations(range(ROBOTS))}


@pytest.mark.parametrize("seed", range(8))
def test_two_robots_face_each_other_on_the_first_two_starts(seed):
    state = begun("pitanks", ["idle", "off", "off", "idle"], seed, "party")
    assert {state.starts[0], state.starts[3]} == {0, 1}


@pytest.mark.parametrize("seed", range(8))
def test_mates_have_the_starts_of_one_side(seed):
    for game in ("football", "factory"):
        starts = begun(game, ["idle"] * ROBOTS, seed, "party").starts
        assert starts[0] % 2 == starts[2] % 2 != starts[1] % 2 == starts[3] % 2


def test_a_team_of_football_keeps_its_goal():
    assert {begun("football", ["idle"] * ROBOTS, seed, "party").starts[0] % 2 for seed in range(8)} == {0}


def test_the_frozen_rules_have_fixed_starts():
    assert {tuple(begun("pitanks", ["idle"] * ROBOTS, seed, "classic").starts) for seed in range(8)} == {(0, 1, 2, 3)}
