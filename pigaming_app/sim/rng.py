"""Random numbers, identical in plain and compiled code: the generator's state is a number in the match record.

A linear congruential generator modulo 2**31 (constants of the example in ISO C); only its high bits are used. Products
stay below 2**62, so that numba's wrapping integers and Python's unbounded ones agree.
"""

from typing import Protocol

from pigaming_app.sim.kernel import kernel

MASK = (1 << 31) - 1
SEEDS = 1 << 60  # seeds of matches lie in [-SEEDS, SEEDS), so that those of four minds a match are all different


class Rng(Protocol):
    """A record with a generator's state: a match, or the mind of a brain."""

    random: int


@kernel
def uniform(owner: Rng) -> float:
    """The next number in [0, 1) of the generator `owner.random`."""
    owner.random = (owner.random * 1103515245 + 12345) & MASK
    return float(owner.random >> 8) / 8388608.0


@kernel
def bell(owner: Rng) -> float:
    """An approximately normal number, mean 0, standard deviation 0.5: the sum of three uniform ones less its mean."""
    return float(uniform(owner) + uniform(owner) + uniform(owner) - 1.5)


def training_seed(number: int) -> int:
    """The seed of training match `number`, from 0. All are negative; matches played or measured have seeds from 0."""
    return -1 - number


def seeded(seed: int) -> int:
    """The generator's state for a seed, which may be any whole number; neighbouring seeds give unrelated states."""
    mixed = (seed ^ 0x5DEECE66D) & ((1 << 64) - 1)
    for _ in range(2):
        mixed = ((mixed ^ (mixed >> 31)) * 0x9E3779B97F4A7C15) & ((1 << 64) - 1)
    return (mixed >> 17) & MASK
