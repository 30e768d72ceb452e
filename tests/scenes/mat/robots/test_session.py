"""Matches with real robots open their devices, release them at the end, and cope with missing ones."""

from functools import partial
from pathlib import Path
from typing import cast

import pytest

from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.mat.mat import SessionMat
from pigaming_app.scenes.mat.robots.match_scene import RealMatch
from pigaming_app.scenes.mat.session import session_of
from pigaming_app.scenes.play.scene import match_of
from pigaming_app.scenes.start import run
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, InputEvent
from tests.cases import one_in
from tests.hardware.session.opened import HERE, calibrate, real_mat, soon, threads
from tests.scenes.arcade import Arcade, setup

pytest.importorskip("cv2")


def test_without_camera_and_radio_the_match_says_so_and_goes_on_with_simulated_robots(
    home: Path, controls: Controls, caplog: pytest.LogCaptureFixture
) -> None:
    calibrate(HERE)
    before = threads()
    arcade = Arcade(controls, "pt")
    mat = real_mat(Settings(camera=63, port="/dev/nowhere"))
    arcade.context.mat = SessionMat(arcade.context, mat)
    match = match_of(arcade.context, setup("level1 level1 off off", 1.0), [], (0, 1))
    assert isinstance(match, RealMatch)
    arcade.open(match)

    def told() -> bool:
        arcade.frame(0.05, draw=True)
        return "/dev/nowhere" in caplog.text and "camera 63" in caplog.text

    try:
        assert soon(told)
        assert {fault.name for fault in match.plant.faults} >= {"radio", "camera"}
        arcade.press(Button.X)
        arcade.wait(6.0)
        assert match.match.seconds > 1.0
    finally:
        mat.end()
    assert soon(lambda: threads() <= before, 3.0), threads()


class Failing(RealMatch):
    """A match that raises as soon as its robots drive."""

    def update(self, seconds: float) -> StackOperation:
        turn = super().update(seconds)
        if any(robot.left or robot.right for robot in cast(EmulatedSession, self.session).arena.robots):
            raise RuntimeError("on purpose")
        return turn

    def handle(self, event: InputEvent) -> StackOperation:
        return None


@pytest.mark.long
@pytest.mark.parametrize("alone", one_in(2, [True, False]))
def test_robots_stand_when_a_scene_fails_and_when_the_arcade_ends(home: Path, alone: bool) -> None:
    contexts: list[Context] = []

    def first(context: Context) -> RealMatch:
        contexts.append(context)
        assert isinstance(session_of(context), EmulatedSession)
        again = partial(match_of, context)
        return Failing(context, setup("level1 level1 off off"), [], (0, 1), session_of(context), again)

    code = run(Options(first_scene=first, without_title=alone, headless=True, step=0.02, frames=400, emulator_seed=2))
    assert code == int(alone)
    mat = session_of(contexts[0])
    assert isinstance(mat, EmulatedSession)
    mat.arena.advance(0.1)
    assert not any(robot.left or robot.right for robot in mat.arena.robots)
    assert not threads()
