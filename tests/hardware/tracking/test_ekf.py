"""The pose filter against simulated robots whose parameters it does not know."""

from dataclasses import replace
from math import cos, degrees, hypot, pi, sin, sqrt, tau

import numpy as np
import pytest

from pigaming_app.hardware.signals import Fix
from pigaming_app.hardware.tracking.ekf import NEVER, PoseFilter
from pigaming_app.hardware.tracking.motion_model import MotionState, WheelCorrection
from pigaming_app.sim.drivetrain import NOMINAL

MM = 1.32
FRESH = WheelCorrection(1.0, 1.0, 1.0, 0.0, 0.0)
PROMPT = replace(NOMINAL, dead_time=0.0)


def fix(x, y, heading=0.0, captured=0.0):
    return Fix(0, x, y, heading, captured)


def follower(x=500.0, y=400.0, heading=0.0, train=PROMPT):
    """A filter with a first fix at time 0."""
    robot = PoseFilter(train, MM)
    assert robot.correct(fix(x, y, heading))
    return robot


def drive(robot, twist, begin, end):
    """Record a command 50 times a second."""
    for tick in range(round(begin * 50), round(end * 50)):
        robot.record_command(tick / 50, twist)


def test_the_motors_follow_exactly_whatever_the_steps():
    one, many = MotionState(0.0, 0.0, 0.0), MotionState(0.0, 0.0, 0.0)
    one.roll(200.0, 200.0, FRESH, 62.0, 0.08, 0.1)
    for _ in range(50):
        many.roll(200.0, 200.0, FRESH, 62.0, 0.08, 0.002)
    assert (one.x, one.left) == pytest.approx((many.x, many.left))
    assert one.x == pytest.approx(200.0 * (0.1 - 0.08 * (1.0 - np.exp(-0.1 / 0.08))))


def test_a_robot_on_one_wheel_turns_round_the_other():
    """Left wheel 62 px from the right, which stands: a full circle about it after pi * 62 * 2 px of the left wheel."""
    robot = MotionState(0.0, 0.0, 0.0)
    robot.left = 124.0
    for _ in range(1000):
        robot.roll(124.0, 0.0, FRESH, 62.0, 0.08, pi / 1000.0)
    assert robot.heading == pytest.approx(tau)
    assert (robot.x, robot.y) == pytest.approx((0.0, 0.0), abs=0.1)


def test_a_wheel_told_less_than_its_stiction_stands():
    robot = MotionState(0.0, 0.0, 0.0)
    robot.roll(20.0, -20.0, FRESH._replace(stiction=25.0), 62.0, 0.08, 1.0)
    assert (robot.x, robot.heading) == (0.0, 0.0)


def test_one_prediction_of_two_times_is_that_of_each():
    robot = follower()
    drive(robot, (200.0, 1.5), 0.0, 0.3)
    assert robot.along((0.1, 0.2, 0.31)) == [pytest.approx(robot.at(time), abs=0.01) for time in (0.1, 0.2, 0.31)]
    assert robot.along((0.2, 0.2))[1] == robot.at(0.2)


def test_a_robot_that_was_never_seen_is_nowhere():
    assert PoseFilter(NOMINAL, MM).at(5.0).age == NEVER


def test_a_robot_at_rest_stays_where_it_was_seen():
    sight = follower(heading=1.0).at(0.3)
    assert sight == pytest.approx((500.0, 400.0, 1.0, 0.3))


def test_commands_since_the_picture_are_replayed():
    """200 px/s for 0.3 s with a lag of 0.08 s: 200 (0.3 - 0.08 (1 - e^-3.75)) px."""
    robot = follower()
    drive(robot, (200.0, 0.0), 0.0, 0.3)
    assert robot.at(0.3).x == pytest.approx(500.0 + 200.0 * (0.3 - 0.08 * (1.0 - np.exp(-3.75))))


def test_a_command_acts_only_after_the_dead_time():
    robot = follower(train=replace(NOMINAL, dead_time=0.06))
    drive(robot, (200.0, 0.0), 0.0, 0.3)
    assert robot.at(0.059).x == 500.0
    assert robot.at(0.1).x > 501.0


