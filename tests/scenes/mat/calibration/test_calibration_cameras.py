"""The calibration wizard with real cameras, or none: failures are one sentence, and no thread survives."""

import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.calibration import camera_task as looking
from pigaming_app.hardware.calibration import procedure as calibrating
from pigaming_app.hardware.calibration.site import Measurements, RealCalibrationSite
from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.hardware.session import store
from pigaming_app.hardware.vision import camera
from pigaming_app.hardware.vision import discovery as cameras
from pigaming_app.hardware.vision.discovery import CameraInfo
from pigaming_app.hardware.vision.markers import OpenCVMissing
from pigaming_app.scenes.mat.calibration import boards_page as boards
from pigaming_app.scenes.mat.calibration.result_page import ResultPage
from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw.pixels import pixels_of
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent
from tests.cases import one_in
from tests.scenes.operated import Operated

LONG = 120.0  # s, timeout of a test: the machine may be busy


class Driver:
    """A fake `cv2.VideoCapture` that opens or fails, and returns grey images."""

    def __init__(self, opens: bool = True) -> None:
        self.opens, self.sends = opens, True

    def __call__(self, number: int) -> "Driver":
        return self

    def isOpened(self) -> bool:  # noqa: N802
        return self.opens

    def release(self) -> None:
        pass

    def get(self, what: int) -> float:
        return 0.0

    def set(self, what: int, value: float) -> bool:
        return True

    def read(self) -> tuple[bool, Any]:
        time.sleep(0.01)
        return self.sends, np.full((480, 640), 90, np.uint8) if self.sends else None


def real(controls: Controls, driver: Driver) -> Operated:
    site = RealCalibrationSite(driver)
    arcade = Operated(controls, site)
    arcade.open(CalibrationPage(arcade.context, site))
    return arcade


def until(arcade: Operated, true: Any) -> None:
    end = time.monotonic() + LONG
    while not true():
        arcade.picture()
        time.sleep(0.005)  # like the arcade between two pictures; else the camera's thread may starve
        assert time.monotonic() < end, "it did not happen"


