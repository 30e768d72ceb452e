"""PiTanks: the levels turn to everybody, one after the other, and hunt nobody."""

from collections import Counter
from functools import cache
from itertools import pairwise
from math import comb

import pytest

from tests.matches import match_of

CASES = [(level, variant) for level in ("level1", "level3", "level5") for variant in ("party", "pickups", "classic")]
MATCHES = 36
UNLIKELY = 0.001  # chance of one accusation by mistake in all sequences of a case

Hits = dict[int, list[int]]  # by the seat that hits: the seats it hits, in order


@cache
def victims(first: str, level: str, variant: str, seed: int, minutes: float = 1.0) -> Hits:
    """Whom each of four AIs hits, `first` on seat 0 and `level` on the others.

    Ticks with hits of several robots are left out: who hit whom is known of single ones only.
    """
    match = match_of("pitanks", (first, level, level, level), "classic", minutes, seed, variant)
    found: Hits = {seat: [] for seat in range(4)}
    tanks = match.state.tanks
    while not match.over:
        made, taken = [tank.hits for tank in tanks], [tank.taken for tank in tanks]
        match.tick()
        hitters = [i for i in range(4) if tanks[i].hits > made[i]]
        hit = [i for i in range(4) if tanks[i].taken > taken[i]]
        if len(hitters) == len(hit) == 1:
            found[hitters[0]].append(hit[0])
    return found


def chance(least: int, n: int, share: float) -> float:
    """Probability of at least `least` of `n` independent hits on a robot that takes `share` of all."""
    return sum(comb(n, k) * share**k * (1 - share) ** (n - k) for k in range(least, n + 1))


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize(("level", "variant"), CASES)
def test_they_hit_equal_opponents_alike(level, variant):
    """Of the hits of all four, each seat takes a quarter, each neighbour to the left a third: within 25 %."""
    seats, places = Counter[int](), Counter[int]()
    for seed in range(MATCHES):
        for hitter, hit in victims(level, level, variant, seed).items():
            seats.update(hit)
            places.update((seat - hitter) % 4 for seat in hit)
    for found, equal in ((seats, 4), (places, 3)):
        assert len(found) == equal
        assert all(abs(n * equal / found.total() - 1) <= 0.25 for n in found.values()), found


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize(("level", "variant"), CASES)
def test_none_of_them_hunts_an_easy_prey(level, variant):
    """A random driver is hit more often than they are, but by all of them and not in series: two hits in a row on one
    seat are stray shots, and no robot hits one seat more often than chance explains.
    """
    found = [
        hit
        for seed in range(MATCHES)
        for hitter, hit in victims("random", level, variant, seed).items()
        if hitter and len(hit) > 1
    ]
    hits = sum(map(len, found))
    assert hits > 60
    assert sum(a == b for hit in found for a, b in pairwise(hit)) / hits <= 0.3
    shares = {seat: n / hits for seat, n in Counter(seat for hit in found for seat in hit).items()}
    for hit in found:
        for seat, n in Counter(hit).items():
            assert chance(n, len(hit), shares[seat]) > UNLIKELY / len(found), f"{n} of {len(hit)} on seat {seat}"


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize(("level", "variant"), CASES)
def test_their_hits_are_spread_evenly(request, level, variant):
    """About a third of all hits for each of the others, a random driver too."""
    if (level, variant) == ("level3", "pickups"):
        reason = "42.4 % on the random driver of 904 hits by 72 seeds; level 3 shoots little, and he is easy to hit"
        request.applymarker(pytest.mark.xfail(strict=True, reason=reason))
    found = [victims("random", level, variant, seed) for seed in range(MATCHES)]
    hits = [seat for one in found for hitter in (1, 2, 3) for seat in one[hitter]]
    assert 0.25 <= hits.count(0) / len(hits) <= 0.42
