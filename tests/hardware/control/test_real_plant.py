"""Real robots as a plant on a simulated mat: walls, safety, homing, and mixed matches."""

from math import hypot, pi
from random import Random
from unittest.mock import Mock

import pytest

from pigaming_app.hardware.control.kinematics import Kinematics
from pigaming_app.hardware.control.mixed_plant import MixedPlant
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.radio.packets import DEADMAN, EMPTY, LOW, PARKED
from pigaming_app.hardware.radio.protocol import Misfit
from pigaming_app.sim.drivetrain import Drivetrain, Wheel
from pigaming_app.sim.world import RADIUS
from tests.floor import floor
from tests.hardware.mat import EVEN, NOMINAL_MM, STARTS, Mat

ALL = range(4)


def on_floor(mat, walls=(), real=ALL, kind=RealPlant):
    """A plant over a world with every robot present, at its pose on the mat."""
    world = floor(walls, [(robot.x, robot.y, robot.heading) for robot in mat.robots])
    return kind(world, mat.rig, real)


def drive(plant, mat, twists, seconds):
    """Drive for a while as a match does."""
    for _ in range(round(seconds / 0.02)):
        for robot, seen in zip(plant.world.robots, plant.sense(), strict=True):
            robot.x, robot.y, robot.heading = seen.x, seen.y, seen.heading
        plant.drive(twists, 0.02)
        mat.pass_time()


def stands(mat, robot=None):
    """True if the wheels of a robot, or of all, are commanded to stand or off."""
    robots = mat.robots if robot is None else [mat.robots[robot]]
    return all(robot.command is None or tuple(robot.command) == (0.0, 0.0) for robot in robots)


AHEAD = [(200.0, 0.0)] * 4


def test_real_robots_drive_as_asked_within_their_gains():
    mat = Mat([(300.0, 200.0, 0.0), (300.0, 400.0, 0.0), (300.0, 600.0, 0.0), (300.0, 800.0, 0.0)])
    plant = on_floor(mat)
    drive(plant, mat, AHEAD, 2.0)
    for robot in mat.robots:
        assert robot.x == pytest.approx(300.0 + 200.0 * (2.0 - 0.09 - 0.03), rel=0.05)
    assert plant.faults == []
    assert plant.world.robots[0].linear == pytest.approx(200.0, rel=0.03)


SLOW = Drivetrain(Wheel(126.0, 0.03), Wheel(126.0, 0.03), 71.0, 0.09, 0.03)  # a Thymio's


@pytest.mark.parametrize("twist", [(260.0, 0.0), (338.0, 3.0), (-422.0, -1.0), (0.0, 9.0)])
def test_nobody_in_a_mixed_match_is_faster_than_its_slowest_real_robot(twist):
    mat = Mat()
    mat.robots[1].train, mat.rig.kinematics[1] = SLOW, Kinematics(SLOW)
    plant = on_floor(mat, real=(0, 1), kind=MixedPlant)
    driven = [0.0] * 4
    for _ in range(100):
        drive(plant, mat, [twist] * 4, 0.02)
        driven = [
            max(far, abs(one.linear) + 35.5 * abs(one.angular))
            for far, one in zip(driven, plant.world.robots, strict=False)
        ]
    assert driven == pytest.approx([0.9 * 126.0] * 4, rel=0.07)
    for linear, angular in plant.paced([twist] * 4):
        assert linear * twist[1] == pytest.approx(angular * twist[0]), "the path has another curvature"


def test_a_top_speed_found_by_a_test_drive_holds_for_everybody_in_a_match_with_that_robot():
    mat = Mat()
    mat.rig.tops[1] = 100.0
    for real, limit in (((0, 1), 100.0), ((0, 2), 300.0)):
        plant = on_floor(mat, real=real, kind=MixedPlant)
        assert [abs(linear) for linear, _ in plant.paced([(300.0, 0.0)] * 4)] == pytest.approx([limit] * 4)


def test_where_all_are_fast_nobody_is_slowed():
    plant = on_floor(Mat())
    asked = [(422.0, 3.0), (-260.0, 0.0), (0.0, 3.0), (338.0, -3.0)]
    assert plant.paced(asked) == asked


@pytest.mark.parametrize("reason", ["old", "no_arena", "foreign"])
def test_a_robot_that_cannot_be_driven_is_off_and_named_while_the_others_wait(reason):
    mat = Mat()
    mat.misfits, mat.robots[1].silent = {1: Misfit(reason, 0, 0.0)}, True
    plant = on_floor(mat)
    drive(plant, mat, AHEAD, 1.5)
    assert [(fault.name, fault.robot) for fault in plant.faults if fault.pauses] == [(reason, 1)]
    assert mat.robots[1].command is None
    assert plant.safety.pauses


