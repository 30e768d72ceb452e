"""The tracker from images to poses: driving, occlusion and recovery, hands, and duplicate markers."""

from math import hypot, pi, tau
from unittest.mock import Mock

import numpy as np
import pytest

from pigaming_app.hardware.signals import CameraFrame, DetectedMarker
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.hardware.vision.markers import ROBOT_IDS
from tests.hardware.mat import nominal
from tests.hardware.pictures import SIZE, lids, speckled, square

GROUND = nominal(SIZE)
EDGE = 50.0 / GROUND.mm
POSES = ((300.0, 200.0, 0.4), (1300.0, 250.0, 2.5), (1200.0, 700.0, 4.0), (250.0, 650.0, 5.6))


def marks(poses, height=70.0):
    """Markers as seen by a perfect camera; `poses`: {robot: pose}, or pairs."""
    pairs = poses.items() if isinstance(poses, dict) else poses
    return [DetectedMarker(ROBOT_IDS[robot], GROUND.to_camera(square(pose, EDGE), height)) for robot, pose in pairs]


def photo(poses, seed=1, height=70.0, noise=2.0):
    return speckled(lids([(mark.number, mark.corners) for mark in marks(poses, height)], SIZE), noise, seed)


class Clock:
    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


class Mat:
    """A tracker above a mat; `show` feeds it frames of the robots at 30 Hz."""

    def __init__(self, robots=range(4)):
        self.clock = Clock()
        self.tracker = Tracker(GROUND, self.clock)
        self.tracker.expected = set(robots)
        self.frames = 0

    def show(self, poses, times=1, **how):
        for _ in range(times):
            self.frames += 1
            self.clock.now = self.frames / 30.0
            picture = photo(poses, seed=self.frames % 3, **how)
            fixes = self.tracker.process(CameraFrame(picture, self.clock.now, self.frames))
        return {fix.robot for fix in fixes}

    def away(self, robot, pose):
        """Errors of the tracker (px, rad)."""
        sight = self.tracker.sense(self.clock.now)[robot]
        return hypot(sight.x - pose[0], sight.y - pose[1]), abs((sight.heading - pose[2] + pi) % tau - pi)


def test_four_robots_are_found_at_once_and_to_a_pixel():
    mat = Mat()
    assert mat.show(dict(enumerate(POSES))) == {0, 1, 2, 3}
    for robot, pose in enumerate(POSES):
        away, turned = mat.away(robot, pose)
        assert away < 1.0
        assert turned < 0.03


def test_they_are_found_again_picture_after_picture_near_where_they_were(monkeypatch):
    mat = Mat()
    mat.show(dict(enumerate(POSES)))
    quick = Mock(wraps=mat.tracker._markers.detect_quickly)
    monkeypatch.setattr(mat.tracker._markers, "detect_quickly", quick)
    for step in range(12):
        driving = (300.0 + 8.0 * step, 200.0, 0.4)
        assert mat.show({0: driving, **dict(enumerate(POSES[1:], 1))}) == {0, 1, 2, 3}
    assert mat.tracker.duplicates() == set()
    assert quick.call_count <= 4  # 0.4 s, with one search of the whole image every 0.1 s


def test_a_robot_that_comes_onto_the_mat_is_found_within_a_tenth_of_a_second():
    mat = Mat()
    mat.show({0: POSES[0]}, times=6)
    assert any(1 in mat.show({0: POSES[0], 1: POSES[1]}) for _ in range(3))


def test_a_covered_marker_makes_its_robot_older_and_lost():
    mat = Mat()
    mat.show(dict(enumerate(POSES)), times=3)
    mat.show({1: POSES[1], 2: POSES[2], 3: POSES[3]}, times=6)
    assert mat.tracker.sense(mat.clock.now)[0].age == pytest.approx(0.2)
    assert mat.tracker.sense(mat.clock.now)[1].age == pytest.approx(0.0)
    assert mat.tracker.sense(mat.clock.now)[0].age == pytest.approx(0.2)
    assert mat.show(dict(enumerate(POSES))) == {0, 1, 2, 3}