@pytest.fixture
def _one_camera(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("pigaming_app.hardware.calibration.site.cameras", lambda: [CameraInfo(3, "Bright Eye")])
    monkeypatch.setattr(camera, "STALE", 0.1)
    monkeypatch.setattr(camera, "RETRY", 0.02)
    monkeypatch.setattr(cameras, "NODES", tmp_path)
    (tmp_path / "video3").touch()


@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
def test_a_missing_camera_is_replaced_by_a_connected_one(controls: Controls) -> None:
    arcade = real(controls, Driver())
    first = arcade.shown(CalibrationPage)
    assert first.number == 3
    assert first.preview is not None
    until(arcade, lambda: first.preview.small is not None and first.preview.fault is None)
    assert first.preview.size == (640, 480)
    arcade.press(Button.BACK)


@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
@pytest.mark.parametrize("language", one_in(2, ["en", "pt"]))
def test_a_camera_that_fails_to_open_is_reported_and_retried(
    controls: Controls, language: str, caplog: pytest.LogCaptureFixture
) -> None:
    driver = Driver(opens=False)
    arcade = real(controls, driver)
    arcade.context.words.switch(language)
    first = arcade.shown(CalibrationPage)
    assert first.preview is not None
    until(arcade, lambda: first.preview.fault is not None and first.preview.fault.key != "yet")
    assert first.preview.fault is not None
    assert "3" in arcade.context.words.long_sentence(first.preview.fault)
    (line,) = [record.getMessage() for record in caplog.records if "camera 3" in record.getMessage()]
    assert str(first.preview.fault) in line, "the log has it too, once"
    driver.opens = True
    until(arcade, lambda: first.preview.fault is None and first.preview.small is not None)
    driver.sends = False
    until(arcade, lambda: first.preview.fault is not None)
    arcade.press(Button.BACK)


@pytest.mark.long
@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
def test_a_camera_without_a_board_and_a_stalled_one_are_reported(
    controls: Controls, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(RealCalibrationSite, "settle", 0.05)
    monkeypatch.setattr(calibrating, "LIT", 0.05)
    driver = Driver()
    arcade = real(controls, driver)
    arcade.begin()
    until(arcade, lambda: isinstance(arcade.stack.top, ResultPage))
    assert arcade.shown(ResultPage).finding.trouble.key == "few"  # type: ignore[union-attr]
    driver.sends = False
    monkeypatch.setattr(calibrating.Calibration, "patience", 0.3)
    arcade.press(Button.FIRE)
    until(arcade, lambda: isinstance(arcade.stack.top, ResultPage))
    assert isinstance(arcade.shown(ResultPage).finding.trouble, OperatorMessage)
    arcade.press(Button.BACK, Button.BACK)


@pytest.mark.usefixtures("_home", "_no_threads_stay")
def test_without_opencv_the_page_says_so_and_the_arcade_goes_on(
    controls: Controls, monkeypatch: pytest.MonkeyPatch
) -> None:
    missing = OpenCVMissing(OperatorMessage("no_opencv"))

    def none(*_: object, **__: object) -> object:
        raise missing

    monkeypatch.setattr(RealCalibrationSite, "open", none)
    monkeypatch.setattr(boards, "picture", none)
    arcade = real(controls, Driver())
    first = arcade.shown(CalibrationPage)
    until(arcade, lambda: first.preview is not None and first.preview.fault is not None)
    arcade.begin()
    until(arcade, lambda: isinstance(arcade.stack.top, ResultPage))
    assert arcade.shown(ResultPage).finding.trouble == missing.message
    arcade.press(Button.BACK, Button.BACK)


@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
def test_an_exception_in_the_thread_is_reported(controls: Controls, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(image: object) -> object:
        raise RuntimeError("nobody thought of this")

    monkeypatch.setattr(looking, "scaled_preview", broken)
    arcade = real(controls, Driver())
    first = arcade.shown(CalibrationPage)
    until(arcade, lambda: first.preview is not None and first.preview.fault == looking.BROKEN)
    arcade.press(Button.BACK)


@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
def test_lengths_change_faster_while_held_and_are_saved(controls: Controls, tmp_path: Path) -> None:
    arcade = real(controls, Driver())
    first = arcade.go("width")
    before = first.measures.width
    arcade.press(Button.RIGHT, device=Device("pad", 0))
    assert first.measures.width == before + 1
    for _ in range(60):
        arcade.stack.top.handle(InputEvent(Button.RIGHT, Device("pad", 0), repeat=True))
    assert first.measures.width > before + 1000
    arcade.go("lid")
    arcade.press(*[Button.LEFT] * 3)
    assert first.measures.lid == 67
    arcade.press(Button.BACK)
    settings, wrong = Settings.load(tmp_path / "config")
    assert not wrong
    assert (settings.arena_mm, settings.lid_mm, settings.camera) == (first.measures.width, 67.0, 3)
    again = CalibrationPage(arcade.context, arcade.site)
    assert again.measures == Measurements(first.measures.width, 2500.0, 67.0)


class Overhead(Driver):
    """A fake camera above an emulated mat, with colour images."""

    def __init__(self, site: EmulatedCalibrationSite) -> None:
        super().__init__()
        self.site = site

    def read(self) -> tuple[bool, Any]:
        self.site.arena.advance(1 / 30)
        frame = self.site.arena.camera.newest()
        return frame is not None, None if frame is None else np.repeat(frame.image[:, :, None], 3, axis=2)


@pytest.mark.long
@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
def test_a_real_camera_over_the_mat_is_calibrated_and_the_file_is_the_real_one(
    controls: Controls, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(RealCalibrationSite, "settle", 0.3)
    mat = EmulatedCalibrationSite(4)
    mat.clear(True)
    arcade = real(controls, Overhead(mat))
    arcade.context.canvas.watchers.append(lambda window: mat.project(pixels_of(window)))
    first = arcade.shown(CalibrationPage)
    first.measures = mat.measures
    arcade.begin()
    until(arcade, lambda: isinstance(arcade.stack.top, ResultPage))
    result = arcade.shown(ResultPage)
    assert result.finding.good, result.finding.trouble
    arcade.press(Button.FIRE)
    ground = store.load(store.calibration_file(arcade.site.name), arcade.context.canvas.projection, (1920, 1080))
    assert (tmp_path / "config" / "calibration.toml").exists()
    assert ground.max_mm < 3.0
    arcade.press(Button.BACK)
