"""The random generator: reproducible, uniform, and independent between neighbouring seeds."""

from itertools import pairwise
from types import SimpleNamespace

from hypothesis import given
from hypothesis import strategies as st

from pigaming_app.sim.rng import MASK, seeded, uniform


def draws(seed, count):
    owner = SimpleNamespace(random=seeded(seed))
    return [uniform(owner) for _ in range(count)]


def test_the_step_is_that_of_iso_c():
    owner = SimpleNamespace(random=1)
    uniform(owner)
    assert owner.random == 1103515245 + 12345


def test_the_same_seed_draws_the_same():
    assert draws(7, 100) == draws(7, 100)
    assert draws(7, 100) != draws(8, 100)


@given(st.integers())
def test_any_whole_number_is_a_seed(seed):
    assert 0 <= seeded(seed) <= MASK
    assert all(0.0 <= drawn < 1.0 for drawn in draws(seed, 10))


def test_draws_are_even():
    drawn = draws(3, 20_000)
    # the mean of n even draws has a standard deviation of 1 / sqrt(12 n) = 0.002; four of them
    assert abs(sum(drawn) / len(drawn) - 0.5) < 0.0082
    tenths = [sum(int(value * 10) == tenth for value in drawn) for tenth in range(10)]
    assert all(abs(count - 2000) < 4 * (20_000 * 0.1 * 0.9) ** 0.5 for count in tenths)


def test_neighbouring_seeds_begin_far_apart():
    firsts = sorted(draws(seed, 1)[0] for seed in range(1000))
    assert max(b - a for a, b in pairwise(firsts)) < 0.02
    pairs = [(draws(seed, 1)[0], draws(seed + 1, 1)[0]) for seed in range(1000)]
    mean = sum((a - 0.5) * (b - 0.5) for a, b in pairs) / len(pairs)
    assert abs(mean) < 4 / 12 / 1000**0.5
