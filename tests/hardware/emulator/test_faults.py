"""Every fault of the emulated arena has its effect, and ends."""

import numpy as np
import pytest

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.faults import FAULTS
from tests.cases import one_in
from tests.hardware.emulator.test_emulator import found, newest
from tests.hardware.emulator.test_radio import FORWARD, broadcast


def numbers(arena):
    return sorted(number for number, _ in found(newest(arena).image))


@pytest.mark.parametrize("name", one_in(4, FAULTS))
def test_every_fault_goes_on_and_off(name):
    arena = EmulatedArena(1, refresh=30)
    arena.faults.switch(name, True, 2)
    arena.advance(0.3)
    assert arena.faults.on() == [(name, 2)]
    arena.faults.switch(name, False, 2)
    arena.advance(0.1)
    arena.camera.newest()
    arena.radio.read(1000)
    assert not arena.faults.on()
    assert numbers(arena) == [0, 1, 2, 3]


def test_an_unknown_fault_is_refused():
    with pytest.raises(ValueError, match="no fault 'rain'; there are camera_frozen,"):
        EmulatedArena(1).faults.switch("rain", True)


@pytest.mark.parametrize("name", ["camera_frozen", "camera_gone"])
def test_no_picture_arrives(name):
    arena = EmulatedArena(1, refresh=30)
    newest(arena)
    arena.faults.switch(name, True)
    newest(arena)  # pictures in transit
    assert newest(arena) is None


def test_a_stuck_camera_shows_the_same_picture_as_if_it_were_new():
    arena = EmulatedArena(1, refresh=30)
    before = newest(arena)
    arena.faults.switch("camera_stuck", True)
    after = newest(arena)
    assert after.captured > before.captured
    assert (after.image == before.image).all()


def test_markers_are_covered_doubled_or_turned_away():
    arena = EmulatedArena(1)
    arena.faults.switch("marker_covered", True, 1)
    assert numbers(arena) == [0, 2, 3]
    arena.faults.switch("upside_down", True, 0)
    assert numbers(arena) == [2, 3]
    arena.faults.switch("marker_twice", True, 3)
    assert numbers(arena) == [2, 3, 3]


def test_a_marker_in_a_hand_looks_larger():
    arena = EmulatedArena(1)

    def edge():
        corners = dict(found(newest(arena, 0.5).image))[2]
        return np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1).mean()

    on_the_mat = edge()
    arena.faults.switch("marker_held", True, 2)
    assert edge() > 1.15 * on_the_mat


def test_a_robot_that_is_carried_stands_elsewhere_after():
    arena = EmulatedArena(1, refresh=30)
    x, y, _ = arena.poses()[0]
    arena.faults.switch("carried", True, 0)
    arena.advance(1.0)
    assert arena.robots[0].height > 0
    arena.faults.switch("carried", False, 0)
    arena.advance(0.01)
    assert np.hypot(arena.poses()[0][0] - x, arena.poses()[0][1] - y) > 300
    assert arena.robots[0].height == 0


@pytest.mark.parametrize("name", ["battery_low", "robot_off", "radio_dead"])
def test_motors_stand_still(name):
    arena = EmulatedArena(1, refresh=30)
    arena.radio.write(broadcast(FORWARD))
    arena.advance(0.05)
    assert not arena.firmwares[1].stopped
    arena.faults.switch(name, True, 1)
    for _ in range(15):
        arena.radio.write(broadcast(FORWARD))
        arena.advance(0.02)
    assert arena.firmwares[1].stopped


def test_an_exposure_step_halves_the_light():
    arena = EmulatedArena(1)
    before = newest(arena).image.mean()
    arena.faults.switch("exposure_step", True)
    assert newest(arena).image.mean() == pytest.approx(before / 2, rel=0.1)
