"""Robot files: a calibration of version 1.3.0 is still read, and every fault is an operator message."""

from pathlib import Path

import numpy as np
import pytest

from pigaming_app.hardware.calibration.ground_plane import CalibrationError
from pigaming_app.hardware.session import store
from tests.hardware.sentences import refused

OF_1_3_0 = """\
version = 1
display = "1: 1024 × 768"
plane = [
    1.1352161572892823,
    0.023624488624793494,
    -254.80971231511145,
    0.037740415807624675,
    1.1456575178401445,
    -207.62433345573055,
    2.5035739149556886e-05,
    6.0559526052343546e-05,
    1.0,
]
width_mm = 2126
foot = [
    877.4841399361102,
    615.5140472859588,
]
height = 2488
lid = 70.0
marker = 50.0
mean_mm = 0.06758337030585447
max_mm = 0.2965698058190472
check = 3154094289

[lens]
size = [
    1920,
    1080,
]
k1 = -0.3246384193140469
k2 = 0.11385470926055521
centre = [
    961.1624038583905,
    539.6358446853045,
]
"""
HERE = "1: 1024 × 768"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "calibration.toml"
    path.write_text(OF_1_3_0, encoding="utf-8")
    return path


def test_a_calibration_of_version_1_3_0_is_read(file: Path) -> None:
    ground = store.load(file, HERE, (1920, 1080))
    assert ground.height == 2488.0
    assert ground.foot == pytest.approx((877.4841399361102, 615.5140472859588))
    assert ground.lens.k1 == -0.3246384193140469
    assert ground.mm == 2126 / 1600
    middle = ground.on_mat(np.array([[960.0, 540.0]]))[0]
    assert middle == pytest.approx((802.2388358419694, 423.2479383642016)), "as version 1.3.0 has it"


def test_without_a_display_and_a_camera_any_is_taken(file: Path) -> None:
    assert store.load(file) == store.load(file, HERE, (1920, 1080))


def test_what_is_kept_is_read_again_and_the_one_before_stays(file: Path) -> None:
    ground = store.load(file)
    store.save(ground, file)
    assert store.load(file) == ground
    assert (file.parent / "calibration.toml.bak").read_text(encoding="utf-8") == OF_1_3_0


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
