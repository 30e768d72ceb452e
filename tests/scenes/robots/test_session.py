"""What real robots need: opened for a match, closed after it, and one sentence for whatever is missing."""

import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import cast

import pytest

from pigaming_app.games.game import Seat, Setup
from pigaming_app.hardware.calibration.ground_plane import written
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.real import RealSession
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.scenes.app import Options, run
from pigaming_app.scenes.flow.context import House
from pigaming_app.scenes.flow.stack import Turn
from pigaming_app.scenes.robots.match_scene import RealMatch
from pigaming_app.scenes.robots.start_match import match_of
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Act, Press
from tests.hardware.grounds import nominal
from tests.hardware.sentences import sentence
from tests.scenes.arcade import Arcade

pytest.importorskip("cv2")
HERE = "1: 1920 × 1080"


def real_mat(settings: Settings | None = None) -> RealSession:
    return RealSession(settings or Settings(), lambda: HERE)


def calibrate(projection: str) -> None:
    """Keep a calibration made on this projection."""
    from dataclasses import replace

    folder = folders().config
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "calibration.toml").write_text(written(replace(nominal(), display=projection)), encoding="utf-8")


def soon(true: Callable[[], bool], most: float = 30.0) -> bool:
    """Whether it is so before long."""
    end = time.monotonic() + most
    while time.monotonic() < end:
        if true():
            return True
        time.sleep(0.02)
    return False


def threads() -> set[str]:
    mine = ("rig", "link", "emulated arena", "camera")
    return {thread.name for thread in threading.enumerate() if thread.name.startswith(mine)}


def test_the_emulated_arena_lives_in_real_time_and_ends_its_threads() -> None:
    mat = EmulatedSession()
    try:
        rig = mat.open()

        def known() -> bool:
            mat.advance(0.02)
            return all(seen.age < 0.5 for seen in rig.sense()) and len(rig.link.telemetry) == 4

        assert soon(known)
        assert mat.trouble is None
        assert mat.newest is not None
        assert mat.open() is rig
    finally:
        mat.end()
    assert soon(lambda: not threads(), 2.0)


def test_without_a_calibration_there_are_no_real_robots(home: Path) -> None:
    with pytest.raises(RobotsUnavailable) as refused:
        real_mat().open()
    assert "no calibration" in sentence(refused.value)


def test_a_calibration_of_another_display_is_refused(home: Path) -> None:
    calibrate("2: 1280 × 720")
    with pytest.raises(RobotsUnavailable) as refused:
        real_mat().open()
    assert "2: 1280 × 720" in sentence(refused.value)
    assert HERE in sentence(refused.value)


def test_a_broken_calibration_is_refused_in_one_line(home: Path) -> None:
    calibrate(HERE)
    file = folders().config / "calibration.toml"
    file.write_text(file.read_text(encoding="utf-8").replace("width_mm = 2", "width_mm = 3"), encoding="utf-8")
    with pytest.raises(RobotsUnavailable) as refused:
        real_mat().open()
    assert "\n" not in sentence(refused.value)


def test_a_computer_without_opencv_says_so(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calibrate(HERE)
    monkeypatch.setitem(sys.modules, "cv2", None)
    for mat in (real_mat(), EmulatedSession(live=False)):
        with pytest.raises(RobotsUnavailable) as refused:
            mat.open()
        assert "opencv" in sentence(refused.value).lower()


def test_a_computer_without_pyserial_says_so_and_without_a_camera_too(
    home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calibrate(HERE)
    monkeypatch.setitem(sys.modules, "serial", None)
    mat = real_mat(Settings(camera=63, port="/dev/nowhere"))
    try:
        link = mat.listen()
        assert link is not None
        assert soon(lambda: link.trouble is not None)
        assert sentence(mat.trouble) == "The package pyserial is missing, so no radio can be used."
        mat.close()
        mat.open()
        assert soon(lambda: mat.trouble is not None and "camera 63" in sentence(mat.trouble))
    finally:
        mat.end()
    assert soon(lambda: not threads(), 3.0)


def test_without_camera_and_radio_the_match_says_so_and_goes_on_with_simulated_robots(
    home: Path, controls: Controls, caplog: pytest.LogCaptureFixture
) -> None:
    calibrate(HERE)
    arcade = Arcade(controls, "pt")
    arcade.house.session = mat = real_mat(Settings(camera=63, port="/dev/nowhere"))
    seats = (Seat("easy", 0), Seat("easy", 1), Seat("off", 2), Seat("off", 3))
    match = match_of(arcade.house, Setup("pitanks", "classic", seats, 1.0, 3, "plain"), [], (0, 1))
    assert isinstance(match, RealMatch)
    arcade.open(match)

    def told() -> bool:
        arcade.frame(0.05, draw=True)
        return "/dev/nowhere" in caplog.text and "camera 63" in caplog.text

    try:
        assert soon(told)
        assert {fault.name for fault in match.plant.faults} >= {"radio", "camera"}
        arcade.press(Act.EXTRA)
        arcade.wait(6.0)
        assert match.match.seconds > 1.0
    finally:
        mat.end()
    assert soon(lambda: not threads(), 3.0)


class Failing(RealMatch):
    """A match that breaks as soon as its robots drive."""

    def update(self, seconds: float) -> Turn:
        turn = super().update(seconds)
        if any(robot.left or robot.right for robot in cast(EmulatedSession, self.session).arena.robots):
            raise RuntimeError("on purpose")
        return turn

    def on(self, press: Press) -> Turn:
        return None


@pytest.mark.parametrize("alone", [True, False])
def test_robots_stand_when_a_scene_fails_and_when_the_arcade_ends(home: Path, alone: bool) -> None:
    houses: list[House] = []

    def first(house: House) -> RealMatch:
        houses.append(house)
        assert isinstance(house.session, EmulatedSession)
        seats = (Seat("easy", 0), Seat("easy", 1), Seat("off", 2), Seat("off", 3))
        return Failing(house, Setup("pitanks", "classic", seats, 0.1, 3, "plain"), [], (0, 1), house.session)

    code = run(Options(first=first, alone=alone, headless=True, step=0.02, frames=400, emulate=2))
    assert code == int(alone)
    mat = houses[0].session
    assert isinstance(mat, EmulatedSession)
    mat.arena.advance(0.1)
    assert not any(robot.left or robot.right for robot in mat.arena.robots)
    assert not threads()
