"""A printed floor, rendered by PDFium and photographed by the emulated camera, which share no code with the page:
calibration by its markers.
"""

import numpy as np
import pytest

pytest.importorskip("cv2")
pytest.importorskip("pypdfium2")

from pigaming_app.hardware.calibration.drift import DriftMonitor
from pigaming_app.hardware.calibration.ground_plane import read, to_toml
from pigaming_app.hardware.emulator.arena import ARENA_AT
from pigaming_app.hardware.emulator.camera import TRAITS
from pigaming_app.hardware.proof.showings import print_calibration
from pigaming_app.hardware.signals import CameraFrame
from tests.hardware.paper import MM, floor_picture, printed_arena
from tests.hardware.sentences import sentence

GRID = np.array([(x, y) for x in range(0, 1601, 200) for y in range(0, 901, 150)], dtype=np.float64)


def covered(*places):
    """The floor with white paper, 130 mm wide, over these canvas px."""
    picture = floor_picture().copy()
    for x, y in places:
        left, top = round((x + 0.5) * MM) - 65, round((y + 0.5) * MM) - 65
        picture[max(0, top) : top + 130, max(0, left) : left + 130] = 255
    return picture


def errors(arena, ground, height):
    """Errors all over the arena for points at a height, mm."""
    share = ground.lens.size[0] / 1920.0
    seen = (arena.optics.sensor(arena.optics.mat(GRID + ARENA_AT), height) + 0.5) * share - 0.5
    return np.hypot(*(ground.at_height(seen, height) - GRID).T) * ground.mm


@pytest.fixture(scope="module")
def made():
    """An arena with a printed floor, and its calibration."""
    arena = printed_arena(2)
    return arena, print_calibration(arena)


def test_a_calibration_by_printed_markers_is_true_all_over_the_arena(made):
    assert_true(*made)


@pytest.mark.long
@pytest.mark.parametrize(
    ("view", "hidden"),
    [pytest.param("tilted", (), marks=pytest.mark.again), ("good", ((80, 540), (960, 70), (1840, 540)))],
    ids=["oblique", "only the corners"],
)
def test_so_is_one_from_the_side_or_by_the_corners_alone(view, hidden):
    arena = printed_arena(2, TRAITS[view], covered(*hidden))
    assert_true(arena, print_calibration(arena))


def assert_true(arena, work):
    assert work.fault is None
    assert work.residuals.accepted
    for height in (0.0, work.ground.lid):
        assert errors(arena, work.ground, height).max() < 2.0


def test_a_floor_that_was_moved_drifts(made):
    _, work = made
    moved = printed_arena(2, floor=np.roll(floor_picture(), 12, axis=1))
    assert drift_mm(moved, work.ground) == pytest.approx(12.0, abs=0.5)


def drift_mm(arena, ground):
    monitor, seen = DriftMonitor(ground), 0
    while seen < 12:
        arena.advance(0.1)
        if frame := arena.camera.newest():
            monitor.process(CameraFrame(frame.image, frame.captured, frame.number))
            seen += 1
    return monitor.mm


def test_without_a_corner_there_is_none_and_the_sentence_says_why():
    work = print_calibration(printed_arena(2, floor=covered((1840, 996))))
    assert work.ground is None
    assert sentence(work.fault).startswith("The camera sees 3 of the 4 printed corner markers")


def test_it_holds_with_every_screen(made):
    ground = made[1].ground
    assert read(to_toml(ground), display="HDMI-1") == ground
    assert ground.printed
