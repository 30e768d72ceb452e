"""The motion check detects robots that contradict their commands, and tolerates weak, uneven or late ones."""

from dataclasses import replace
from math import hypot, pi
from random import Random

import pytest

from pigaming_app.hardware.control.kinematics import IDEAL
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.signals import WheelCommand
from pigaming_app.sim.drivetrain import Wheel
from pigaming_app.sim.world import RADIUS
from tests.cases import one_in
from tests.floor import floor
from tests.hardware.mat import TRUE, Mat

MM = 1.32  # of a px
ASIDE = ((1500.0, 100.0, 3.0), (100.0, 100.0, 0.0))
BESIDE = RADIUS + 5.0  # px from the edge, where virtual walls stop a robot
WIRED = {
    "reversed": lambda left, right: WheelCommand(-left, -right),
    "swapped": lambda left, right: WheelCommand(right, left),
    "one reversed": lambda left, right: WheelCommand(-left, right),
    "held": lambda left, right: WheelCommand(0.0, 0.0),
}


class Wired:
    """A mat whose first robot is wired wrongly, or wears the lid of the second."""

    def __init__(self, poses, fault):
        self.mat = Mat(poses)
        if fault == "lids":
            self.mat.radio = [1, 0, 2, 3]
        elif fault:
            self._rewire(self.mat.robots[0], WIRED[fault])
        world = floor([], [(robot.x, robot.y, robot.heading) for robot in self.mat.robots])
        self.plant = RealPlant(world, self.mat.rig)
        self.out = -1e9  # mm, maximum overhang of a robot beyond the arena
        self.named = None  # s

    def _rewire(self, robot, wiring):
        roll = robot.roll

        def rewired():
            command, robot.command = robot.command, robot.command and wiring(*robot.command)
            roll()
            robot.command = command

        robot.roll = rewired

    def drive(self, ask, seconds):
        """Drive as in a match, and watch while a fault pauses it."""
        mat, plant = self.mat, self.plant
        for tick in range(round(seconds / 0.02)):
            for robot, seen in zip(plant.world.robots, plant.sense(), strict=True):
                robot.x, robot.y, robot.heading = seen.x, seen.y, seen.heading
            if plant.safety.pauses:
                plant.watch()
            else:
                plant.drive(ask(0.02 * tick), 0.02)
            if self.named is None and any(fault.name == "disobeys" for fault in plant.faults):
                self.named = 0.02 * tick
            mat.pass_time()
            for robot in mat.robots:
                edges = (robot.x, 1600.0 - robot.x, robot.y, 900.0 - robot.y)
                self.out = max(self.out, MM * (RADIUS - min(edges)))
        return self


def ahead(speed, turn=0.0):
    """Stand, then drive all robots alike."""
    return lambda time: [(speed, turn) if time > 0.5 else (0.0, 0.0)] * 4


def mashed(speed, seed):
    """Random sticks, each held for up to a second."""
    random = Random(seed)
    held: dict[int, tuple[float, tuple[float, float]]] = {}  # until (s), twist

    def ask(time):
        for robot in range(4):
            if time >= held.get(robot, (0.5,))[0]:
                linear, angular = random.choice((-1, -0.5, 0.75, 1, 1, 1)), random.choice((-1, -0.3, 0, 0, 0.3, 1))
                held[robot] = time + random.uniform(0.06, 1.0), (speed * linear, 3.0 * angular)
        return [held[robot][1] if robot in held else (0.0, 0.0) for robot in range(4)]

    return ask


@pytest.mark.parametrize("speed", one_in(3, [422.5, 260.0, 325.0]))
@pytest.mark.parametrize("fault", ["lids", "reversed", "swapped", "one reversed"])
@pytest.mark.parametrize("heading", one_in(2, [0.0, pi, 2.5, 0.6]))
def test_no_robot_gets_far_out_of_the_arena(fault, speed, heading):
    for gap in (0.0, 60.0, 240.0):
        poses = [(BESIDE + gap, 450.0, heading), (900.0, 450.0, 0.4), *ASIDE]
        assert Wired(poses, fault).drive(ahead(speed), 2.0).out < 60.0


@pytest.mark.parametrize(("turn", "seconds"), [(0.1, 1.0), (0.2, 0.5)])
def test_motors_exchanged_on_a_nearly_straight_way_are_noticed_soon(turn, seconds):
    """A twin that gets the same commands shows the way: 600 ms from 10 mm off it, less 30 for the radio; 120 mm."""
    run, off = Wired([(200.0, 300.0, 0.0), (200.0, 600.0, 0.0), *ASIDE], None), []
    robot, twin = run.mat.robots[:2]

    def ask(time):
        off.append(MM * hypot(robot.x - twin.x, robot.y - twin.y + 300.0))
        return [(200.0, turn if time % (2.0 * seconds) < seconds else -turn)] * 2 + [(0.0, 0.0)] * 2

    assert run.drive(ask, 3.0).named is None
    assert max(off) < 1.0
    run._rewire(robot, WIRED["swapped"])
    off.clear()
    named = run.drive(ask, 2.0).named
    assert named is not None
    assert named - 0.02 * sum(mm <= 10.0 for mm in off) < 0.57
    assert max(off) < 120.0


def test_uneven_wheels_that_turn_a_robot_against_its_command_are_no_false_alarm():
    """By 7 % of 400 px/s over a base of 62 px, 0.45 rad/s; the command is 0.3 the other way."""
    run = Wired([(150.0, 300.0, 0.0), (150.0, 600.0, 0.0), *ASIDE], None)
    for robot in run.mat.robots:
        robot.train = replace(TRUE, left=Wheel(757.0 * 1.07, 0.03), right=Wheel(757.0 * 0.93, 0.03))
    way = [(200.0, -0.3)] * 2 + [(0.0, 0.0)] * 2
    assert run.drive(lambda time: way if time % 2.0 < 1.6 else [(200.0, 0.3)] * 4, 5.0).named is None


