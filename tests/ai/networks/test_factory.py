"""The inputs of Robot Factory, checked against a match of hand-written brains."""

import pytest

from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.factory import ENCODING, GROUPS, LOAD, SIZE, TARGETS, WAY
from pigaming_app.games.factory.start import VARIANTS
from pigaming_app.sim.contact import drive
from tests.matches import match_of


@pytest.mark.parametrize("variant", VARIANTS)
def test_whoever_lifts_or_sets_down_does_so_at_a_target(variant):
    match = match_of("factory", ["hand3"] * 4, "yard", VARIANTS[variant].default_minutes, 4, variant)
    state, senses, inputs = match.state, [ENCODING.senses() for _ in range(4)], [[0.0] * SIZE for _ in range(4)]
    handled = missed = 0
    for _ in range(2500):
        loads = [load.pallet for load in state.loads]
        for seat, brain in enumerate(match.brains):
            brain.think(state, seat)
        for seat, load in enumerate(loads):
            if state.actions[seat].fire or state.tick % 50 == 0:
                ENCODING.encode(state, seat, senses[seat], inputs[seat])
                assert all(-UNIT <= value <= UNIT and value == int(value) for value in inputs[seat])
                assert inputs[seat][LOAD + 1 : LOAD + 6].count(UNIT) == (load > 0)
                assert inputs[seat][WAY] or inputs[seat][WAY + 1] or not inputs[seat][TARGETS]
        match.game.judge(state)
        drive(state)
        for seat, load in enumerate(state.loads):
            if load.pallet != loads[seat]:
                handled += 1
                missed += inputs[seat][LOAD + 8] != UNIT
    assert handled > 30
    assert missed <= handled // 40  # now and then the fourth best will do


def test_the_groups_cover_all_inputs():
    assert sum(length for _, length in GROUPS) == SIZE == ENCODING.size
