"""The rig combines camera, tracker and link, and its threads end; kinematics: twist to wheel commands and back."""

import threading
import time
from unittest.mock import Mock

import numpy as np
import pytest

from pigaming_app.hardware.control.kinematics import IDEAL, LEVELS, Kinematics
from pigaming_app.hardware.control.rig import UNMEASURED
from pigaming_app.hardware.control.safety import STUCK
from pigaming_app.hardware.radio.packets import DEADMAN
from pigaming_app.hardware.signals import CameraFrame, WheelCommand
from pigaming_app.hardware.tracking.motion_model import WheelCorrection
from pigaming_app.sim.drivetrain import NOMINAL
from tests.hardware.mat import Mat, rig_of


class Eye:
    """A camera that returns the pictures of a list, one at a time."""

    def __init__(self, *pictures):
        self.pictures = list(pictures)

    def newest(self):
        return self.pictures.pop(0) if self.pictures else None

    def close(self):
        self.pictures.clear()


class Tracker(Mat):
    """A tracker that counts its pictures."""

    def __init__(self):
        super().__init__()
        self.shown = []
        self.twists = []

    def process(self, frame):
        self.shown.append(frame.number)
        return []

    def record_commands(self, time, twists):
        self.twists.append(twists)


def picture(number, shade):
    return CameraFrame(np.full((48, 64), shade, dtype=np.uint8), 0.01 * number, number)


def test_a_driver_that_repeats_a_picture_shows_nothing_new():
    tracker = Tracker()
    rig = rig_of(Eye(picture(1, 10), picture(2, 10), picture(3, 11)), tracker)
    for _ in range(5):
        rig.pump()
    assert tracker.shown == [1, 3]


def test_the_tracker_receives_nominal_twists_and_none_for_robots_that_are_off():
    tracker = Tracker()
    rig = rig_of(Eye(), tracker)
    wheels = rig.kinematics[0].wheels((200.0, 0.5))
    rig.send([wheels, WheelCommand(0.0, 0.0), None, None])
    (twists,) = tracker.twists
    assert twists[0] == pytest.approx(rig.kinematics[0].nominal_twist(wheels))
    assert twists[1:] == [(0.0, 0.0), None, None]


def test_what_the_tracker_learns_of_wheels_is_used_to_steer(monkeypatch):
    tracker = Tracker()
    rig = rig_of(Eye(picture(1, 10)), tracker)
    even = rig.kinematics[2].wheels((260.0, 0.0))
    monkeypatch.setattr(tracker, "wheel_correction", lambda robot: WheelCorrection(0.9, 1.1, 1.0, 0.0, 0.0))
    rig.pump()
    uneven = rig.kinematics[2].wheels((260.0, 0.0))
    assert even.left == even.right
    assert uneven.left > even.left > uneven.right


def test_a_robot_that_was_never_seen_is_unseen_and_one_that_is_just_late_is_not():
    mat = Mat()
    mat.pass_time(0.5)
    mat.robots[1].seen = -1e9
    health = mat.rig.health({0: 0.0, 1: 0.0}, mat.rig.snapshot())
    assert health[0].unseen == 0.0
    assert health[1].unseen > 1.0
    mat.blind = True
    mat.pass_time(0.1)
    assert mat.rig.health({0: 0.0}, mat.rig.snapshot())[0].unseen == 0.0  # no newer picture could have contained it
    assert mat.rig.health({0: 0.0}, mat.rig.snapshot())[0].picture_age == pytest.approx(0.12)


def test_threads_look_and_talk_and_end_when_it_is_closed():
    before = threading.active_count()
    tracker = Tracker()
    rig = rig_of(Eye(*[picture(i, i) for i in range(20)]), tracker, time.monotonic).start()
    deadline = time.monotonic() + 60.0
    while len(tracker.shown) < 20 and time.monotonic() < deadline:
        time.sleep(0.01)
    rig.pump()  # no effect while a thread runs
    rig.close()
    rig.close()
    assert tracker.shown == list(range(20))
    assert tracker.closed
    assert threading.active_count() == before


def test_a_tracker_that_breaks_once_is_logged_and_goes_on_with_the_next_picture(monkeypatch, caplog):
    monkeypatch.setattr("pigaming_app.hardware.control.rig.RETRY", 0.02)
    tracker = Tracker()
    process = tracker.process

    def broken(frame):
        if frame.number == 1:
            raise RuntimeError("broken")
        return process(frame)

    monkeypatch.setattr(tracker, "process", broken)
    rig = rig_of(Eye(picture(1, 1), picture(2, 2)), tracker, time.monotonic).start()
    deadline = time.monotonic() + 60.0
    while not tracker.shown and time.monotonic() < deadline:
        time.sleep(0.01)
    rig.close()
    assert tracker.shown == [2]
    assert "could not be used" in caplog.text


def test_time_that_passes_while_signs_are_read_makes_nobody_unseen():
    mat = Mat()
    mat.pass_time(0.5)

    def running():
        mat.now += 0.003
        return mat.now

    mat.rig.clock = running
    for robot in mat.robots:
        robot.seen = mat.last_captured = mat.now - 0.12
    for _ in range(20):
        assert [
            state.unseen for state in mat.rig.health(dict.fromkeys(range(4), 0.0), mat.rig.snapshot()).values()
        ] == [0.0] * 4


