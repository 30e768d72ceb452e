"""Motion of a robot in px and s: speed, lag, turns, turbo."""

from math import cos, exp, hypot, pi, sin

import pytest

from pigaming_app.sim.robot import GAIN, LAG, integrate, use_turbo
from pigaming_app.sim.world import DT, HZ, Robot

RULE_DRAIN, RULE_REFILL = 1 / (2 * HZ), 1 / (4 * HZ)


def robot(linear=0.0, angular=0.0, **fields):
    made = Robot()
    made.gain, made.turbo = GAIN, 1.0
    made.requested_linear, made.requested_angular = linear, angular
    for name, value in fields.items():
        setattr(made, name, value)
    return made


def rolled(made, seconds):
    for _ in range(round(seconds * HZ)):
        integrate(made)
    return made


def test_a_straight_drive_at_speed_covers_speed_times_time():
    made = rolled(robot(linear=200.0, x=100.0, y=300.0, heading=0.6, gain=1.0), 2.0)
    assert (made.x, made.y) == pytest.approx((100 + 400 * cos(0.6), 300 + 400 * sin(0.6)))
    assert made.heading == pytest.approx(0.6)


def test_from_rest_the_lag_costs_about_speed_times_lag():
    made = rolled(robot(linear=200.0), 2.0)
    # sum of 1 - (1 - gain)^k over k = 1..n, in ticks: n less (1 - gain) / gain, within a tick of LAG
    assert made.x == pytest.approx(200 * (2.0 - DT * (1 - GAIN) / GAIN), abs=1e-3)
    assert made.x == pytest.approx(200 * (2.0 - LAG), abs=200 * DT)


def test_lag_reaches_63_percent_after_80_ms():
    made = rolled(robot(linear=260.0, angular=3.0), LAG)
    assert made.linear / 260.0 == pytest.approx(1 - exp(-1))
    assert made.angular / 3.0 == pytest.approx(1 - exp(-1))


def test_reverse_drives_backwards():
    assert rolled(robot(linear=-100.0, gain=1.0), 1.0).x == pytest.approx(-100.0)


def test_quarter_turn_ends_a_radius_away():
    radius, rate = 200.0, pi / 2
    made = rolled(robot(linear=radius * rate, angular=rate, gain=1.0), 1.0)
    assert (made.x, made.y) == pytest.approx((radius, radius), abs=0.05)
    assert made.heading == pytest.approx(pi / 2)


def test_a_whole_circle_comes_back_to_where_it_began():
    made = rolled(robot(linear=260.0, angular=pi, gain=1.0), 2.0)
    assert hypot(made.x, made.y) < 1e-6


def test_turning_on_the_spot_stays_on_the_spot():
    made = rolled(robot(angular=3.0), 3.0)
    assert (made.x, made.y) == (0.0, 0.0)
    assert 0.0 <= made.heading < 2 * pi


def test_turbo_meter_empties_in_2_s_and_fills_in_4_s():
    made = robot()
    burning = 0
    while True:
        use_turbo(made, 1, RULE_DRAIN, RULE_REFILL)
        if not made.boosting:
            break
        burning += 1
    assert burning in (2 * HZ - 1, 2 * HZ)  # rounding may cost the last tick
    filling = 0
    while made.turbo < 1.0 and filling < 1000:
        use_turbo(made, 0, RULE_DRAIN, RULE_REFILL)
        filling += 1
    assert 4 * HZ - 2 <= filling <= 4 * HZ + 1
    use_turbo(made, 0, RULE_DRAIN, RULE_REFILL)
    assert made.turbo == 1.0


def test_an_empty_meter_cuts_out_until_the_button_is_released():
    made = robot(turbo=0.0)
    for _ in range(2 * HZ):
        use_turbo(made, 1, RULE_DRAIN, RULE_REFILL)
        assert not made.boosting
    assert made.turbo == 0.0
    for _ in range(HZ):
        use_turbo(made, 0, RULE_DRAIN, RULE_REFILL)
    use_turbo(made, 1, RULE_DRAIN, RULE_REFILL)
    assert made.boosting
    assert made.turbo == pytest.approx(0.25 - RULE_DRAIN)
