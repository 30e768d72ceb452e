"""Pairing and latency on a simulated mat without rendering or radio noise."""

import pytest

from pigaming_app.hardware.commissioning.latency import LatencyTest
from pigaming_app.hardware.commissioning.pairing import Pairing, PairingCase
from pigaming_app.hardware.control.kinematics import Kinematics
from pigaming_app.sim.drivetrain import Drivetrain, Wheel
from tests.hardware.mat import LATE, STARTS, TRUE, Mat


def paired(mat, channels=None, meddle=lambda pairing: None):
    """A completed pairing on a mat."""
    pairing = Pairing(mat.rig, channels)
    for _ in range(1000):
        meddle(pairing)
        if pairing.tick():
            break
        mat.pass_time()
    assert pairing.spinning is None
    return pairing


def cases(pairing):
    return {one.channel: (one.marker, one.case) for one in pairing.findings}


def test_every_robot_wears_its_own_number():
    mat = Mat()
    pairing = paired(mat)
    assert cases(pairing) == {i: (i, PairingCase.FITS) for i in range(4)}
    assert pairing.channels == (0, 1, 2, 3)
    mat.pass_time(0.5)
    assert all(abs(robot.angular) < 0.05 for robot in mat.robots)


def test_one_robot_spins_at_a_time_and_stays_where_it_is():
    mat = Mat()
    spun = []

    def look(pairing):
        turning = [i for i, robot in enumerate(mat.robots) if abs(robot.angular) > 0.5]
        assert len(turning) <= 1
        spun.extend(turning)

    paired(mat, meddle=look)
    assert list(dict.fromkeys(spun)) == [0, 1, 2, 3]
    for robot, (x, y, _) in zip(mat.robots, STARTS, strict=True):
        assert abs(robot.x - x) + abs(robot.y - y) < 15.0


def test_two_swapped_markers_are_found_and_driven_the_right_way_round():
    mat = Mat()
    mat.radio = [0, 2, 1, 3]
    pairing = paired(mat)
    assert cases(pairing)[1] == (2, PairingCase.SWAPPED)
    assert cases(pairing)[2] == (1, PairingCase.SWAPPED)
    mat.rig.channels = pairing.channels
    wheels = [None, mat.rig.kinematics[1].wheels((100.0, 0.0)), None, None]
    mat.rig.send(wheels)
    mat.pass_time(0.5)
    assert mat.robots[1].linear > 50.0
    assert abs(mat.robots[2].linear) < 1e-6


def test_a_covered_marker_does_not_turn():
    mat = Mat()
    mat.robots[3].hidden = True
    assert cases(paired(mat))[3] == (None, PairingCase.NONE)


def test_two_robots_at_one_radio_turn_together():
    mat = Mat()
    mat.radio = [0, 1, 1, 3]
    found = cases(paired(mat))
    assert found[1] == (None, PairingCase.SEVERAL)
    assert found[2] == (None, PairingCase.NONE)


def test_a_marker_that_is_worn_twice_is_found():
    mat = Mat()
    mat.robots[1].duplicate = True
    assert cases(paired(mat, [1])) == {1: (None, PairingCase.TWICE)}


def test_radios_that_are_not_heard_are_left_out(monkeypatch):
    mat = Mat()
    heard = {i: one for i, one in mat.telemetry.items() if i in (0, 3)}
    monkeypatch.setattr(Mat, "telemetry", heard)
    found = cases(paired(mat))
    assert found == {
        0: (0, PairingCase.FITS),
        1: (None, PairingCase.ABSENT),
        2: (None, PairingCase.ABSENT),
        3: (3, PairingCase.FITS),
    }


def test_channels_stay_a_permutation_when_not_all_were_found():
    mat = Mat()
    mat.radio = [2, 3, 0, 1]
    mat.robots[0].hidden = True
    pairing = paired(mat)
    assert sorted(pairing.channels) == [0, 1, 2, 3]
    assert pairing.channels == (2, 3, 0, 1)


def shaken(mat, robot=2):
    shake = LatencyTest(mat.rig, robot)
    for _ in range(1000):
        if shake.tick():
            break
        mat.pass_time()
    return shake.result()


def test_latency_is_dead_time_and_age_of_the_picture_without_the_motors_lag():
    found = shaken(Mat())
    assert found.acts == pytest.approx(TRUE.dead_time, abs=0.012)
    assert found.picture == pytest.approx(LATE, abs=0.02)
    assert found.lag == pytest.approx(TRUE.lag, abs=0.02)
    assert found.total == pytest.approx(TRUE.dead_time + LATE, abs=0.03)


def test_a_robot_that_does_not_move_has_no_latency(monkeypatch):
    mat = Mat()
    mat.radio = [0, 1, 3, 3]
    monkeypatch.setattr(mat, "send", lambda wheels: None)
    assert shaken(mat) is None


SLOW = Drivetrain(Wheel(126.0, 0.03), Wheel(126.0, 0.03), 71.0, 0.09, 0.03)  # a Thymio's


def test_slow_robots_are_paired_and_their_delay_is_measured_as_that_of_fast_ones():
    mat = Mat(train=SLOW)
    mat.rig.kinematics[:] = [Kinematics(SLOW) for _ in range(4)]
    mat.radio = [0, 2, 1, 3]
    found = cases(paired(mat))
    assert [found[channel][1] for channel in range(4)] == ["fits", "swapped", "swapped", "fits"]
    mat.radio = [0, 1, 2, 3]
    assert shaken(mat, 1).acts == pytest.approx(SLOW.dead_time, abs=0.015)
