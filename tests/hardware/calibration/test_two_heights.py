"""Wrong rulers: a width 5 % off shows in the markers of driving robots, a height 25 % off in a lid laid on the mat."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from pigaming_app.hardware.calibration.camera_position import TwoHeights
from pigaming_app.hardware.calibration.camera_task import SPOT
from pigaming_app.hardware.calibration.ground_plane import MARKER
from pigaming_app.hardware.emulator.arena import ARENA_AT, EmulatedArena
from pigaming_app.hardware.emulator.objects import LID_HEIGHT, FlatObject, lid
from pigaming_app.hardware.emulator.renderer import ExposureSetup
from pigaming_app.hardware.session.emulated import calibrated
from pigaming_app.hardware.signals import DetectedMarker
from pigaming_app.hardware.vision.markers import WEARERS, MarkerDetector
from tests.hardware.tracking.blind_bed import TRUTH, BlindBed


@pytest.fixture(scope="module")
def arena():
    return EmulatedArena(2)


@pytest.fixture(scope="module")
def made(arena):
    """The calibration of the arena."""
    return calibrated(arena)


@pytest.fixture(scope="module")
def sights(arena):
    """Markers in pictures of lids on a robot and flat on the mat, at hand-laid places, by trial."""
    detector, page = MarkerDetector(WEARERS), np.zeros((1080, 1920), np.uint8)
    cv2.circle(page, (round(SPOT[0] + ARENA_AT[0]), round(SPOT[1] + ARENA_AT[1])), 90, 128, -1)
    random = np.random.default_rng(1)
    trials: list[list[DetectedMarker | None]] = []
    for number in (16, 45):
        trials.append([])
        for height in (LID_HEIGHT, 0.0):
            ((x, y),) = arena.optics.mat(np.array([SPOT]) + ARENA_AT + random.uniform(-15.0, 15.0, 2)).tolist()
            thing = FlatObject(lid(number), height, ((x, y, random.uniform(0.0, 6.0)),))
            for _ in range(7):
                picture = arena.camera.painter.paint(
                    ExposureSetup(page, (thing,), 0.1, 1.0, 100 + int(random.integers(1000)))
                )
                trials[-1] += detector.refine(picture, detector.detect(picture))
            trials[-1].append(None)
    return trials


@pytest.mark.parametrize(("height", "wrong"), [(1.0, False), (0.75, True), (1.25, True), (1.05, False), (0.95, False)])
@pytest.mark.parametrize("width", [1.0, 1.05])
def test_a_lid_on_a_robot_and_on_the_mat_tells_the_height_however_wide_the_arena(
    arena, made, sights, height, wrong, width
):
    true = arena.optics.lens.eye[2]
    ground = replace(made, height=true * height, width_mm=made.width_mm * width)
    for trial in sights:
        heights = TwoHeights(ground)
        for mark in trial:
            heights.add(mark)
        assert heights.height == pytest.approx(true, rel=0.08)
        assert heights.wrong == wrong


def test_one_height_alone_tells_nothing(made, sights):
    heights = TwoHeights(made)
    assert not heights.seen
    for mark in sights[0][:7]:
        heights.add(mark)
    assert heights.seen
    assert heights.height is None
    assert not heights.wrong


@pytest.mark.parametrize(("width", "wrong"), [(0.98, False), (1.05, True), (0.95, True)])
def test_driving_robots_show_a_wrong_width(width, wrong):
    bed = BlindBed(seed=4, ground=replace(TRUTH, width_mm=TRUTH.width_mm * width))
    assert bed.rig.tracker.wrong_size is None
    bed.drive(4.5)
    size = bed.rig.tracker.wrong_size
    assert size == (pytest.approx(MARKER * width, abs=0.4) if wrong else None)
