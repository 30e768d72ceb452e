"""Networks of whole numbers: NumPy, loops and exact fractions agree; both bodies play alike."""

from fractions import Fraction
from math import floor

import numpy as np
import pytest

from pigaming_app.ai.learning.rollout import Batch, cast_with_baselines
from pigaming_app.ai.networks.encoding import UNIT, saturating, whole
from pigaming_app.ai.networks.files import policy_of
from pigaming_app.ai.networks.layers import EXACT, Layers, squash_all
from pigaming_app.ai.networks.pitanks import ENCODING
from pigaming_app.ai.networks.policy import (
    HIDDEN,
    Handicap,
    Policy,
    _forward_loops,
    mind_record,
    network_brain,
    odds,
    packed_layers,
    squash,
)
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.setup import make_setup
from pigaming_app.sim.record import digest, dtype
from tests.ai.networks.random_network import random_network
from tests.test_every_game import company


def random_layers(seed=0, spread=40.0):
    """A network with random weights."""
    random = np.random.default_rng(seed)
    sizes = ((ENCODING.size, HIDDEN), (HIDDEN, HIDDEN), (HIDDEN, ENCODING.outputs))
    matrices = [np.rint(random.normal(size=size) * spread) for size in sizes]
    return Layers(matrices, [np.rint(random.normal(size=units) * spread) for _, units in sizes])


def test_the_groups_name_every_input():
    assert sum(length for _, length in ENCODING.groups) == ENCODING.size
    assert ENCODING.size % 2 == 0, "single-precision lists fill whole 8 bytes"


@pytest.mark.parametrize(("value", "expected"), [(0.0, 0), (1.0, 256), (7.0, 256), (-7.0, -256), (0.501, 128)])
def test_inputs_are_whole_and_clamped(value, expected):
    assert whole(value) == expected


def test_bends_are_odd_and_stay_below_one():
    assert [saturating(x) for x in (0.0, 1.0, -1.0, 9.0)] == [0.0, 0.5, -0.5, 0.9]
    total = np.linspace(-4.0, 4.0, 1001) * UNIT * UNIT
    bent = np.array([squash(x) for x in total.tolist()])
    assert (bent == squash_all(total.copy())).all()
    assert np.abs(bent / UNIT - np.tanh(total / UNIT / UNIT)).max() < 0.03
    assert (np.diff(bent) >= 0).all()


def test_the_forward_pass_is_exact():
    layers, inputs = random_layers(), [float(x) for x in np.random.default_rng(1).integers(-256, 257, ENCODING.size)]
    x = [int(value) for value in inputs]
    for k, (matrix, bias) in enumerate(zip(layers.matrices, layers.biases, strict=True)):
        sums = [
            sum(a * int(b) for a, b in zip(x, column, strict=True)) + int(extra)
            for column, extra in zip(matrix.T, bias, strict=True)
        ]
        x = [int(squash(float(total))) for total in sums] if k < 2 else sums
    assert layers.logits(inputs) == x
    assert layers.largest_sum() < EXACT


@pytest.mark.parametrize(("game", "units"), [*((game, HIDDEN) for game in ENCODINGS), ("race", 8), ("race", 128)])
def test_the_loops_of_compiled_code_are_the_matrices_of_numpy(game, units):
    """Plain, on NumPy records: inputs of every length, none, some or all of them at work."""
    chance, encoding = np.random.default_rng(2), ENCODINGS[game]
    layers = policy_of(random_network(3, game, units=units)).layers
    weights, mind = packed_layers(layers).view(np.recarray)[0], np.recarray(1, dtype(mind_record(encoding, units)))[0]
    for share in (0.0, 0.1, 0.5, 1.0):
        mind.inputs[:] = chance.integers(-256, 257, encoding.size) * (chance.random(encoding.size) < share)
        _forward_loops(mind, weights)
        assert mind.logits.tolist() == layers.logits(mind.inputs.tolist())
        assert not mind.hidden.any()


