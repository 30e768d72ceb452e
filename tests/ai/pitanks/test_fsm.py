"""The cautious and the thesis robot of PiTanks: their play is fixed, and they are never stuck."""

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.sim.record import digest
from tests.ai.pitanks.stuck import stuck
from tests.cases import one_in
from tests.matches import match_of, run

SEED, TICKS = 7, 1500
DIGESTS = {
    ("fsm", "classic", "pickups"): "5c09a07d8a743825b5067a6895a847a4ca41aeca7cd080322f6ecf67e7aeb742",
    ("fsm", "labyrinth", "plain"): "2b6aada99d526233d7f8a69b1f7a685c056ffc50e8b1764d871b3ab21d5016a2",
    ("fsm", "trenches", "classic"): "059a78e9a365afa74b1894e1ab52870b921b3bf95e190cd20ba6c02cc0af9f56",
    ("classic", "classic", "pickups"): "78900901150c97f10514c595658e94886f9ddb8462d64983940789a0efac7d41",
    ("classic", "labyrinth", "plain"): "b55e57440847188f0b8e9dc8b8bef513b808c25323c6e93a8560c0fef09930a3",
    ("classic", "trenches", "classic"): "3584fc63bccbb793cf81e9fa4d97335a036fb4acd2461bcec4162cd6da9a0066",
}


@pytest.mark.parametrize(("brain", "arena", "variant"), DIGESTS)
def test_their_play_does_not_change(brain, arena, variant):
    match = run(match_of("pitanks", [brain] * 4, arena, 1.0, SEED, variant), TICKS)
    assert digest(match.state) == DIGESTS[brain, arena, variant]


@pytest.mark.parametrize("arena", one_in(5, arenas("pitanks")))
def test_fsm_is_never_stuck(arena):
    for seed in (1, 2):
        assert stuck(arena, seed, ("fsm", "fsm", "off", "off"), "pickups") == []