def test_a_jump_is_not_believed_before_the_third_time_and_then_the_robot_stands_there():
    robot = follower()
    drive(robot, (200.0, 0.0), 0.0, 0.2)
    believed = [robot.correct(fix(900.0, 700.0, 2.0, (i + 1) / 30.0)) for i in range(3)]
    assert believed == [False, False, True]
    assert robot.at(0.1)[:3] == pytest.approx((900.0, 700.0, 2.0))
    assert robot._motion.left == 0.0


def test_jumps_here_and_there_are_never_believed():
    robot = follower()
    for i in range(12):
        assert not robot.correct(fix(900.0 + 400.0 * (i % 2), 700.0, 0.0, (i + 1) / 60.0))


def test_one_wrong_sight_leaves_no_trace():
    robot = follower()
    robot.correct(fix(900.0, 700.0, 0.0, 0.033))
    assert robot.correct(fix(500.2, 400.0, 0.0, 0.067))
    assert hypot(robot.at(0.067).x - 500.0, robot.at(0.067).y - 400.0) < 0.5


def test_the_gate_opens_with_time():
    """1 m/s and 30 mm: 42 px after 26 ms, 98 px after 100 ms."""
    assert not follower().correct(fix(560.0, 400.0, 0.0, 0.026))
    assert follower().correct(fix(560.0, 400.0, 0.0, 0.1))


def test_a_robot_that_is_pushed_is_followed_at_once():
    """A hand takes it along at 300 mm/s while its wheels stand."""
    robot = follower()
    for frame in range(1, 30):
        robot.correct(fix(500.0 + 7.6 * frame, 400.0, 0.0, frame / 30.0))
    assert robot.at(29 / 30).x == pytest.approx(500.0 + 7.6 * 29, abs=3.0)
    assert robot.correction == pytest.approx(FRESH, abs=1e-3)


def test_a_robot_that_was_gone_for_long_must_be_seen_three_times():
    robot = follower()
    assert [robot.correct(fix(800.0, 300.0, 0.0, 60.0 + i / 30.0)) for i in range(3)] == [False, False, True]
    assert robot.unseen(60.1) < 0.1


def test_a_robot_that_is_not_seen_is_predicted_for_a_second_at_most():
    robot = follower()
    drive(robot, (100.0, 0.0), 0.0, 1.2)
    assert robot.at(1.2)[:3] == robot.at(900.0)[:3]


def test_a_picture_older_than_the_last_is_not_used():
    robot = follower()
    robot.correct(fix(501.0, 400.0, 0.0, 0.1))
    assert not robot.correct(fix(499.0, 400.0, 0.0, 0.05))


def test_headings_go_round():
    robot = follower(heading=tau - 0.02)
    robot.correct(fix(500.0, 400.0, 0.02 - tau, 0.033))
    assert min(robot.at(0.033).heading, tau - robot.at(0.033).heading) < 0.03


class Stranger:
    """A robot with gains, base, lag, deadband and dead time unknown to the filter; steps of 2 ms."""

    def __init__(self, left=0.94, right=1.04, base=65.0, lag=0.09, stuck=25.0, dead=0.03):
        self.gains, self.base, self.lag, self.stuck, self.dead = (left, right), base, lag, stuck, dead
        self.pose, self.speeds = [800.0, 400.0, 0.0], [0.0, 0.0]

    def step(self, twist):
        half = 0.5 * NOMINAL.base * twist[1]
        for i, told in enumerate((twist[0] + half, twist[0] - half)):
            beyond = max(abs(told) - self.stuck, 0.0) * (1.0 if told > 0.0 else -1.0)
            self.speeds[i] += (self.gains[i] * beyond - self.speeds[i]) * 0.002 / self.lag
        left, right = self.speeds
        self.pose[2] += (left - right) / self.base * 0.002
        self.pose[0] += 0.001 * (left + right) * cos(self.pose[2])
        self.pose[1] += 0.001 * (left + right) * sin(self.pose[2])