def test_a_marker_that_comes_twice_is_a_fault_within_a_fifth_of_a_second():
    mat = Mat()
    mat.show({0: POSES[0]}, times=5)
    begun = mat.clock.now
    while not mat.tracker.duplicates():
        mat.show([(0, POSES[0]), (0, POSES[2])])
        assert mat.clock.now - begun < 0.2
    assert mat.tracker.duplicates() == {0}
    assert mat.tracker.rejections[0] == "duplicate"
    mat.show({0: POSES[0]}, times=20)
    assert mat.tracker.duplicates() == set()


def test_a_marker_in_a_hand_does_not_take_the_robot_along():
    mat = Mat()
    mat.show({0: POSES[0]}, times=3)
    for _ in range(8):
        mat.frames += 1
        mat.clock.now = mat.frames / 30.0
        both = marks({0: POSES[0]}) + marks({0: (700.0, 500.0, 0.0)}, height=600.0)
        picture = speckled(lids([(mark.number, mark.corners) for mark in both], SIZE))
        mat.tracker.process(CameraFrame(picture, mat.clock.now, mat.frames))
    assert mat.tracker.rejections == {0: "size"}
    assert mat.tracker.duplicates() == set()
    assert mat.away(0, POSES[0])[0] < 1.0


def test_a_marker_beside_the_mat_is_refused():
    mat = Mat()
    mat.tracker.correct(marks({2: (1800.0, 400.0, 0.0)}), 0.0)
    assert mat.tracker.rejections == {2: "outside"}


def test_a_robot_just_outside_of_the_arena_is_still_followed():
    mat = Mat()
    mat.tracker.correct(marks({2: (1650.0, 400.0, 0.0)}), 0.0)
    assert mat.tracker.sense(mat.clock.now)[2].age == 0.0


def test_the_mirror_image_of_a_marker_is_nobody():
    mat = Mat()
    picture = np.ascontiguousarray(photo({0: POSES[0]})[:, ::-1])
    mat.tracker.process(CameraFrame(picture, 0.0, 1))
    assert mat.tracker.sense(mat.clock.now)[0].age == 1e9


def test_an_old_picture_is_not_looked_at_twice():
    mat = Mat()
    assert mat.tracker.correct(marks({0: POSES[0]}), 1.0)
    assert mat.tracker.last_captured == 1.0
    assert not mat.tracker.correct(marks({0: POSES[0]}), 1.0)


def test_a_robot_that_drives_into_another_is_not_predicted_to_be_inside_of_it():
    """Rim to rim, and one drives on: half of the overlap is taken from it and half given to the other."""
    mat = Mat()
    mat.tracker.correct(marks({0: (500.0, 400.0, 0.0), 1: (572.0, 400.0, 0.0)}), 0.0)
    for tick in range(6):
        mat.tracker.record_commands(tick * 0.02, [(260.0, 0.0), None, None, None])
    alone = mat.tracker.filters[0].at(0.1)
    one, other = mat.tracker.sense(0.1)[:2]
    assert alone.x > 505.0
    assert other.x - one.x == pytest.approx(72.0)
    assert other.x - 572.0 == pytest.approx(alone.x - one.x, abs=0.01)


@pytest.mark.parametrize("wide", [1280, 1920])
def test_a_picture_without_robots_costs_nothing_but_time(wide):
    tracker = Tracker(nominal((wide, wide * 9 // 16)), lambda: 0.0)
    noise = np.random.default_rng(1).integers(0, 255, (wide * 9 // 16, wide), dtype=np.uint8)
    for frame in range(3):
        assert tracker.process(CameraFrame(noise, frame * 0.1, frame)) == []
    assert tracker.process(CameraFrame(np.zeros((8, 8), np.uint8), 1.0, 9)) == []


@pytest.mark.parametrize("mm", [20.0, -35.0])
def test_a_pose_is_between_the_wheels_wherever_the_marker_is(mm):
    mat, ahead = Mat(), mm / GROUND.mm
    mat.tracker.ahead = ahead
    seen = {i: (x + ahead * np.cos(turn), y + ahead * np.sin(turn), turn) for i, (x, y, turn) in enumerate(POSES)}
    assert mat.show(seen, times=4) == {0, 1, 2, 3}
    assert max(mat.away(robot, pose)[0] for robot, pose in enumerate(POSES)) < 1.0
    mat.tracker._searched = mat.tracker._glanced = mat.clock.now + 1.0  # near the predictions alone
    assert mat.show(seen, times=4) == {0, 1, 2, 3}
