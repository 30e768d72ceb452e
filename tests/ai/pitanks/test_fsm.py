"""The cautious and the thesis robot of PiTanks: their play is fixed, and they are never stuck."""

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.sim.record import digest
from tests.ai.pitanks.stuck import stuck
from tests.cases import one_in
from tests.matches import match_of, run

SEED, TICKS = 7, 1500
DIGESTS = {
    ("fsm", "classic", "pickups"): "74e2311489b4966480d1438abdd15c730312660ede7c9119a216ee3ae6b28c5f",
    ("fsm", "labyrinth", "plain"): "ca2ec254e0ae72f335000e3a25aea87d518ab50083dfc1e7d76b530dca3ac371",
    ("fsm", "trenches", "classic"): "5dc9e48671eb668f36a7138c71f2d7bc440fe49371787cc66006f1297586bf8e",
    ("classic", "classic", "pickups"): "55683c9e618ea6aa74a67ef2cc18e644a6b83b40883ce610925394cf3fd0edd3",
    ("classic", "labyrinth", "plain"): "a71c49b7ee61d1459d86f5c90782ccadb016111ab5b3c41706a69038baaf6f14",
    ("classic", "trenches", "classic"): "70a20bfc05a8eeaf83eed40a22cfe4cf02c3c7c7b577396a56acdb5423566865",
}


@pytest.mark.parametrize(("brain", "arena", "variant"), DIGESTS)
def test_their_play_does_not_change(brain, arena, variant):
    match = run(match_of("pitanks", [brain] * 4, arena, 1.0, SEED, variant), TICKS)
    assert digest(match.state) == DIGESTS[brain, arena, variant]


@pytest.mark.parametrize("arena", one_in(5, arenas("pitanks")))
def test_fsm_is_never_stuck(arena):
    for seed in (1, 2):
        assert stuck(arena, seed, ("fsm", "fsm", "off", "off"), "pickups") == []