def test_limits_and_margin_follow_the_kind_of_robot():
    """On an arena of 1.32 mm/px a simulated robot has a radius of 47.5 mm. A micro:bit robot needs 4.5 V."""
    mat = Mat([(900.0, 450.0, 0.0)] * 4)
    mat.boards = {1: 1}
    rig = rig_of(mat, mat, mm=1.32, kinds=("", "", "microbit", "3pi"))
    rig.channels = (1, 2, 3, 0)
    assert [rig.kind(robot).key for robot in range(4)] == ["esp32", "microbit", "3pi", "3pi"]
    assert [round(rig.margin(robot, 36.0), 2) for robot in range(4)] == [8.45, 8.45, 0.0, 0.0]
    assert rig_of(mat, mat, mm=0.66).margin(0, 36.0) == pytest.approx(47.5 / 0.66 - 37.0)
    health = rig.health(dict.fromkeys(range(4), 0.0), rig.snapshot())
    assert [(one.battery_low, one.battery_empty) for one in health.values()] == [(4.4, 4.0), (4.6, 4.4)] + [
        (4.4, 4.0)
    ] * 2


def test_a_battery_that_is_not_measured_is_no_empty_one():
    mat = Mat()
    mat.robots[0].battery = 0.0
    assert mat.rig.health({0: 0.0}, mat.rig.snapshot())[0].battery > 5.0


def test_commands_that_are_lost_on_the_air_explain_a_robot_that_stands(monkeypatch):
    """A robot that is held is stuck; one whose reports cease, or tell of its deadman, is not, and is judged anew."""
    mat = Mat()
    held, free = mat.robots[:2]
    monkeypatch.setattr(held, "roll", lambda: None)
    ahead = WheelCommand(0.4, 0.4)

    def stuck(seconds):
        """Verdict on the held robot after so many seconds of commands; the greatest one on the way."""
        found = []
        for _ in range(round(seconds / 0.02)):
            mat.rig.send([ahead, ahead, None, None])
            mat.pass_time(0.02)
            health = mat.rig.health({0: 0.0, 1: 0.0}, mat.rig.snapshot())
            assert health[1].stuck == 0.0
            found.append(health[0].stuck)
        return found[-1], max(found)

    assert stuck(1.2)[0] > STUCK
    held.silent = True
    assert stuck(1.0)[0] == 0.0
    held.silent = False
    assert stuck(0.3) == (0.0, 0.0), "what was lost explains nothing, but is no evidence either"
    assert stuck(0.9)[0] > STUCK, "commands reach it again, and it still stands"
    held.flags = DEADMAN
    assert stuck(0.1)[0] == 0.0
    held.flags = 0
    assert stuck(0.3) == (0.0, 0.0)
    assert free.x > 200.0


def test_predictions_reach_as_far_ahead_as_commands_are_measured_to_take(monkeypatch):
    mat, predict = Mat(), Mock(return_value=([], []))
    late = [0.0, 0.05, 0.1, -0.01]
    monkeypatch.setattr(
        mat, "wheel_correction", lambda robot: WheelCorrection(1.0, 1.0, 1.0, late[robot], 0.0), raising=False
    )
    monkeypatch.setattr(mat, "predict", predict)
    mat.pass_time(0.1)
    mat.rig.pump()
    mat.rig.snapshot()
    assert predict.call_args.args[1] == pytest.approx([UNMEASURED.dead_time + more for more in (0.0, 0.05, 0.1, 0.0)])


WORN = WheelCorrection(0.93, 1.05, 1.02, 0.01, 8.0)
DESIRED = [(260.0, 0.0), (-150.0, 1.0), (0.0, 2.5), (200.0, -1.5)]


@pytest.mark.parametrize("desired", DESIRED)
@pytest.mark.parametrize(
    ("drivetrain", "correction"), [(NOMINAL, IDEAL), (UNMEASURED, IDEAL), (UNMEASURED, WORN)], ids=["", "new", "worn"]
)
def test_on_average_the_wheels_run_as_asked_though_the_radio_knows_63_levels(desired, drivetrain, correction):
    """What is learnt of the wheels is made up for."""
    kinematics = Kinematics(drivetrain)
    kinematics.correction = correction
    commands = [kinematics.wheels(desired) for _ in range(200)]
    ran = [kinematics.expected_twist(wheels) for wheels in commands]
    assert sum(linear for linear, _ in ran) / 200 == pytest.approx(desired[0], abs=1.0)
    assert sum(angular for _, angular in ran) / 200 == pytest.approx(desired[1], abs=0.02)
    if desired == (260.0, 0.0) and correction is WORN:
        assert sum(wheels.left for wheels in commands) > sum(wheels.right for wheels in commands)


def test_every_share_is_on_a_level_and_rest_is_rest():
    kinematics = Kinematics(UNMEASURED)
    for desired in DESIRED:
        for share in kinematics.wheels(desired):
            assert share * LEVELS == pytest.approx(round(share * LEVELS))
    assert kinematics.wheels((0.0, 0.0)) == (0.0, 0.0)
    assert kinematics.stand() == (0.0, 0.0)


def test_an_absurd_gain_is_not_believed():
    kinematics = Kinematics(NOMINAL)
    kinematics.correction = WheelCorrection(0.01, 0.01, 1.0, 0.0, 0.0)
    assert kinematics.expected_twist(kinematics.wheels((100.0, 0.0)))[0] == pytest.approx(100.0, rel=0.1)
