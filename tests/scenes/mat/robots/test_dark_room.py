"""Real robots in a dark room, on the emulated arena: floodlight until all of them are seen."""

from collections.abc import Iterator
from random import Random

import numpy as np
import pytest

from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.scenes.mat.robots.fault_page import FaultPage
from pigaming_app.scenes.mat.robots.flood_light import FADE, LIGHT, UNSEEN
from pigaming_app.scenes.mat.robots.take_places import TakePlaces
from tests.cases import one_in
from tests.scenes.arcade import Arcade
from tests.scenes.mat.robots.test_real_match import begun, opened, play

pytest.importorskip("cv2")


@pytest.fixture(autouse=True)
def _as_it_was(mat: EmulatedSession) -> Iterator[None]:
    yield
    mat.arena.camera.painter.ambient = 1.0


def gathering(arcade: Arcade) -> TakePlaces:
    match = opened(arcade, "pitanks", "level1 level1 level1 level1", 0.1, (0, 1, 2, 3))
    assert match.gathering is not None
    return match.gathering


def scattered(mat: EmulatedSession, trial: int) -> None:
    """Robots near the rim of a mat without recent projection."""
    mat.arena.project(np.zeros((1080, 1920), np.uint8))
    random = Random(trial)
    for robot, (x, y) in enumerate(((60, 80), (1500, 90), (1520, 820), (90, 800))):
        mat.arena.place(robot, (x + random.uniform(-20, 20), y + random.uniform(-30, 30), random.uniform(-3.1, 3.1)))
    mat.arena.advance(0.5)
    mat.arena.camera.newest()


@pytest.mark.long
@pytest.mark.parametrize(
    ("ambient", "trial"), one_in(5, [(0.02, 0), (0.02, 1), (0.02, 2), (0.02, 3), (0.05, 0), (1.0, 0)])
)
def test_all_four_robots_are_found(arcade: Arcade, mat: EmulatedSession, ambient: float, trial: int) -> None:
    mat.arena.camera.painter.ambient = ambient
    scattered(mat, trial)
    page = gathering(arcade)
    play(arcade, 0.04, lit=True)
    if ambient < 1.0:  # otherwise they are seen at once
        assert arcade.screen.get_at((960, 540))[:3] == (LIGHT,) * 3
    for _ in range(60):
        if not page.missing:
            break
        play(arcade, 0.05, lit=True)
    assert page.missing == []
    play(arcade, FADE + 0.1, lit=True)
    assert arcade.screen.get_at((960, 540))[:3] == (0, 0, 0)
    assert page.missing == [], "the discs suffice from here on"


@pytest.mark.long
def test_the_light_comes_back_when_a_robot_disappears(arcade: Arcade, mat: EmulatedSession) -> None:
    mat.arena.camera.painter.ambient = 0.02
    scattered(mat, 1)
    page = gathering(arcade)
    play(arcade, 1.5, lit=True)
    assert page.missing == []
    mat.arena.faults.switch("marker_covered", True, 2)
    play(arcade, UNSEEN + FADE + 0.3, lit=True)
    assert page.missing == [2]
    assert arcade.screen.get_at((960, 540))[:3] == (LIGHT,) * 3
    mat.arena.faults.switch("marker_covered", False, 2)
    play(arcade, 1.2 + FADE, lit=True)
    assert page.missing == []
    assert arcade.screen.get_at((960, 540))[:3] == (0, 0, 0)


@pytest.mark.long
def test_a_robot_lost_in_a_match_is_found_again_in_the_dark(arcade: Arcade, mat: EmulatedSession) -> None:
    """Somebody covers its marker and puts it down elsewhere, where no disc lies."""
    match = begun(arcade)
    mat.arena.camera.painter.ambient = 0.02
    play(arcade, 0.6, lit=True)
    assert arcade.stack.top is match
    mat.arena.faults.switch("marker_covered", True, 1)
    play(arcade, 1.8, lit=True)
    arcade.shown(FaultPage)
    mat.arena.place(1, (800.0, 450.0, 1.0))
    mat.arena.faults.switch("marker_covered", False, 1)
    play(arcade, 1.0, lit=True)
    arcade.shown(FaultPage)
    assert arcade.screen.get_at((200, 900))[:3] != (LIGHT,) * 3, "the page can be read first"
    play(arcade, 3.5, lit=True)
    assert not match.robots.blocked
    assert arcade.stack.top is match
