"""Sessions: opening, closing, and the operator message for each missing part."""

import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pigaming_app.hardware.calibration.drift import PAUSE, WARN
from pigaming_app.hardware.calibration.quality import CameraQuality
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.drivers.ours import OURS
from pigaming_app.hardware.session import real
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.lighting import Lighting
from pigaming_app.hardware.session.real import SizedCamera
from pigaming_app.hardware.session.robot_session import RobotsUnavailable, camera_warning
from pigaming_app.hardware.signals import CameraFrame, ExposureKept, ExposureState
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.sim.world import DT, HZ, ROBOTS, World
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import Settings, folders
from tests.hardware.mat import nominal
from tests.hardware.sentences import refused, sentence
from tests.hardware.session.opened import HERE, calibrate, real_mat, soon, threads


def test_the_emulated_arena_lives_in_real_time_and_ends_its_threads() -> None:
    mat = EmulatedSession()
    try:
        rig = mat.open()

        def known() -> bool:
            mat.advance(0.02)
            return all(seen.age < 0.5 for seen in rig.sense()) and len(rig.link.telemetry) == 4

        assert soon(known)
        assert mat.fault is None
        assert mat.newest is not None
        assert mat.open() is rig
    finally:
        mat.end()
    assert soon(lambda: not threads())


def test_robots_that_were_not_identified_are_as_fast_as_their_driver_declares(home: Path) -> None:
    calibrate(HERE)
    settings = Settings()
    settings.radio, settings.radios, settings.kinds = "thymio", [2, 1, 3, 4], ["3pi", "", "", ""]
    mat = real_mat(settings)
    try:
        trains = [kinematics.drivetrain for kinematics in mat.open().kinematics]
    finally:
        mat.end()
    assert [train.left.speed * 1.32 for train in trains] == pytest.approx([166.0, 1000.0, 166.0, 166.0])
    assert [train.base * 1.32 for train in trains] == pytest.approx([94.0, 82.0, 94.0, 94.0])
    assert {train.dead_time for train in trains} == {0.1}