def errors(stranger, seconds, seed=1, noise=(0.7, 0.012), fps=30, late=0.06):
    """Drive with a random stick; errors of `at` at every tick (s, mm, degrees)."""
    random = np.random.default_rng(seed)
    robot, twist, told, frames, found = PoseFilter(NOMINAL, MM), (0.0, 0.0), [], [], []
    for step in range(round(seconds * 500)):
        now = step * 0.002
        if step % 10 == 0:
            if random.random() < 0.04:
                twist = (260.0 * random.integers(-1, 2), 3.0 * random.integers(-1, 2))
            told.append((now, twist))
            robot.record_command(now, twist)
        acting = [one for sent, one in told[-10:] if sent + stranger.dead <= now]
        stranger.step(acting[-1] if acting else (0.0, 0.0))
        x, y, heading = stranger.pose
        if step % round(500 / fps) == 0:
            at = random.normal((x, y, heading), (noise[0], noise[0], noise[1]))
            frames.append((now + late, Fix._make((0, *at.tolist(), now))))
        while frames and frames[0][0] <= now:
            robot.correct(frames.pop(0)[1])
        if step % 10 == 0 and now > 0.2:
            sight = robot.at(now)
            turned = (sight.heading - heading + pi) % tau - pi
            found.append((now, hypot(sight.x - x, sight.y - y) * MM, degrees(turned)))
    return np.array(found), robot


def rms(values):
    return sqrt(float((values**2).mean()))


@pytest.mark.parametrize("fps", [30, 60])
def test_poses_are_right_to_3_mm_and_a_degree_and_a_half_at_a_third_of_a_metre_per_second(fps):
    found, _ = errors(Stranger(), 20.0, fps=fps)
    assert rms(found[:, 1]) < 3.0
    assert rms(found[:, 2]) < 1.5


def test_what_the_wheels_do_is_learnt_on_the_way():
    found, robot = errors(Stranger(), 30.0)
    assert robot.correction.left / robot.correction.right == pytest.approx(0.94 / 1.04, abs=0.01)
    assert robot.correction.stiction == pytest.approx(25.0, abs=5.0)
    assert robot.correction.turning * robot.correction.left == pytest.approx(0.94 * NOMINAL.base / 65.0, abs=0.03)
    assert rms(found[found[:, 0] > 10.0, 2]) < 0.8


def test_a_robot_that_stands_still_teaches_nothing():
    robot = PoseFilter(NOMINAL, MM)
    random = np.random.default_rng(4)
    for frame in range(3000):
        x, y, heading = random.normal((500.0, 400.0, 1.0), (0.7, 0.7, 0.012)).tolist()
        robot.correct(fix(x, y, heading, frame / 30.0))
        robot.record_command(frame / 30.0, (0.0, 0.0))
    assert robot.correction == pytest.approx(FRESH, abs=1e-6)
    assert np.isfinite(robot._covariance).all()
    assert np.linalg.eigvalsh(robot._covariance).min() > -1e-12


def test_a_robot_whose_cells_are_empty_is_not_thought_to_have_lost_its_wheels():
    """It is commanded to drive but stands: its pose stays at its fixes."""
    robot = follower()
    for frame in range(1, 60):
        robot.record_command(frame / 30.0 - 0.033, (260.0, 0.0))
        robot.correct(fix(500.0, 400.0, 0.0, frame / 30.0))
        assert abs(robot.at(frame / 30.0).x - 500.0) < 6.0
    assert robot.correction == pytest.approx(FRESH, abs=0.1)


def test_a_robot_that_is_blocked_again_and_again_keeps_its_wheels():
    """It pushes another robot, turns, pushes: motion against the motors must not change the wheel estimate."""
    robot = follower()
    for frame in range(1, 300):
        robot.record_command(frame / 30.0 - 0.033, (260.0 * (frame % 15 < 10), 3.0 * (frame % 20 < 6)))
        robot.correct(fix(500.0, 400.0, 0.0, frame / 30.0))
    assert robot.correction[:3] == pytest.approx(FRESH[:3], abs=0.2)
    assert robot.correction.stiction < 30.0
