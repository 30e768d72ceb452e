"""Kinematics: twist to wheel commands and back."""

import pytest

from pigaming_app.hardware.control.kinematics import LEVELS, Kinematics
from pigaming_app.hardware.control.motion_model import WheelCorrection
from pigaming_app.hardware.control.rig import UNMEASURED
from pigaming_app.sim.drivetrain import NOMINAL

WORN = WheelCorrection(0.93, 1.05, 1.02, 0.01, 8.0)
DESIRED = [(260.0, 0.0), (-150.0, 1.0), (0.0, 2.5), (200.0, -1.5)]


@pytest.mark.parametrize("desired", DESIRED)
@pytest.mark.parametrize("drivetrain", [NOMINAL, UNMEASURED])
def test_on_average_the_wheels_run_as_asked_though_the_radio_knows_63_levels(desired, drivetrain):
    kinematics = Kinematics(drivetrain)
    ran = [kinematics.expected_twist(kinematics.wheels(desired)) for _ in range(200)]
    assert sum(linear for linear, _ in ran) / 200 == pytest.approx(desired[0], abs=1.0)
    assert sum(angular for _, angular in ran) / 200 == pytest.approx(desired[1], abs=0.02)


@pytest.mark.parametrize("desired", DESIRED)
def test_what_is_learnt_of_the_wheels_is_made_up_for(desired):
    kinematics = Kinematics(UNMEASURED)
    kinematics.correction = WORN
    ran = [kinematics.expected_twist(kinematics.wheels(desired)) for _ in range(200)]
    assert sum(linear for linear, _ in ran) / 200 == pytest.approx(desired[0], abs=1.0)
    assert sum(angular for _, angular in ran) / 200 == pytest.approx(desired[1], abs=0.02)
    commands = [kinematics.wheels(desired) for _ in range(200)]
    if desired == (260.0, 0.0):
        assert sum(wheels.left for wheels in commands) > sum(wheels.right for wheels in commands)


def test_every_share_is_on_a_level_and_rest_is_rest():
    kinematics = Kinematics(UNMEASURED)
    for desired in DESIRED:
        for share in kinematics.wheels(desired):
            assert share * LEVELS == pytest.approx(round(share * LEVELS))
    assert kinematics.wheels((0.0, 0.0)) == (0.0, 0.0)
    assert kinematics.stand() == (0.0, 0.0)


def test_an_absurd_gain_is_not_believed():
    kinematics = Kinematics(NOMINAL)
    kinematics.correction = WheelCorrection(0.01, 0.01, 1.0, 0.0, 0.0)
    assert kinematics.expected_twist(kinematics.wheels((100.0, 0.0)))[0] == pytest.approx(100.0, rel=0.1)
