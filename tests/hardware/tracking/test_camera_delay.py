"""The camera's delay: stamps that are late cost little once it is measured, and are not confused with slow robots."""

from math import inf
from random import Random

import numpy as np
import pytest

from pigaming_app.hardware.commissioning.pairing import Pairing
from pigaming_app.hardware.signals import Fix
from pigaming_app.hardware.tracking.motion_delay import SURE, common_delay, motion_delay, network_delay
from tests.cases import repeated
from tests.hardware.tracking.blind_bed import BlindBed, rms

UNEQUAL, SLOW = (0.0, 0.02, 0.04, 0.01), (0.01,) * 4  # s
EVEN, LATE = (0.0,) * 4, (0.01, 0.03, 0.05, 0.09)
AGAIN = [(0.0, EVEN), (0.0, UNEQUAL), (0.05, UNEQUAL), (0.05, LATE), (0.08, EVEN), (0.08, LATE)]
AGAIN += [(0.02, dead) for dead in (EVEN, UNEQUAL, LATE)]
OTHERS = [(0.0, LATE), (0.05, EVEN), (0.08, UNEQUAL), *(pytest.param(*case, marks=pytest.mark.again) for case in AGAIN)]
UNPAIRED = (
    (0.05, (0.0,) * 4, 2.0),
    pytest.param(0.05, SLOW, 3.5, marks=pytest.mark.long),
    pytest.param(0.0, SLOW, 1.0, marks=[pytest.mark.long, pytest.mark.again]),
)


def paired(late, seed, dead=(0.0,) * 4):
    bed = BlindBed(late, seed, dead)
    for _ in range(40):
        bed.session.tick()
    pairing = Pairing(bed.rig)
    while not pairing.tick():
        bed.session.tick()
    return bed


def test_paired_robots_are_where_the_tracker_predicts_them_however_late_the_stamps():
    bed = paired(0.05, 6, UNEQUAL)
    assert bed.rig.camera_delay == pytest.approx(0.05, abs=0.008)
    bed.drive(2.0)
    assert rms(bed.drive(4.0)) < 3.0


@pytest.mark.long
@pytest.mark.parametrize("seed", [4, pytest.param(6, marks=pytest.mark.again)])
@pytest.mark.parametrize(("late", "dead"), OTHERS)
def test_that_holds_for_other_delays_and_robots(late, dead, seed):
    """Robots that are 0 to 90 ms slower than usual, 120 ms in all."""
    bed = paired(late, seed, dead)
    bed.drive(15.0)
    assert rms(bed.drive(3.0)) < (3.0 if late else 1.0)


@pytest.mark.parametrize(("late", "dead", "most"), UNPAIRED)
def test_without_pairing_the_delay_is_learnt_while_robots_drive(late, dead, most):
    bed = BlindBed(late, 16, dead)
    bed.drive(1.0)
    before = rms(bed.drive(2.0))
    assert before > 9.0 or not late
    bed.drive(17.0)
    assert rms(bed.drive(3.0)) < most


@pytest.mark.long
@pytest.mark.parametrize(("before", "after"), repeated([(0.0, 0.05), (0.05, 0.0)]))
def test_a_camera_that_becomes_later_or_earlier_after_pairing_is_followed(before, after):
    bed = paired(before, 4)
    bed.drive(5.0)
    bed.late = after
    bed.drive(1.0)
    assert rms(bed.drive(2.0)) > 9.0
    bed.drive(17.0)
    assert rms(bed.drive(3.0)) < 3.0


@pytest.mark.long
def test_robots_that_stand_are_held_or_pushed_do_not_spoil_it():
    """Two drive and are held down a quarter of the time at first; the others are held, turned and pushed about."""
    bed, random = BlindBed(0.05, 31), Random(5)
    for second in range(30):
        for robot in bed.arena.robots[:2]:
            robot.pinned = second < 8 and random.random() < 0.25
        for robot in bed.arena.robots[2:]:
            robot.pinned = True
            robot.x, robot.heading = robot.x + random.uniform(-20.0, 20.0), robot.heading + random.uniform(-1.0, 1.0)
        misses = bed.drive(1.0)
    assert rms(misses[:, :2]) < 2.0
    assert bed.rig.camera_delay == pytest.approx(0.05, abs=0.008)


def test_a_wheel_that_is_driven_by_noise_alone_has_no_delay():
    random = np.random.default_rng(1)
    sent = [(0.02 * i, *random.uniform(-200.0, 200.0, 2)) for i in range(400)]
    seen = [Fix._make((0, *random.normal(0.0, 1.0, 3), 0.033 * i)) for i in range(240)]
    assert motion_delay(sent, seen, 62.0).error > SURE
    assert motion_delay([(time, 0.0, 0.0) for time, *_ in sent], seen, 62.0).error == inf
    assert motion_delay(sent, seen[:5], 62.0).error == inf


def test_slow_robots_and_slow_networks_are_not_the_cameras():
    assert common_delay([0.05, 0.052, 0.09, 0.2]) == pytest.approx(0.051)
    assert common_delay([]) == 0.0
    assert network_delay(0.17, 0.015) == pytest.approx(0.06)
    assert network_delay(0.04, 0.015) == network_delay(None, 0.015) == 0.0
    assert network_delay(0.04, 0.02) == pytest.approx(0.005)
    assert network_delay(0.17, 0.015, 0.04) == pytest.approx(0.02)  # of a robot whose dead time is 40 ms longer
    assert network_delay(0.17, 0.015, 0.1) == 0.0
