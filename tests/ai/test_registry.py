"""Names of brains: the hand-written strengths, the levels behind which they stand, and what the lobby offers."""

import pytest

from pigaming_app.ai.auto import NAME as AUTO
from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import AIS, BRAINS, level_of
from pigaming_app.games.registry import games
from pigaming_app.storage.settings import Settings


@pytest.mark.parametrize("game", games())
def test_a_level_is_a_name_of_a_brain(game):
    kinds = BRAINS[game]
    assert [kinds[level].name for level in LEVELS] == [*LEVELS]
    assert [level_of(name) for name in ("level1", "level2", "level3", "level4", "level5", "hand3")] == [
        1,
        2,
        3,
        4,
        5,
        0,
    ]


@pytest.mark.parametrize("game", games())
def test_the_lobby_offers_brains_and_begins_with_the_levels(game):
    assert set(AIS[game].rivals) <= set(BRAINS[game])
    assert AIS[game].rivals[:5] == LEVELS
    assert Settings().strength == AUTO


def test_both_state_machines_are_offered_after_all_others():
    assert AIS["pitanks"].rivals[-2:] == ("fsm", "classic")