@pytest.mark.parametrize(
    ("board", "radius", "speed", "most"),
    [(None, 36.0, 200.0, 8.0), (None, 36.0, 422.0, 12.0), (1, 60.0 / 1.32, 200.0, 8.0)],
)
def test_a_robot_stops_short_of_a_wall_by_its_own_radius(board, radius, speed, most):
    """An ESP32 robot has a radius of 60 mm, at 1.32 mm/px."""
    mat = Mat([(500.0, 450.0, 0.0), *STARTS[1:]])
    mat.boards = {} if board is None else {0: board}
    drive(on_floor(mat, [(800.0, 0.0, 800.0, 900.0)]), mat, [(speed, 0.0)] * 4, 4.0)
    gap = 800.0 - 15.0 - mat.robots[0].x - radius
    assert 0.0 < gap < most


@pytest.mark.parametrize("thinking", [0.0, 0.03])
def test_a_tick_predicts_all_robots_once_unless_the_game_thinks_for_long(monkeypatch, thinking):
    mat = Mat()
    plant, predict = on_floor(mat), Mock(wraps=mat.predict)
    monkeypatch.setattr(mat, "predict", predict)
    for _ in range(10):
        predict.reset_mock()
        plant.sense()
        mat.pass_time(thinking)
        plant.drive(AHEAD, 0.02)
        assert predict.call_count == (2 if thinking else 1)
        assert predict.call_args.args[0] == mat.now
        mat.pass_time()


@pytest.mark.parametrize("boards", [{}, {0: 1}, {0: 1, 1: 2}])
def test_two_real_robots_that_race_at_each_other_do_not_touch(boards):
    """ESP32 and Pico W robots have a radius of 60 mm."""
    mat = Mat([(300.0, 450.0, 0.0), (1300.0, 450.0, pi), *STARTS[2:]], EVEN)
    mat.boards = boards
    plant = on_floor(mat)
    drive(plant, mat, [(422.0, 0.0), (422.0, 0.0), (0.0, 0.0), (0.0, 0.0)], 5.0)
    bodies = sum(60.0 / NOMINAL_MM if robot in boards else RADIUS for robot in (0, 1))
    gap = mat.robots[1].x - mat.robots[0].x - bodies
    assert 0.0 < gap < 25.0


@pytest.mark.parametrize("what", ["blind", "fault", "stopped"])
def test_what_concerns_all_stops_all_within_300_ms_and_goes_on_when_it_is_gone(what):
    mat = Mat()
    plant = on_floor(mat)
    drive(plant, mat, [(0.0, 2.0)] * 4, 0.5)
    assert not stands(mat)
    if what == "stopped":
        plant.safety.all_stop()
    else:
        setattr(mat, what, "gone")
    drive(plant, mat, [(0.0, 2.0)] * 4, 0.28)
    assert stands(mat)
    assert plant.safety.pauses
    if what == "stopped":
        plant.safety.release()
    else:
        setattr(mat, what, None)
    for _ in range(30):
        plant.watch()
        mat.pass_time()
    assert not plant.safety.pauses
    drive(plant, mat, [(0.0, 2.0)] * 4, 0.1)
    assert not stands(mat)


@pytest.mark.parametrize(
    ("what", "value", "name", "seconds"),
    [("hidden", True, "unseen", 0.29), ("duplicate", True, "twice", 0.1), ("battery", 3.9, "empty", 0.1)],
)
def test_what_concerns_one_stops_that_one(what, value, name, seconds):
    mat = Mat()
    plant = on_floor(mat)
    drive(plant, mat, [(0.0, 2.0)] * 4, 0.5)
    setattr(mat.robots[1], what, value)
    drive(plant, mat, [(0.0, 2.0)] * 4, seconds)
    assert stands(mat, 1)
    assert not any(stands(mat, other) for other in (0, 2, 3))
    assert (name, 1) in [(fault.name, fault.robot) for fault in plant.faults]


