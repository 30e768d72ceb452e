"""PiTanks: duels of equal levels by the party rules have a winner on every arena."""

import pytest

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.learning.league import duel
from pigaming_app.games.arenas import arenas
from pigaming_app.sim.kernel import can_compile

MATCHES = 200


@pytest.mark.again
@pytest.mark.long
@pytest.mark.skipif(not can_compile(), reason="needs the extra train")
@pytest.mark.parametrize("level", LEVELS)
def test_one_duel_of_twenty_at_most_is_a_tie(level: str) -> None:
    ties = {
        arena: duel("pitanks", level, level, MATCHES, 60001, arena=arena, variant="party").ties
        for arena in arenas("pitanks")
    }
    assert {arena: n for arena, n in ties.items() if n > 0.05 * MATCHES} == {}
