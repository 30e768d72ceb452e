"""What real robots need: opened, closed, and one sentence for whatever is missing."""

import sys
from pathlib import Path

import pytest

from pigaming_app.hardware.session.emulated import EmulatedMat
from pigaming_app.hardware.session.real import NoMat
from pigaming_app.storage.settings import Settings, folders
from tests.hardware.session.opened import HERE, calibrate, real_mat, soon, threads

pytest.importorskip("cv2")


def test_the_emulated_arena_lives_in_real_time_and_ends_its_threads() -> None:
    mat = EmulatedMat()
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
    with pytest.raises(NoMat) as refused:
        real_mat().open()
    assert "no calibration" in str(refused.value)


def test_a_calibration_of_another_display_is_refused(home: Path) -> None:
    calibrate("2: 1280 × 720")
    with pytest.raises(NoMat) as refused:
        real_mat().open()
    assert "2: 1280 × 720" in str(refused.value)
    assert HERE in str(refused.value)


def test_a_broken_calibration_is_refused_in_one_line(home: Path) -> None:
    calibrate(HERE)
    file = folders().config / "calibration.toml"
    file.write_text(file.read_text(encoding="utf-8").replace("width_mm = 2", "width_mm = 3"), encoding="utf-8")
    with pytest.raises(NoMat) as refused:
        real_mat().open()
    assert "\n" not in str(refused.value)


def test_a_computer_without_opencv_says_so(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calibrate(HERE)
    monkeypatch.setitem(sys.modules, "cv2", None)
    for mat in (real_mat(), EmulatedMat(live=False)):
        with pytest.raises(NoMat) as refused:
            mat.open()
        assert "opencv" in str(refused.value).lower()


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
        assert str(mat.trouble) == "The package pyserial is missing, so no radio can be used."
        mat.close()
        mat.open()
        assert soon(lambda: "camera 63" in str(mat.trouble))
    finally:
        mat.end()
    assert soon(lambda: not threads(), 3.0)
