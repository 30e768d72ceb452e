"""The cautious and the thesis robot of PiTanks: their play is fixed, and they are never stuck."""

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.sim.record import digest
from tests.ai.pitanks.stuck import stuck
from tests.cases import one_in
from tests.matches import match_of, run

SEED, TICKS = 7, 1500
DIGESTS = {
    ("fsm", "classic", "pickups"): "c5286ea9226d6de3e65a55d1807850c23083baf95c0676741536a74b38844f53",
    ("fsm", "labyrinth", "plain"): "b590877c495fee4049ee5408e43cab7238a52becf1079fb08c6f3c68b1d24b3c",
    ("fsm", "trenches", "classic"): "915d51e9f6bb6b1ffd432833712a6c4489c76b61546ff76019e71b370141e437",
    ("classic", "classic", "pickups"): "fa36d4d57fdea44cf14c1a3719006f250942f7085d6d0bbc4cebd7d3ab6bc941",
    ("classic", "labyrinth", "plain"): "835d5980c4d80600d0b0810d3be7365f98963553c06e979f83c0b7256b08c8cd",
    ("classic", "trenches", "classic"): "82fe4d3e16944172a4a159d67cca9e364f9c3cb7ca6c19fe4d8e782361d67ee6",
}


@pytest.mark.parametrize(("brain", "arena", "variant"), DIGESTS)
def test_their_play_does_not_change(brain, arena, variant):
    match = run(match_of("pitanks", [brain] * 4, arena, 1.0, SEED, variant), TICKS)
    assert digest(match.state) == DIGESTS[brain, arena, variant]


@pytest.mark.parametrize("arena", one_in(5, arenas("pitanks")))
def test_fsm_is_never_stuck(arena):
    for seed in (1, 2):
        assert stuck(arena, seed, ("fsm", "fsm", "off", "off"), "pickups") == []
