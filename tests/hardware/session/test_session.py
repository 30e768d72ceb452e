"""Sessions: opening, closing, and the operator message for each missing part."""

import sys
from dataclasses import replace
from pathlib import Path

import pytest

from pigaming_app.hardware.calibration.quality import assessed
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.real import SizedCamera
from pigaming_app.hardware.session.robot_session import RobotsUnavailable, camera_warning
from pigaming_app.hardware.signals import ExposureKept, ExposureState
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import Settings, folders
from tests.hardware.sentences import sentence
from tests.hardware.session.opened import HERE, calibrate, real_mat, soon, threads

pytest.importorskip("cv2")


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


def test_without_a_calibration_there_are_no_real_robots(home: Path) -> None:
    with pytest.raises(RobotsUnavailable) as refused:
        real_mat().open()
    assert "Not calibrated yet" in sentence(refused.value)


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


def test_without_pyserial_or_camera_it_says_so_and_what_the_calibration_kept_is_set_and_warned_about(
    home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calibrate(HERE, replace(assessed(28.0, 2.4, ExposureState(0.0166, gain=120.0)), anyway=True))
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
