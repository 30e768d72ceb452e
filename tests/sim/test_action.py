"""The stick is clamped and quantised to 64ths."""

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pigaming_app.sim.action import quantise, set_action
from pigaming_app.sim.world import Action


@given(st.floats())
def test_a_quantised_stick_is_a_whole_number_of_64ths_in_range(value):
    notched = quantise(value)
    assert -1.0 <= notched <= 1.0
    assert notched * 64 == int(notched * 64)
    if -1.0 <= value <= 1.0:
        assert abs(notched - value) <= 0.5 / 64
    assert quantise(notched) == notched


@pytest.mark.parametrize(
    ("value", "held"),
    [(2.0, 1.0), (-7.0, -1.0), (inf, 1.0), (-inf, -1.0), (nan, 0.0), (0.5, 0.5), (1 / 200, 0.0), (1 / 100, 1 / 64)],
)
def test_a_stick_pushed_too_far_stops_at_the_edge(value, held):
    assert quantise(value) == held


def test_set_action_sets_stick_and_buttons():
    action = Action()
    set_action(action, 3.0, -0.25, 7, 0)
    assert (action.linear, action.angular, action.fire, action.turbo) == (1.0, -0.25, 1, 0)
    set_action(action, 0.0, 0.0, 0, 2)
    assert (action.linear, action.angular, action.fire, action.turbo) == (0.0, 0.0, 0, 1)
