"""Robot files: every fault is an operator message."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from pigaming_app.hardware.calibration.ground_plane import CalibrationError
from pigaming_app.hardware.session import store
from tests.hardware.sentences import refused
from tests.tags import FOLDER

HERE = "1: 1024 × 768"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    shutil.copy(FOLDER / "2.0.0" / "calibration.toml", tmp_path)
    return tmp_path / "calibration.toml"


def test_a_point_on_the_mat_is_where_the_file_has_it(file: Path) -> None:
    """By hand: the homography of the file at the centre of the lens, which it leaves where it is."""
    ground = store.load(file, HERE, (1920, 1080))
    x, y = 959.5, 539.5
    scale = 2.5e-05 * x + 6.05e-05 * y + 1.0
    place = (1.135 * x + 0.0236 * y - 254.8) / scale, (0.0377 * x + 1.1457 * y - 207.6) / scale
    assert ground.on_mat(np.array([[x, y]]))[0] == pytest.approx(place)
    assert ground.mm == 2126 / 1600


def test_without_a_display_and_a_camera_any_is_taken(file: Path) -> None:
    assert store.load(file) == store.load(file, HERE, (1920, 1080))


def test_what_is_kept_is_read_again_and_the_one_before_stays(file: Path) -> None:
    ground = store.load(file)
    store.save(ground, file)
    assert store.load(file) == ground
    assert (file.parent / "calibration.toml.bak").read_bytes() == (FOLDER / "2.0.0" / file.name).read_bytes()


def test_another_display_another_camera_and_none_are_refused(file: Path) -> None:
    with refused(CalibrationError, "for display 1: 1024 × 768, not 2: 640 × 480"):
        store.load(file, "2: 640 × 480")
    with refused(CalibrationError, "1920 x 1080 px, not 1280 x 720"):
        store.load(file, HERE, (1280, 720))
    with refused(CalibrationError, "Not calibrated yet"):
        store.load(file.parent / "calibration-emulated.toml")


def test_each_site_has_a_file_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    assert store.calibration_file("real").name == "calibration.toml"
    assert store.calibration_file("emulated").name == "calibration-emulated.toml"
    assert store.robots_file(emulated=False).name == "robots.toml"
    assert store.robots_file(emulated=True).name == "robots-emulated.toml"
