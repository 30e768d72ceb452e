"""The ground plane maps between camera and arena, and refuses invalid calibrations."""

import shutil
from dataclasses import replace
from math import hypot, pi
from pathlib import Path

import numpy as np
import pytest

from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane, Lens, read, to_toml
from pigaming_app.hardware.session import store
from pigaming_app.hardware.signals import DetectedMarker, Fix
from pigaming_app.hardware.vision.markers import ROBOT_IDS
from tests.hardware.mat import nominal
from tests.hardware.sentences import refused, sentence
from tests.tags import FOLDER

SIZE = (1920, 1080)
BENT = Lens(SIZE, -0.45, 0.2, (970.0, 530.0))


def edge_on(ground, robot, x, y, height, edge=50.0):
    """The detection of an upright marker, `edge` mm wide, `height` mm above a place."""
    half = 0.5 * edge / ground.mm
    corners = np.array([(x + half, y - half), (x + half, y + half), (x - half, y + half), (x - half, y - half)])
    return DetectedMarker(ROBOT_IDS[robot], ground.to_camera(corners, height))


def fix_of(ground, mark, captured=0.0):
    """The fix that a marker must have."""
    (fix,) = ground.fixes([mark], captured)
    assert isinstance(fix, Fix)
    return fix


def test_straightening_undoes_bending_all_over_the_picture():
    x, y = np.meshgrid(np.linspace(0, 1919, 9), np.linspace(0, 1079, 7))
    points = np.column_stack([x.ravel(), y.ravel()])
    assert np.abs(BENT.distort(BENT.undistort(points)) - points).max() < 1e-3


def test_a_lens_that_bends_inwards_shows_straight_points_nearer_to_its_centre():
    seen = BENT.distort(np.array([[1700.0, 900.0]]))[0]
    assert hypot(*(seen - BENT.centre)) < hypot(1700.0 - 970.0, 900.0 - 530.0)


def test_a_lid_is_seen_beside_its_place_by_the_height_rule():
    """Similar triangles: 70 mm up under a camera at 2500 mm, 1000 px away, appears 1000 * 70 / 2430 px further out."""
    ground = replace(nominal(), foot=(0.0, 0.0), height=2500.0)
    apparent = ground.on_mat(ground.to_camera(np.array([[1000.0, 0.0]]), 70.0))[0]
    assert apparent == pytest.approx([1000.0 + 1000.0 * 70.0 / 2430.0, 0.0])


def test_a_marker_on_a_lid_is_a_robot_and_its_top_is_ahead():
    ground = nominal()
    fix = fix_of(ground, edge_on(ground, 2, 300.0, 700.0, 70.0), 5.0)
    assert fix.robot == 2
    assert fix.captured == 5.0
    assert (fix.x, fix.y) == pytest.approx((300.0, 700.0))
    assert fix.heading == pytest.approx(0.0)


def test_a_marker_in_a_hand_is_no_robot():
    """Half a metre above the mat it looks a quarter larger."""
    ground = nominal()
    assert ground.fixes([edge_on(ground, 0, 500.0, 500.0, 570.0)], 0.0) == ["size"]


def test_a_marker_of_another_size_is_no_robot():
    ground = nominal()
    assert ground.fixes([edge_on(ground, 0, 500.0, 500.0, 70.0, edge=40.0)], 0.0) == ["size"]


def test_a_tilted_marker_is_no_robot():
    ground = nominal()
    mark = edge_on(ground, 0, 500.0, 500.0, 70.0)
    squeezed = mark.corners.mean(axis=0) + (mark.corners - mark.corners.mean(axis=0)) * (1.0, 0.75)
    assert ground.fixes([DetectedMarker(ROBOT_IDS[0], squeezed)], 0.0) == ["tilted"]


def test_a_mat_that_was_measured_wrongly_shows_in_the_size_of_a_marker():
    right, wrong = nominal(width_mm=2112.0), nominal(width_mm=1900.0)
    mark = edge_on(right, 0, 800.0, 400.0, 70.0)
    assert right.edge_mm(mark) == pytest.approx(50.0)
    assert wrong.edge_mm(mark) == pytest.approx(50.0 * 1900.0 / 2112.0)


def calibrated() -> GroundPlane:
    return replace(nominal(), display="2: 1920 × 1080", lens=BENT, mean_mm=0.31, max_mm=0.62)


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("version = 1", "version = 7", "version 7"),
        ("height = 2500.0", "height = 2400.0", "edited or damaged"),
        ("k1 = -0.45", "k1 = -0.4", "edited or damaged"),
        ("[lens]", "[lens", "cannot be used"),
        ("check =", "cheque =", "edited or damaged"),
        ("version = 1\n", "", "version None"),
    ],
)
def test_a_file_that_is_not_as_it_was_written_is_refused_in_one_sentence(old, new, reason):
    text = to_toml(calibrated())
    assert old in text
    with refused(CalibrationError, reason) as caught:
        read(text.replace(old, new), "2: 1920 × 1080", SIZE)
    assert "\n" not in sentence(caught.value)
    assert sentence(caught.value).endswith("calibrate again.")


@pytest.mark.parametrize(
    "wrong",
    [
        replace(calibrated(), height=10.0),
        replace(calibrated(), width_mm=1.0),
        replace(calibrated(), lens=Lens((4, 4))),
    ],
)
def test_numbers_that_cannot_be_are_refused_even_if_the_check_fits(wrong):
    with refused(CalibrationError, "cannot be used"):
        read(to_toml(wrong), "2: 1920 × 1080", SIZE)


def test_a_plane_that_maps_everything_to_a_line_is_refused():
    text = to_toml(calibrated())
    flat = replace(calibrated(), foot=(1.0, 2.0))
    object.__setattr__(flat, "plane", (1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0))
    assert to_toml(flat) != text
    with refused(CalibrationError, "cannot be used"):
        read(to_toml(flat), "2: 1920 × 1080", SIZE)


def test_a_heading_is_where_the_top_of_the_marker_points():
    ground = nominal()
    mark = edge_on(ground, 1, 800.0, 400.0, 70.0)
    turned = DetectedMarker(ROBOT_IDS[1], np.roll(mark.corners, -1, axis=0))
    assert abs(fix_of(ground, turned).heading) == pytest.approx(pi / 2.0)


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
