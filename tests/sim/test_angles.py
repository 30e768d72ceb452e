"""Wrapping of angles and turns."""

from math import cos, pi, sin, tau

from hypothesis import given
from hypothesis import strategies as st

from pigaming_app.sim.angles import turn_to, wrap

ANGLES = st.floats(-20.0, 20.0)


@given(ANGLES)
def test_a_wrapped_angle_points_the_same_way_and_is_a_heading(angle):
    heading = wrap(angle)
    assert 0.0 <= heading < tau
    assert abs(cos(heading) - cos(angle)) < 1e-12
    assert abs(sin(heading) - sin(angle)) < 1e-12


@given(ANGLES)
def test_a_turn_is_the_short_way_round(angle):
    turn = turn_to(angle)
    assert -pi < turn <= pi
    assert abs(cos(turn) - cos(angle)) < 1e-12
    assert abs(sin(turn) - sin(angle)) < 1e-12


def test_three_quarters_right_is_a_quarter_left():
    assert turn_to(1.5 * pi) == -0.5 * pi
    assert wrap(-0.5 * pi) == 1.5 * pi


def test_a_hair_below_zero_is_still_a_heading():
    assert wrap(-1e-300) == 0.0
    assert wrap(tau) == 0.0
    assert turn_to(-pi) == pi
