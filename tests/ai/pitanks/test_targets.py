"""PiTanks: the levels turn to everybody, one after the other, and hunt nobody."""

from collections import Counter
from itertools import pairwise

import pytest

from tests.matches import match_of

CASES = [(level, variant) for level in ("level1", "level3", "level5") for variant in ("party", "pickups", "classic")]


def victims(level: str, variant: str, seed: int) -> dict[int, list[int]]:
    """The seats that each of three AIs hits, in order, in a minute against a random driver on seat 0.

    Ticks with hits of several robots are left out: who hit whom is known of single ones only.
    """
    match = match_of("pitanks", ("random", level, level, level), "classic", 1.0, seed, variant)
    found: dict[int, list[int]] = {1: [], 2: [], 3: []}
    tanks = match.state.tanks
    while not match.over:
        made, taken = [tank.hits for tank in tanks], [tank.taken for tank in tanks]
        match.tick()
        hitters = [i for i in range(4) if tanks[i].hits > made[i]]
        hit = [i for i in range(4) if tanks[i].taken > taken[i]]
        if len(hitters) == len(hit) == 1 and hitters[0]:
            found[hitters[0]].append(hit[0])
    return found


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize(("level", "variant"), CASES)
def test_their_hits_are_spread_evenly_and_move_on(request, level, variant):
    """A third of all hits for each of the others; two in a row on one seat are stray shots."""
    if (level, variant) == ("level3", "pickups"):
        reason = "44 % on the random driver, 42 % of 611 hits by 48 seeds; level 3 shoots little, and he is easy to hit"
        request.applymarker(pytest.mark.xfail(strict=True, reason=reason))
    hits, twice, child = 0, 0, 0
    for seed in range(36):
        for seats in victims(level, variant, seed).values():
            hits += len(seats)
            child += seats.count(0)
            twice += sum(a == b for a, b in pairwise(seats))
            if len(seats) >= 8:
                assert max(Counter(seats).values()) <= 0.75 * len(seats), "one seat is hunted"
    assert hits > 60
    assert 0.25 <= child / hits <= 0.42
    assert twice / hits <= 0.3
