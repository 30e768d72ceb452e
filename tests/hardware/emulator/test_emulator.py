"""The emulated arena behaves like a real one, reproducibly."""

from math import cos, hypot, pi, sin
from random import Random

import cv2
import numpy as np
import pytest

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.camera import CameraTraits, FrameTiming
from pigaming_app.hardware.emulator.objects import SHEET
from pigaming_app.hardware.emulator.optics import Optics
from pigaming_app.hardware.emulator.robots import (
    FULL_SPEED,
    STEP,
    EmulatedRobot,
    RobotParameters,
    push_apart,
    random_parameters,
)

IDEAL = RobotParameters(left_gain=1, right_gain=1, deadband=0.05, lag=0.08, base=82, slip=0, battery=5.2, drain=0)


def driven(left, right, seconds, body=IDEAL):
    robot = EmulatedRobot(body, 0.0, 0.0, 0.0, Random(1))
    robot.left, robot.right = left, right
    for _ in range(round(seconds / STEP)):
        robot.roll()
    return robot


def found(image):
    """Markers by robot, (4, 2) px, by OpenCV's detector."""
    settings = cv2.aruco.DetectorParameters()
    settings.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    words = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    corners, numbers, _ = cv2.aruco.ArucoDetector(words, settings).detectMarkers(image)
    numbers = [] if numbers is None else np.asarray(numbers).reshape(-1)
    return [
        (SHEET.index(number), np.asarray(four).reshape(4, 2)) for number, four in zip(numbers, corners, strict=True)
    ]


def newest(arena, seconds=0.2):
    arena.advance(seconds)
    return arena.camera.newest()


def test_half_a_second_at_full_speed_is_half_a_metre_less_the_lag():
    assert driven(1.0, 1.0, 2.0).x == pytest.approx(FULL_SPEED * (2.0 - 0.08), rel=0.01)


def test_the_left_wheel_turns_it_clockwise_about_the_right_one():
    robot = driven(0.5, 0.0, 3.0)
    assert robot.heading > 2 * pi
    assert hypot(robot.x, robot.y - 41.0) == pytest.approx(41.0, abs=1.0)


def test_nothing_moves_within_the_deadband():
    assert driven(0.05, -0.05, 1.0).heading == 0.0


def test_no_two_robots_are_alike():
    random = Random(3)
    assert len({random_parameters(random).left_gain for _ in range(4)}) == 4


def test_robots_push_each_other_apart_unless_one_is_carried():
    one, other = EmulatedRobot(IDEAL, 0, 0, 0, Random(1)), EmulatedRobot(IDEAL, 60, 0, 0, Random(1))
    push_apart([one, other])
    assert other.x - one.x == pytest.approx(95.0)
    other.x, other.height = one.x, 100.0
    push_apart([one, other])
    assert other.x == one.x


def test_light_goes_the_same_way_back():
    optics = Optics()
    points = np.array([[0.0, 0.0], [1919.0, 0.0], [700.0, 900.0]])
    assert optics.canvas(optics.mat(points)) == pytest.approx(points)
    for height in (0.0, 70.0):
        pixels = np.array([[200, 150], [1700, 160], [960, 540], [331, 977]])
        x, y = optics.plane(height, slice(None), slice(None))
        seen = np.array([(x[v, u], y[v, u]) for u, v in pixels], dtype=float)
        assert optics.sensor(seen, height) == pytest.approx(pixels, abs=0.005)


def test_the_camera_shows_the_lids_where_they_are():
    arena = EmulatedArena(1)
    seen = dict(found(newest(arena).image))
    assert sorted(seen) == [0, 1, 2, 3]
    for number, corners in seen.items():
        robot = arena.robots[number]
        middle = arena.optics.sensor(np.array([(robot.x, robot.y)]), 70.0)[0]
        ahead = (robot.x + 20.0 * cos(robot.heading), robot.y + 20.0 * sin(robot.heading))
        forward = arena.optics.sensor(np.array([ahead]), 70.0)[0] - middle
        assert corners.mean(axis=0) == pytest.approx(middle, abs=0.4)
        up = (corners[0] + corners[1]) / 2 - middle
        assert up @ forward > 0.99 * hypot(*up) * hypot(*forward)


def test_the_camera_shows_what_is_projected_and_late():
    arena = EmulatedArena(1)
    image = np.zeros((1080, 1920), np.uint8)
    cv2.circle(image, (960, 590), 30, 255, -1)
    dark = newest(arena).image
    arena.project(image)
    lit = newest(arena).image.astype(int) - dark
    v, u = np.nonzero(lit > 60)
    expected = arena.optics.sensor(arena.optics.mat(np.array([[960.0, 590.0]])))[0]
    assert (u.mean(), v.mean()) == pytest.approx(expected, abs=0.5)


def test_frames_come_in_order_late_and_sometimes_never():
    arena = EmulatedArena(1, FrameTiming(fps=30, delay=0.06, drops=0.2), refresh=50)
    ages, numbers = [], []
    for _ in range(200):
        frame = newest(arena, 0.01)
        if frame:
            ages.append(arena.clock() - frame.captured)
            numbers.append(frame.number)
    assert numbers == sorted(set(numbers))
    assert 40 <= len(numbers) <= 55
    assert all(0.04 < age < 0.08 for age in ages)