def test_rate_and_marker_are_those_that_the_driver_declares(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """At 10 commands a second one waits 50 ms on the average; at 50 it is 10 ms, part of the dead time."""
    calibrate(HERE)
    driver = replace(OURS["api2"], rate=10.0, marker_mm=13.2)
    monkeypatch.setattr(real, "driver_of", lambda settings: driver)
    mat = real_mat()
    try:
        rig = mat.open()
        assert isinstance(rig.tracker, Tracker)
        assert rig.tracker.ahead == pytest.approx(10.0)  # px of 1.32 mm
        assert rig.link.beat == pytest.approx(0.1)
        assert rig.kinematics[0].drivetrain.dead_time == pytest.approx(0.03 + 0.04)
    finally:
        mat.end()


@pytest.mark.parametrize(
    ("projection", "width", "reason"),
    [
        ("", "", "Not calibrated yet"),
        ("2: 1280 × 720", "width_mm = 2", f"2: 1280 × 720, not {HERE}"),
        (HERE, "width_mm = 3", "edited or damaged"),
    ],
)
def test_without_a_calibration_made_here_there_are_no_real_robots(
    home: Path, projection: str, width: str, reason: str
) -> None:
    if projection:
        calibrate(projection)
        file = folders().config / "calibration.toml"
        file.write_text(file.read_text(encoding="utf-8").replace("width_mm = 2", width), encoding="utf-8")
    with refused(RobotsUnavailable, reason) as caught:
        real_mat().open()
    assert "\n" not in sentence(caught.value)


def test_a_computer_without_opencv_says_so(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calibrate(HERE)
    monkeypatch.setitem(sys.modules, "cv2", None)
    for mat in (real_mat(), EmulatedSession(live=False)):
        with refused(RobotsUnavailable, "(?i)opencv"):
            mat.open()


def test_without_pyserial_or_camera_it_says_so_and_what_the_calibration_kept_is_set_and_warned_about(
    home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calibrate(HERE, CameraQuality(0.0166, 120.0, marker_px=28.0, detection=0.5, anyway=True))
    monkeypatch.setitem(sys.modules, "serial", None)
    mat = real_mat(Settings(camera=63, port="/dev/nowhere"))
    try:
        link = mat.open_link()
        assert link is not None
        assert soon(lambda: link.fault is not None)
        assert sentence(mat.fault) == "The Python package pyserial is missing: install it to use a radio."
        mat.close()
        rig = mat.open()
        assert isinstance(rig.camera, SizedCamera)
        assert rig.camera.camera.kept == ExposureKept(0.0166, 120.0)  # type: ignore[attr-defined]
        assert mat.quality is not None
        assert camera_warning(mat, rig) == OperatorMessage("used_anyway", share=round(100 * mat.quality.detection))
        assert soon(lambda: mat.fault is not None and "camera 63" in sentence(mat.fault))
    finally:
        mat.end()
    assert soon(lambda: not threads())


@pytest.fixture(scope="module")
def session() -> Iterator[EmulatedSession]:
    session = EmulatedSession(1, live=False, lighting=Lighting(1))
    session.find()
    yield session
    session.end()


@pytest.mark.long
def test_who_drives_and_does_nothing_about_drift_is_stopped_when_the_camera_has_moved(session: EmulatedSession) -> None:
    world: Any = World()
    for robot in world.robots:
        robot.present = 1
    rig = session.open()
    plant = RealPlant(world, rig)

    def drive(seconds: float) -> None:
        for _ in range(round(seconds * HZ)):
            plant.sense()
            plant.drive([(0.0, 0.5)] * ROBOTS, DT)
            session.tick()

    session.arena.camera.painter.refresh = 1  # the margins too, in every picture
    drive(1.5)
    assert 0.0 < rig.drift() < WARN
    assert "drift" not in {fault.name for fault in plant.faults}
    session.arena.faults.switch("camera_bumped", True)
    drive(2.5)
    assert rig.drift() > PAUSE
    assert "drift" in {fault.name for fault in plant.faults if fault.pauses}
    session.arena.advance(0.3)
    assert not any(robot.left or robot.right for robot in session.arena.robots)
    session.arena.faults.switch("camera_bumped", False)
    drive(2.5)
    assert rig.drift() < WARN


def test_camera_and_radio_are_closed_once_and_opened_anew(
    session: EmulatedSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    rig = session.open()
    assert session.open() is rig
    closed: list[str] = []
    monkeypatch.setattr(rig.link, "close", lambda: closed.append("link"))
    monkeypatch.setattr(rig.camera, "close", lambda: closed.append("camera"))
    session.close()
    session.close()
    assert closed == ["link", "camera"]
    assert session.fault is None
    assert session.open() is not rig


def test_the_window_s_picture_is_asked_for_only_when_the_projector_is_due(session: EmulatedSession) -> None:
    import numpy as np

    asked: list[float] = []

    def pixels() -> Any:
        asked.append(session.arena.clock())
        return np.zeros((1080, 1920, 4), np.uint8)

    for _ in range(10):
        session.show(pixels)
        session.arena.advance(0.01)
    assert 4 <= len(asked) <= 6


class Eye:
    """A fake camera with one frame of each of these sizes."""

    fault: OperatorMessage | None = None
    exposure = ExposureState()

    def __init__(self, *sizes: tuple[int, int]) -> None:
        self.frames = [CameraFrame(np.zeros((h, w), np.uint8), 0.1 * i, i) for i, (w, h) in enumerate(sizes)]

    def newest(self) -> CameraFrame | None:
        return self.frames.pop(0) if self.frames else None

    def close(self) -> None:
        self.frames.clear()


def test_pictures_of_another_size_are_withheld_with_a_sentence_until_the_right_ones_come():
    eye = SizedCamera(Eye((640, 480), (1280, 720), (640, 480)), nominal((1280, 720)))
    assert eye.newest() is None
    assert sentence(eye.fault) == (
        "The calibration is for camera images of 1280 x 720 px, not 640 x 480: calibrate again."
    )
    frame = eye.newest()
    assert frame is not None
    assert frame.number == 1
    assert eye.fault is None
    eye.newest()
    assert "640 x 480" in sentence(eye.fault)


def test_what_the_camera_itself_says_comes_first():
    camera = Eye((640, 480))
    eye = SizedCamera(camera, nominal((1280, 720)))
    eye.newest()
    camera.fault = OperatorMessage("stopped", number=0)
    assert eye.fault == camera.fault
    eye.close()
    assert not camera.frames