@pytest.mark.parametrize(
    ("flags", "battery", "name"),
    [(LOW | EMPTY, 4.2, "empty"), (EMPTY, 0.0, "empty"), (PARKED, 5.0, "parked"), (DEADMAN, 5.0, "deadman")],
)
def test_a_report_that_names_a_stop_stops_the_robot_and_pauses_and_is_said(flags, battery, name):
    """A robot that refuses its motors or was parked is off at once; one without commands after 0.5 s of reports."""
    mat = Mat()
    plant = on_floor(mat)
    drive(plant, mat, [(0.0, 2.0)] * 4, 0.8)
    assert not plant.faults
    mat.robots[1].flags, mat.robots[1].battery = flags, battery
    drive(plant, mat, [(0.0, 2.0)] * 4, 0.1 if name != "deadman" else 0.7)
    assert stands(mat, 1)
    assert not any(stands(mat, other) for other in (0, 2, 3))
    assert [(fault.name, fault.robot, fault.pauses) for fault in plant.faults] == [(name, 1, True)]
    mat.robots[1].flags, mat.robots[1].battery = 0, 5.0
    for _ in range(40):
        plant.watch()
        mat.pass_time()
    assert not plant.faults
    drive(plant, mat, [(0.0, 2.0)] * 4, 0.1)
    assert not stands(mat, 1)


def test_a_battery_counts_by_the_limits_of_its_kind():
    """At 4.3 V a micro:bit robot is empty; a 3pi's battery is low."""
    mat = Mat()
    mat.boards = {1: 4}
    plant = on_floor(mat)
    for robot in mat.robots[:2]:
        robot.battery = 4.3
    drive(plant, mat, [(0.0, 2.0)] * 4, 0.1)
    assert {(fault.name, fault.robot) for fault in plant.faults} == {("empty", 1), ("low", 0)}
    assert stands(mat, 1)
    assert not stands(mat, 0)


def test_an_unseen_robot_coasts_then_drives_at_half_speed_then_stops():
    mat = Mat([(300.0, 450.0, 0.0), *STARTS[1:]])
    plant = on_floor(mat)
    drive(plant, mat, AHEAD, 0.6)
    full = mat.robots[0].command
    assert full is not None
    mat.robots[0].hidden = True
    drive(plant, mat, AHEAD, 0.1)
    assert mat.robots[0].command == pytest.approx(full, abs=0.02)
    drive(plant, mat, AHEAD, 0.1)
    assert mat.robots[0].command == pytest.approx((0.5 * full.left, 0.5 * full.right), abs=0.04)
    drive(plant, mat, AHEAD, 0.12)
    assert stands(mat, 0)


def test_a_silent_robot_is_switched_off_after_a_second():
    mat = Mat()
    plant = on_floor(mat)
    mat.robots[2].silent = True
    drive(plant, mat, [(0.0, 2.0)] * 4, 0.9)
    assert not stands(mat, 2)
    drive(plant, mat, [(0.0, 2.0)] * 4, 0.2)
    assert mat.robots[2].command is None


def test_outside_only_the_way_in_is_open():
    mat = Mat([(-30.0, 450.0, pi), *STARTS[1:]])
    plant = on_floor(mat)
    drive(plant, mat, AHEAD, 0.5)
    assert mat.robots[0].x == pytest.approx(-30.0, abs=1.0)
    assert ("outside", 0) in [(fault.name, fault.robot) for fault in plant.faults]
    drive(plant, mat, [(-200.0, 0.0)] * 4, 1.5)
    assert mat.robots[0].x > 100.0
    assert not plant.safety.pauses


def test_robots_that_are_not_in_the_match_are_off_and_in_the_way():
    mat = Mat([(300.0, 450.0, 0.0), (800.0, 450.0, pi), *STARTS[2:]], EVEN)
    plant = on_floor(mat)
    plant.world.robots[1].present = 0
    drive(plant, mat, AHEAD, 4.0)
    assert mat.robots[1].command is None
    assert mat.robots[1].x == 800.0
    assert mat.robots[0].x < 800.0 - 2.0 * RADIUS


def test_a_robot_with_a_covered_marker_has_no_place_until_it_is_seen():
    mat = Mat()
    plant = on_floor(mat)
    plant.place([(robot.x, robot.y, robot.heading) for robot in mat.robots])
    mat.robots[3].hidden = True
    mat.pass_time(2.0)
    for _ in range(200):
        assert not plant.take_places()
        mat.pass_time()
    assert [place.arrived for place in plant.places] == [True, True, True, False]
    mat.robots[3].hidden = False
    mat.pass_time()
    assert plant.take_places()
    assert plant.places == []