def test_the_quick_picture_is_the_whole_one_around_the_robots():
    one, other = EmulatedArena(4, refresh=1), EmulatedArena(4, refresh=20)
    for arena in (one, other):
        newest(arena, 0.1)
    a, b = newest(one, 0.1).image.astype(int), newest(other, 0.1).image.astype(int)
    for robot in one.robots:
        u, v = one.optics.sensor(np.array([(robot.x, robot.y)]), 70.0)[0].astype(int)
        there = slice(v - 25, v + 25), slice(u - 25, u + 25)
        assert abs((a - b)[there]).mean() < 4.0
        assert abs((a - b)[there].mean()) < 0.5


def test_the_same_seed_is_the_same_run():
    def run(seed):
        arena = EmulatedArena(seed, FrameTiming(drops=0.1), refresh=10, exposure_jitter=0.2)
        for robot in arena.robots:
            robot.left, robot.right = 0.4, 0.3
        frames = [frame for frame in (newest(arena, 0.05) for _ in range(10)) if frame]
        return [frame.image.tobytes() for frame in frames], [frame.captured for frame in frames], arena.poses()

    assert (first := run(5)) == run(5)
    assert first != run(6)


def test_it_shares_no_code_with_what_it_proves():
    from tests.test_layers import PACKAGE, imported

    words = {"hardware.signals", "sim.plant"}
    site = {"hardware.calibration.site", *(f"hardware.vision.{name}" for name in ("discovery", "exposure", "markers"))}
    files = list((PACKAGE / "hardware" / "emulator").glob("*.py"))
    assert len(files) > 10
    for path in files:
        for module, _ in imported(path):
            room, _, name = module.partition(".")
            if room == "pigaming_app" and not name.startswith("hardware.emulator"):
                assert name in words | (site if path.stem == "site" else set()), f"{path.name}: {module}"


def kept_pictures(arena):
    """The number of distinct projected pictures that the arena holds."""
    queued = [image for _, image in arena._pending] + [exposure.scene.image for exposure in arena.camera._in_transit]
    return len({id(image) for image in queued})


def test_an_arena_that_nobody_looks_at_keeps_a_handful_of_pictures():
    arena = EmulatedArena(timing=FrameTiming(60.0, 0.06))
    for _ in range(600):  # 10 s at 60 pictures/s, the camera closed
        arena.project(np.zeros((1, 1), np.uint8))
        arena.advance(1 / 60)
    assert kept_pictures(arena) < 20
    for _ in range(600):  # and while its time stands still
        arena.project(np.zeros((1, 1), np.uint8))
    assert kept_pictures(arena) < 20


def test_what_robots_report_to_nobody_does_not_pile_up():
    arena = EmulatedArena(refresh=1000)
    arena.camera.close()
    arena.advance(30.0)
    assert arena.radio.in_waiting <= 4096


def test_however_fast_pictures_come_the_newest_is_shown():
    arena = EmulatedArena(refresh=1000)
    for shade in range(200):  # 1000 pictures/s
        arena.project(np.full((1080, 1920), shade, np.uint8))
        arena.advance(2 * STEP if shade % 4 == 3 else 0.0)
    arena.advance(0.05)
    assert arena._shown[0, 0] == 199


def test_after_a_long_time_closed_the_camera_gives_out_its_newest_picture():
    arena = EmulatedArena(timing=FrameTiming(30.0, 0.06), refresh=1000)
    arena.project(np.zeros((1080, 1920), np.uint8))
    arena.advance(5.0)
    frame = arena.camera.newest()
    assert frame is not None
    assert 0.05 < arena.clock() - frame.captured < 0.1 + 1 / 30


def test_a_rolling_shutter_exposes_lower_rows_later(monkeypatch):
    """Of two robots that drive right, the lower one has got farther by its way while the rows between are read."""
    gaps = []
    for readout in (0.0, 1 / 20):
        arena = EmulatedArena(1, FrameTiming(30.0, jitter=0.0), traits=CameraTraits(readout=readout))
        for robot, y in ((0, 150.0), (1, 750.0)):
            arena.place(robot, (300.0, y, 0.0))
            body = arena.robots[robot]
            monkeypatch.setattr(body, "roll", lambda body=body: setattr(body, "x", body.x + 0.5 * 1000.0 * 0.002))
        arena.project(np.full((1080, 1920), 150, np.uint8))
        seen = dict(found(newest(arena, 0.6).image))
        gaps.append(seen[1].mean(axis=0) - seen[0].mean(axis=0))
    px = arena.optics.sensor(np.array([(0.0, 0.0), (1.0, 0.0)]), 70.0)
    way = 500.0 * gaps[1][1] / 1080 / 20 * float(px[1, 0] - px[0, 0])
    assert gaps[1][0] - gaps[0][0] == pytest.approx(way, rel=0.15)
