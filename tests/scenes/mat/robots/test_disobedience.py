"""Robots that do not follow commands, on the emulated arena: fault page, stop, new pairing."""

from collections.abc import Iterator
from math import hypot

import pytest

from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.scenes.mat.robots.fault_page import FaultPage
from pigaming_app.scenes.mat.robots.match_scene import RealMatch
from pigaming_app.scenes.mat.robots.pair_again import PairAgain
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade
from tests.scenes.mat.robots.test_real_match import begun, goes_on, opened, play, until

pytest.importorskip("cv2")
WIRING = ("pinned", "lids_swapped", "motors_reversed", "motors_swapped", "motor_reversed")


@pytest.fixture(autouse=True)
def _as_it_was(mat: EmulatedSession) -> Iterator[None]:
    yield
    mat.open().channels = (0, 1, 2, 3)


def named(arcade: Arcade) -> list[tuple[str, int | None]]:
    return [(fault.name, fault.robot) for fault in arcade.shown(FaultPage).faults]


def gathering(arcade: Arcade) -> RealMatch:
    """A match whose robots are still driving to their start positions."""
    return opened(arcade, "pitanks", "level3 level1 level1 level1", 1.0)


def paired(arcade: Arcade) -> PairAgain:
    """Run a new pairing from the fault page and return its page with the result."""
    arcade.press(Button.FIRE)
    page = arcade.shown(PairAgain)
    for _ in range(100):
        play(arcade, 0.2)
        if page.sentence:
            return page
    raise AssertionError("nothing is said after 20 s")


@pytest.mark.long
@pytest.mark.parametrize("fault", WIRING)
def test_a_fault_present_from_the_start_is_named_within_three_seconds(
    arcade: Arcade, mat: EmulatedSession, fault: str
) -> None:
    mat.arena.faults.switch(fault, True, 0)
    gathering(arcade)
    until(arcade, FaultPage, 3.0)
    play(arcade, 0.1)
    names = named(arcade)
    assert names
    assert all(name == "disobeys" and robot in (0, 1) for name, robot in names)
    play(arcade, 2.0)
    assert mat.arena.clock() - max(mat.arena.last_driven) > 1.5


@pytest.mark.long
@pytest.mark.parametrize("fault", ["motors_reversed", "pinned"])
def test_a_fault_that_begins_in_a_match_pauses_it_until_somebody_has_looked(
    arcade: Arcade, mat: EmulatedSession, fault: str
) -> None:
    match = begun(arcade)
    mat.arena.faults.switch(fault, True, 0)
    until(arcade, FaultPage, 6.0)
    play(arcade, 0.1)
    assert {name for name, _ in named(arcade)} == {"disobeys"}
    mat.arena.faults.switch(fault, False, 0)
    play(arcade, 1.0)
    arcade.shown(FaultPage)
    arcade.press(Button.Y)
    until(arcade, RealMatch)
    goes_on(arcade, match)


@pytest.mark.long
def test_swapped_lids_are_paired_again_from_the_page_and_the_match_goes_on(
    arcade: Arcade, mat: EmulatedSession
) -> None:
    match = gathering(arcade)
    mat.arena.faults.switch("lids_swapped", True, 0)
    until(arcade, FaultPage, 3.0)
    play(arcade, 0.1)
    arcade.press(Button.FIRE)
    arcade.shown(PairAgain)
    until(arcade, RealMatch, 25.0)
    assert arcade.context.settings.radios[:2] == [2, 1]
    assert match.gathering is not None


@pytest.mark.long
def test_reversed_motors_are_found_by_pairing_and_not_driven_again(arcade: Arcade, mat: EmulatedSession) -> None:
    gathering(arcade)
    mat.arena.faults.switch("motors_reversed", True, 1)
    until(arcade, FaultPage, 3.0)
    play(arcade, 0.1)
    page = paired(arcade)
    assert page.sentence.startswith("Robot 2 turns the wrong way")
    arcade.press(Button.BACK)
    play(arcade, 0.5)
    assert ("disobeys", 1) in named(arcade)
    arcade.press(Button.X)
    until(arcade, RealMatch)


@pytest.mark.long
def test_any_press_stops_robots_that_are_paired(arcade: Arcade, mat: EmulatedSession) -> None:
    gathering(arcade)
    mat.arena.faults.switch("motors_reversed", True, 1)
    until(arcade, FaultPage, 3.0)
    play(arcade, 0.1)
    arcade.press(Button.FIRE)
    play(arcade, 2.0)
    arcade.press(Button.BACK)
    stopped = mat.arena.clock()
    play(arcade, 1.0)
    assert max(mat.arena.last_driven) - stopped < 0.3


@pytest.mark.long
def test_a_single_reversed_motor_drives_off_only_a_hand_wide_while_pairing(
    arcade: Arcade, mat: EmulatedSession
) -> None:
    gathering(arcade)
    mat.arena.faults.switch("motor_reversed", True, 1)
    until(arcade, FaultPage, 3.0)
    play(arcade, 0.5)
    x, y, _ = mat.arena.poses()[1]
    page = paired(arcade)
    assert "check its motor wires" in page.sentence
    now_x, now_y, _ = mat.arena.poses()[1]
    assert hypot(now_x - x, now_y - y) < 60.0
