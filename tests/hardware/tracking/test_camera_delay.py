"""The camera's delay: stamps that are late cost little once it is measured, and are not confused with slow robots."""

import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.commissioning.pairing import Pairing
from pigaming_app.hardware.control.motion_delay import common_delay, network_delay
from tests.hardware.tracking.blind_bed import BlindBed, rms

UNEQUAL = (0.0, 0.02, 0.04, 0.01)  # s


def paired(late, seed, dead=(0.0,) * 4):
    bed = BlindBed(late, seed, dead)
    for _ in range(40):
        bed.session.tick()
    pairing = Pairing(bed.rig)
    while not pairing.tick():
        bed.session.tick()
    return bed


@pytest.mark.parametrize(("late", "seed", "dead"), [(0.0, 3, UNEQUAL), (0.05, 6, (0.0,) * 4)])
def test_paired_robots_are_where_the_tracker_predicts_them_however_late_the_stamps(late, seed, dead):
    bed = paired(late, seed, dead)
    assert bed.rig.camera_delay == pytest.approx(late, abs=0.008)
    bed.drive(2.0)
    assert rms(bed.drive(4.0)) < 3.0


@pytest.mark.long
@pytest.mark.parametrize("dead", [(0.0,) * 4, UNEQUAL])
@pytest.mark.parametrize("late", [0.0, 0.02, 0.05, 0.08])
@pytest.mark.parametrize("seed", [4, 6])
def test_that_holds_for_other_delays_and_robots(late, dead, seed):
    bed = paired(late, seed, dead)
    bed.drive(3.0)
    after = rms(bed.drive(6.0))
    assert after < 3.0
    if not late:
        plain = BlindBed(0.0, seed, dead)
        plain.rig.tracker.learn_delay = lambda networks: None
        plain.drive(3.0)
        assert after < rms(plain.drive(6.0)) + 0.3


def test_without_pairing_the_delay_is_learnt_while_robots_drive():
    bed = BlindBed(0.05, 3)
    bed.drive(1.0)
    before = rms(bed.drive(2.0))
    bed.drive(8.0)
    assert rms(bed.drive(3.0)) < 3.0 < 6.0 < before


def test_a_camera_that_becomes_later_after_pairing_is_followed():
    bed = paired(0.0, 4)
    bed.drive(5.0)
    bed.late = 0.05
    bed.drive(12.0)
    assert bed.rig.camera_delay > 0.02
    assert rms(bed.drive(3.0)) < 8.0  # 13 when nothing is learnt


def test_slow_robots_and_slow_networks_are_not_the_cameras():
    assert common_delay([0.05, 0.052, 0.09, 0.2]) == pytest.approx(0.051)
    assert common_delay([]) == 0.0
    assert network_delay(0.17, 0.015) == pytest.approx(0.06)
    assert network_delay(0.04, 0.015) == network_delay(None, 0.015) == 0.0
    assert network_delay(0.04, 0.02) == pytest.approx(0.005)
