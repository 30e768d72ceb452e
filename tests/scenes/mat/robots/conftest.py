"""Fixtures: real robots on the emulated arena in simulated time, one arena per test process."""

from collections.abc import Iterator

import numpy as np
import pytest

from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.scenes.mat.mat import SessionMat
from tests.scenes.arcade import Arcade


@pytest.fixture(scope="session")
def emulated() -> Iterator[EmulatedSession]:
    """The arena, created and calibrated once."""
    pytest.importorskip("cv2")
    mat = EmulatedSession(live=False)
    yield mat
    mat.end()


@pytest.fixture
def mat(emulated: EmulatedSession) -> Iterator[EmulatedSession]:
    """The arena in its initial state: dark, four robots, no fault."""
    arena = emulated.arena
    arena.project(np.zeros((1080, 1920), np.uint8))
    for robot, pose in enumerate(((180, 260, 0.4), (1300, 700, 2.9), (1300, 200, 3.9), (300, 700, 5.5))):
        arena.place(robot, pose)
    yield emulated
    for name, robot in arena.faults.on():
        arena.faults.switch(name, False, robot)
    emulated.close()


@pytest.fixture
def arcade(arcade: Arcade, mat: EmulatedSession) -> Arcade:
    """An arcade connected to the arena."""
    arcade.context.mat = SessionMat(arcade.context, mat)
    return arcade
