"""The cautious and the thesis robot of PiTanks: their play is fixed, and they are never stuck."""

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.sim.record import digest
from tests.ai.pitanks.stuck import stuck
from tests.cases import one_in
from tests.matches import match_of, run

SEED, TICKS = 7, 1500
DIGESTS = {
    ("fsm", "classic", "pickups"): "810e1524db395c0510d82bc5d38d02b5458c1b7831408765714398b50a3e0a88",
    ("fsm", "labyrinth", "plain"): "71e854d8aa97ce764077e8b461bbdbc5e8c40efda1a49bd91796714740ed2eb0",
    ("fsm", "trenches", "classic"): "0418fef5e23dde57e28f6e50bf0af5021874146b244fc1f61b0145d43931cee0",
    ("classic", "classic", "pickups"): "5c8aab03ebe9bf772872877f7ac3892da0d2fd2aee19733f50f03a682075ce97",
    ("classic", "labyrinth", "plain"): "35ac2858e6128eb105697ea89ca4c92e12182651a5617dad66da75d6081a0d85",
    ("classic", "trenches", "classic"): "98112ff37c6bedfb7707fc9348d2b7b150d6736f6644d8562bf329d032a4d3a1",
}


@pytest.mark.parametrize(("brain", "arena", "variant"), DIGESTS)
def test_their_play_does_not_change(brain, arena, variant):
    match = run(match_of("pitanks", [brain] * 4, arena, 1.0, SEED, variant), TICKS)
    assert digest(match.state) == DIGESTS[brain, arena, variant]


@pytest.mark.parametrize("arena", one_in(5, arenas("pitanks")))
def test_fsm_is_never_stuck(arena):
    for seed in (1, 2):
        assert stuck(arena, seed, ("fsm", "fsm", "off", "off"), "pickups") == []
