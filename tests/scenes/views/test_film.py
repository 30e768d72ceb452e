"""The packing of a film is that of the records."""

import pytest

from pigaming_app.games.registry import games
from pigaming_app.scenes.views.film import to_bytes
from pigaming_app.sim import record
from tests.sim.test_record import filled


@pytest.mark.parametrize("game", games())
def test_a_state_with_a_different_number_in_every_field_is_packed_as_its_record(game: str) -> None:
    for seed in range(3):
        state = filled(games()[game].state, seed)
        assert to_bytes(state) == record.to_bytes(state)