def test_squash_is_the_exact_value_rounded():
    for total in range(-200_000, 200_000, 9_973):
        y = max(Fraction(-1), min(Fraction(1), Fraction(total, 3 * 65536)))
        assert abs(squash(float(total)) - floor(256 * y * (3 + y * y) / (1 + 3 * y * y) + Fraction(1, 2))) <= 1


def test_odds_are_nearly_exponential():
    assert odds(0.0, 0.0, 1.0) == 1.0
    assert odds(-2.0 * UNIT * UNIT, 0.0, 1.0) == pytest.approx(np.exp(-2.0), rel=0.04)
    assert odds(-1000.0 * UNIT * UNIT, 0.0, 1.0) == 0.0


@pytest.mark.long
def test_both_bodies_of_networks_play_the_same_match_to_the_last_bit():
    kinds = BRAINS["pitanks"]
    one = network_brain("one", ENCODING, Policy(random_layers(1)))
    two = network_brain("two", ENCODING, Policy(random_layers(2)), Handicap(delay=0.2, error=0.1, sharpness=0.7))
    setups = [
        make_setup("pitanks", ["random"] * 4, arena, 1.0, 5, variant, None, list(kinds))
        for arena, variant in (("labyrinth", "party"), ("classic", "pickups"))
    ]
    line_up = [one, two, kinds["random"], two]
    plain, fast = (  # the loop of the company of test_every_game.py, which is in the cache
        Batch(setups, line_up, fast, cast_with_baselines([*line_up, *company("pitanks")], fast))
        for fast in (False, True)
    )
    for batch in (plain, fast):
        batch.play(400)
    assert [digest(row) for row in fast.matches] == [digest(state) for state in plain.matches]
    for rows, minds in zip(fast.minds, plain.minds, strict=True):
        assert [digest(row) for row in rows] == [digest(mind) for mind in minds]
    inputs = [getattr(minds[0], f"mind{minds[0].family}").inputs for minds in plain.minds]
    assert all(abs(x) <= UNIT and x == int(x) for row in inputs for x in row)


def test_a_delay_shows_others_where_they_were():
    from pigaming_app.games.match import Match

    match = Match(make_setup("pitanks", ["idle"] * 2, None, 1.0, 1, None, None, ["idle"]))
    state, mind = match.state, mind_record(ENCODING)()
    me, other = state.robots[0], state.robots[1]
    me.x, me.y, me.heading = 400.0, 450.0, 0.0
    other.x, other.y, other.heading, other.linear = 700.0, 450.0, 1.5707963267948966, 200.0
    first = sum(length for name, length in ENCODING.groups[:6])
    sines = []
    for delay in (0.0, 0.5):
        mind.senses.delay = delay
        ENCODING.encode(state, 0, mind.senses, mind.inputs)
        sines.append(mind.inputs[first + 5])
    assert sines[0] == 0
    assert sines[1] < -50, "half a second ago it was 100 px further up, to the left"


def test_a_robot_that_pushes_against_a_wall_is_seen_at_rest():
    from pigaming_app.games.match import Match

    match = Match(make_setup("pitanks", ["idle"] * 2, None, 1.0, 1, None, None, ["idle"]))
    state, mind = match.state, mind_record(ENCODING)()
    me, other = state.robots[0], state.robots[1]
    me.x, me.y, me.heading = 400.0, 450.0, 0.0
    other.x, other.y, other.heading, other.linear = 700.0, 450.0, 0.0, -256.0
    first = sum(length for name, length in ENCODING.groups[:6])
    speeds = []
    for tick, x in ((1, 700.0), (1, 700.0), (6, 700.0), (11, 680.0), (16, 1200.0)):
        state.tick, other.x = tick, x
        ENCODING.encode(state, 0, mind.senses, mind.inputs)
        speeds.append(mind.inputs[first + 14] * 400.0 / UNIT)
    assert speeds == pytest.approx([-256.0, -256.0, 0.0, -200.0, -256.0], abs=2.0), "by its motors only when it jumps"