def test_a_real_robot_takes_its_place_round_a_simulated_one():
    mat = Mat([(300.0, 450.0, 0.0), *STARTS[1:]])
    plant = on_floor(mat, real=[0], kind=MixedPlant)
    plant.place([(1200.0, 450.0, 0.0), (750.0, 450.0, 0.0), (1400.0, 700.0, 0.0), (200.0, 700.0, 0.0)])
    taken = 0
    while not plant.take_places() and taken < 1000:
        mat.pass_time()
        assert hypot(mat.robots[0].x - 750.0, mat.robots[0].y - 450.0) > 2.0 * RADIUS
        taken += 1
    assert mat.robots[0].x == pytest.approx(1200.0, abs=20.0)
    assert plant.world.robots[1].x == pytest.approx(750.0)


def test_a_simulated_robot_cannot_push_a_real_one_nor_enter_it():
    mat = Mat([(800.0, 450.0, 0.0), *STARTS[1:]])
    plant = on_floor(mat, real=[0], kind=MixedPlant)
    simulated = plant.world.robots[1]
    simulated.x, simulated.y, simulated.heading = 400.0, 450.0, 0.0
    drive(plant, mat, [(0.0, 0.0), (260.0, 0.0), (0.0, 0.0), (0.0, 0.0)], 3.0)
    assert mat.robots[0].x == 800.0
    assert simulated.x == pytest.approx(800.0 - 2.0 * RADIUS, abs=0.5)


def test_a_real_robot_stops_before_a_simulated_one():
    mat = Mat([(300.0, 450.0, 0.0), *STARTS[1:]], EVEN)
    plant = on_floor(mat, real=[0], kind=MixedPlant)
    simulated = plant.world.robots[1]
    simulated.x, simulated.y = 900.0, 450.0
    drive(plant, mat, [(260.0, 0.0), *[(0.0, 0.0)] * 3], 5.0)
    assert mat.robots[0].x < 900.0 - 2.0 * RADIUS
    assert simulated.x == 900.0


def test_a_robot_is_swapped_for_a_simulated_one_and_back_in_the_middle_of_a_match():
    mat = Mat([(300.0, 450.0, 0.0), *STARTS[1:]])
    plant = on_floor(mat, real=ALL, kind=MixedPlant)
    drive(plant, mat, AHEAD, 1.0)
    x = plant.world.robots[0].x
    plant.swap(0, False)
    drive(plant, mat, [(200.0, 0.0), *[(0.0, 0.0)] * 3], 1.0)
    assert mat.robots[0].command is None
    assert plant.world.robots[0].x == pytest.approx(x + 200.0, abs=30.0)
    assert mat.robots[0].x < x + 40.0
    plant.swap(0, True)
    taken = 0
    while not plant.take_places() and taken < 1500:
        mat.pass_time()
        taken += 1
    assert taken < 1500
    assert 0 in plant.real
    assert plant.sense()[0].x == pytest.approx(plant.world.robots[0].x, abs=15.0)


def test_a_real_robot_takes_over_from_a_simulated_one_that_leans_on_a_wall():
    mat = Mat([(300.0, 450.0, 0.0), *STARTS[1:]])
    plant = on_floor(mat, [(875.0, 372.0, 1030.0, 530.0)], real={1, 2, 3}, kind=MixedPlant)
    leaning = plant.world.robots[0]
    leaning.x, leaning.y, leaning.heading = 1064.0, 546.0, 6.09
    plant.swap(0, True)
    (goal,) = plant.goals.values()
    assert 2.0 < hypot(goal[0] - leaning.x, goal[1] - leaning.y) < 25.0
    taken = 0
    while not plant.take_places() and taken < 1500:
        mat.pass_time()
        taken += 1
    assert taken < 1000
    assert hypot(mat.robots[0].x - goal[0], mat.robots[0].y - goal[1]) < 15.0


def test_twenty_seconds_of_mashing_by_four_robots_among_walls_enter_nothing():
    mat = Mat()
    plant = on_floor(mat, [(800.0, 200.0, 800.0, 700.0), (400.0, 500.0, 600.0, 400.0)])
    chance = Random(4)
    deepest = 0.0
    for _ in range(50):
        desired = [(chance.choice((-422.0, 0.0, 422.0, 422.0)), chance.choice((-3.0, 0.0, 3.0))) for _ in ALL]
        drive(plant, mat, desired, 0.4)
        for robot in mat.robots:
            deepest = max(deepest, RADIUS - robot.x, robot.x - 1600.0 + RADIUS, RADIUS - robot.y, robot.y - 864.0)
            if 200.0 < robot.y < 700.0:
                deepest = max(deepest, 15.0 + RADIUS - abs(robot.x - 800.0))
    assert deepest < 3.0