def test_robots_with_swapped_lids_have_proven_nothing_while_they_are_commanded_alike():
    """Each moves as the other is commanded, until one of them is at the edge: 340 mm/s, and 5 % of a strong wheel."""
    fastest = 0.0

    def ask(time):
        nonlocal fastest
        fastest = max(fastest, *(MM * robot.linear for robot in run.mat.robots))
        return [(422.5, 0.0)] * 4

    run = Wired([(300.0, 600.0, 0.0), (900.0, 300.0, 0.0), *ASIDE], "lids")
    assert run.drive(ask, 2.5).out < 60.0
    assert 300.0 < fastest < 357.0


def test_a_robot_that_is_commanded_otherwise_than_the_others_is_proven():
    run = Wired([(300.0, 600.0, 0.0), (500.0, 300.0, 0.0), *ASIDE], None)
    run.drive(lambda time: [(300.0, 0.0), (100.0, 0.0), (300.0, 0.0), (0.0, 0.0)], 1.0)
    assert [check.obeys for check in run.mat.rig.motion_checks] == [False, True, False, False]


@pytest.mark.parametrize("fault", ["lids", "reversed", "swapped", "one reversed", "held"])
def test_a_fault_is_noticed_under_random_sticks(fault):
    poses = [(400.0, 450.0, 1.0), (1100.0, 450.0, 2.0), *ASIDE]
    for seed in range(2):
        run = Wired(poses, fault).drive(mashed(325.0, seed), 5.0)
        assert run.named is not None
        assert run.out < 60.0


def test_a_robot_that_drives_the_wrong_way_is_stopped_after_half_a_second():
    run = Wired([(800.0, 450.0, 0.0), (800.0, 750.0, 0.0), *ASIDE], "reversed").drive(ahead(200.0), 2.0)
    assert 0.9 < run.named < 1.3
    assert run.mat.robots[0].command in (None, WheelCommand(0.0, 0.0))


def test_a_robot_that_turns_against_its_command_is_stopped_sooner():
    """A turn the wrong way is no weak wheel: with the weight of other motion it takes 0.3 s longer."""
    run = Wired([(800.0, 450.0, 0.0), (800.0, 750.0, 0.0), *ASIDE], "swapped").drive(ahead(200.0, 2.5), 2.0)
    assert 0.7 < run.named <= 1.0


@pytest.mark.parametrize(("left", "right"), [(0.7, 0.7), (1.3, 1.3), (0.75, 1.25), (1.2, 0.8)])
@pytest.mark.parametrize(("lag", "dead_time"), one_in(2, [(0.12, 0.06), (0.05, 0.02)]))
def test_weak_uneven_and_late_robots_are_no_false_alarm(left, right, lag, dead_time):
    """The tracker measures gains; before it has, wheels that are both 30 % too strong look like leaving the arena."""
    run = Wired([(400.0, 450.0, 1.0), (1100.0, 450.0, 2.0), *ASIDE], None)
    run.mat.dead_time = dead_time
    run.mat.correction = IDEAL._replace(left=left, right=right) if min(left, right) > 1.0 else IDEAL
    for robot in run.mat.robots:
        robot.train = replace(TRUE, left=Wheel(757.0 * left, 0.05), right=Wheel(757.0 * right, 0.02), lag=lag)
    assert run.drive(mashed(260.0, 5), 8.0).named is None


@pytest.mark.parametrize("measured", [0.09, 0.0])
def test_a_delay_is_no_false_alarm_once_the_tracker_has_measured_it(measured):
    run = Wired([(400.0, 450.0, 1.0), (1100.0, 450.0, 2.0), *ASIDE], None)
    run.mat.correction = IDEAL._replace(late=measured)
    run.mat.dead_time = 0.15
    named = [run.drive(mashed(260.0, seed), 6.0).named for seed in range(3)]
    assert any(named) is not bool(measured)


@pytest.mark.parametrize("fault", ["lids", "reversed", "swapped", "one reversed"])
def test_with_a_measured_delay_no_robot_gets_much_farther_out(fault):
    for heading in (0.0, pi, 2.5):
        run = Wired([(BESIDE + 60.0, 450.0, heading), (900.0, 450.0, 0.4), *ASIDE], fault)
        run.mat.correction = IDEAL._replace(late=0.05)
        assert run.drive(ahead(325.0), 2.0).out < 60.0


def test_it_lasts_until_somebody_has_looked():
    run = Wired([(800.0, 450.0, 0.0), (800.0, 750.0, 0.0), *ASIDE], "held").drive(ahead(200.0), 5.0)
    assert run.plant.safety.latched == {0}
    run.plant.clear_fault(0)
    del run.mat.robots[0].roll
    assert run.drive(ahead(200.0), 2.0).plant.faults == []
    assert run.mat.robots[0].x > 900.0


def test_a_robot_that_is_switched_off_is_said_to_be_silent_and_drives_on_once_it_is_back():
    run = Wired([(300.0, 450.0, 0.0), (300.0, 750.0, 0.0), *ASIDE], None)
    run._rewire(run.mat.robots[0], WIRED["held"])
    run.mat.robots[0].silent = True
    run.drive(ahead(0.0), 0.2).drive(ahead(150.0), 2.5)
    assert [(fault.name, fault.robot) for fault in run.plant.faults] == [("silent", 0)]
    del run.mat.robots[0].roll
    run.mat.robots[0].silent = False
    run.drive(lambda time: [(150.0, 0.0)] * 4, 2.5)
    assert run.plant.faults == []
    assert run.mat.robots[0].x > 400.0
