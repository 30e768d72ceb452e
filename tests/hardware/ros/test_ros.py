"""Robots of a ROS network: units, the same safety, and a whole match over a real roscore with rostopic beside it."""

import json
import re
import signal
import socket
import sys
import threading
import time
from math import pi
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.control.rig import UNMEASURED, Rig
from pigaming_app.hardware.ros import node as node_module
from pigaming_app.hardware.ros.node import ArenaFrame, RosUnavailable, require_roscore
from pigaming_app.hardware.ros.robots import RosLink, RosPoses
from pigaming_app.hardware.session.robot_session import cause_of
from pigaming_app.hardware.session.ros import RosSession
from pigaming_app.hardware.signals import WheelCommand
from pigaming_app.sim.world import DT, ROBOTS, World
from pigaming_app.ui.i18n import LANGUAGES, texts
from tests.hardware.ros.network import JOB, NEEDS_ROSCORE, network, until

TRAINS = [UNMEASURED] * ROBOTS


class Node:
    """A network that only remembers."""

    fault = None

    def __init__(self):
        self.poses, self.twists, self.closed = {}, [], False

    def on_pose(self, robot, handle):
        self.poses[robot] = handle

    def publish_twist(self, robot, twist):
        self.twists.append((robot, twist))

    def close(self):
        self.closed = True


@pytest.mark.parametrize("missing", ["rospy", "geometry_msgs", "sensor_msgs"])
def test_a_package_that_is_missing_is_named_in_one_line(monkeypatch, missing):
    monkeypatch.setattr(sys, "path", [*sys.path])
    for name in ("rosgraph", "rospy", "geometry_msgs", "geometry_msgs.msg", "sensor_msgs", "sensor_msgs.msg"):
        monkeypatch.setitem(sys.modules, name, None if name.partition(".")[0] == missing else ModuleType(name))
    for name in ("std_msgs", "std_msgs.msg"):
        monkeypatch.setitem(sys.modules, name, ModuleType(name))
    with pytest.raises(RosUnavailable) as refusal:
        require_roscore()
    assert str(refusal.value.message.values["package"]).startswith(missing)


class Registrations(ModuleType):
    """rospy and the messages: a registration is noted, as it waits for a roscore that has gone."""

    def __init__(self, address: str = "") -> None:
        super().__init__("rospy")
        self.registered: list[str] = []
        self.sent: list[str] = []
        self.core = self.msg = self
        self.AnyMsg = self.Joy = self.String = self.PoseStamped = self.Twist = lambda *values: self
        self.linear = self.angular = ModuleType("vector")
        self.get_master_uri = lambda: address
        self.is_initialized = lambda: True
        self.is_shutdown = lambda: False

    def Publisher(self, topic: str, *rest: object, **more: object) -> "Registrations":  # noqa: N802
        self.registered.append(topic)
        return self

    Subscriber = Publisher

    def publish(self, message: object) -> None:
        self.sent.append(self.registered[-1])

    def unregister(self) -> None:
        """Nobody looks at it."""


@pytest.fixture
def no_ros(monkeypatch):
    """Stands in for rospy, at an address of a roscore."""

    def install(address=""):
        fake = Registrations(address)
        monkeypatch.setattr(sys, "path", [*sys.path])
        for package in ("rosgraph", "rospy", "geometry_msgs", "sensor_msgs", "std_msgs"):
            for name in (package, f"{package}.msg"):
                monkeypatch.setitem(sys.modules, name, fake)
        return fake

    return install


@pytest.mark.parametrize(
    "address", ["", "garbage", "http://", "http://localhost:99999", "ftp://localhost:1", "http://["]
)
def test_an_address_that_is_none_is_refused_in_one_line(no_ros, address):
    no_ros(address)
    with pytest.raises(RosUnavailable) as refusal:
        require_roscore()
    assert refusal.value.message.values["address"] == (address or '""')


def test_a_roscore_that_does_not_answer_is_not_awaited_for_ever(no_ros, monkeypatch):
    monkeypatch.setattr(node_module, "ANSWER", 0.05)
    with socket.create_server(("localhost", 0)) as mute:
        no_ros(f"http://localhost:{mute.getsockname()[1]}")
        with pytest.raises(RosUnavailable):
            require_roscore()


def test_no_topic_is_registered_while_robots_drive(no_ros, monkeypatch):
    fake = no_ros()
    monkeypatch.setattr(node_module, "require_roscore", lambda: None)
    session = RosSession()
    rig = session.open()
    try:
        assert rig.remote
        link = rig.link
        assert isinstance(link, RosLink)
        assert link._thread is not None
        link._closing.set()
        link._thread.join()
        at_first = len(fake.registered)
        link.node.publish_twist(3, (0.0, 0.0))
        session.publish({})
        assert len(fake.sent) == 2
    finally:
        session.end()
    assert len(fake.registered) == at_first == 4 + 1 + 4 + 2, "speeds, state; poses, joystick, keys"


def test_units_are_those_of_rep_103_and_come_back():
    frame = ArenaFrame.of_width(2000.0)
    assert frame.to_ros((0.0, 900.0, 0.0)) == (0.0, 0.0, 0.0)  # the lower left corner
    assert frame.to_ros((800.0, 0.0, -0.5 * pi)) == (1.0, 1.125, 0.5 * pi)  # upwards is a left turn
    pose = (123.0, 456.0, 5.0)
    assert frame.from_ros(frame.to_ros(pose)) == pytest.approx(pose)
    assert frame.twist_to_ros((400.0, 1.0)) == (0.5, -1.0)
    assert frame.twist_from_ros((0.5, -1.0)) == (400.0, 1.0)


def test_without_poses_the_speeds_become_zero_and_at_the_end_they_are_zero_five_times():
    plant, node, now = remote_plant([0])
    rig, frame = plant.rig, ArenaFrame.of_width(2112.0)
    zero, x = [], 800.0
    for tick in range(40):
        now[0] += DT
        if tick < 20:
            x += 200.0 * DT
            node.poses[0](0, frame.to_ros((x, 450.0, 0.0)), 0.0)
            node.poses[1](1, (float("nan"), 0.0, 0.0), 0.0)
        plant.sense()
        plant.drive([(200.0, 0.0)] * 4, DT)
        assert node.twists[-1][0] == 0, "a robot that is not in the match is not commanded"
        zero.append(node.twists[-1][1] == (0.0, 0.0))
    assert not any(zero[2:20])
    assert zero.index(True, 3) - 20 <= 10, "200 ms"
    assert all(zero[30:])
    assert plant.safety.pauses
    assert plant.faults[0].name == "poses"
    assert rig.link.quality(0).share == pytest.approx(0.5)
    assert rig.link.telemetry[0].battery == 0.0
    now[0] += 1.0
    assert rig.camera.fault.key == "ros_poses"
    node.twists.clear()
    rig.close()
    assert node.twists == [(0, (0.0, 0.0))] * 5
    assert node.closed


def joined(clock):
    """A network that only remembers, and the poses and the link of the robots in it."""
    node: Any = Node()
    poses = RosPoses(node, ArenaFrame.of_width(2112.0), clock, TRAINS)
    return node, poses, RosLink(poses)


def remote_plant(robots):
    """The plant of a match over a network that only remembers, its node, and the time."""
    now = [100.0]
    node, poses, link = joined(lambda: now[0])
    rig = Rig(poses, poses, link, lambda: now[0], TRAINS)
    rig.remote = True
    world = World()
    for robot in robots:
        world.robots[robot].present = 1
    return RealPlant(world, rig, robots), node, now


@pytest.mark.parametrize(
    ("late", "names", "cause"),
    [
        ((0.3, 0.3), {("poses", None), ("late", 0), ("late", 1)}, "ros_late"),
        ((3.0, 3.0), {("poses", None), ("pose", 0), ("pose", 1), ("late", 0), ("late", 1)}, "ros_late"),
        ((0.0, 1.5), {("pose", 1), ("late", 1)}, None),
        ((0.0, 0.2), {("late", 1)}, None),
        ((0.0, None), {("pose", 1), ("late", 1)}, None),
        ((None, None), {("poses", None), ("pose", 0), ("pose", 1), ("late", 0), ("late", 1)}, "ros_poses"),
    ],
)
def test_late_and_missing_poses_are_called_that(late, names, cause):
    plant, node, now = remote_plant([0, 1])
    for _ in range(150):
        now[0] += DT
        for robot, seconds in enumerate(late):
            if seconds is not None:
                node.poses[robot](robot, (0.5 + robot, 0.5, 0.0), seconds)
        plant.sense()
        plant.drive([(0.0, 0.0)] * 4, DT)
    found = {(fault.name, fault.robot) for fault in plant.faults}
    assert found <= names
    assert {name for name in names if name[0] != "late"} <= found
    told = cause_of(plant.rig, plant.faults[0].name)
    assert (told.key if told else None) == cause
    plant.close()
    for language in LANGUAGES:
        for fault in plant.faults:
            assert not re.search(
                "[ck][aáâ]m[aeé]r|[ck][aâ]b[elo]|radio", texts(language)[f"faults.{fault.name}"].lower()
            )


def test_a_link_thread_that_fails_leaves_zero_speeds(monkeypatch):
    node, _, link = joined(time.monotonic)
    link.send([WheelCommand(0.5, 0.5), None, None, None])
    failures = iter([OSError])
    pump = link.pump

    def failing_pump():
        for failure in failures:
            raise failure
        pump()

    monkeypatch.setattr(link, "pump", failing_pump)
    monkeypatch.setattr(threading, "excepthook", lambda failed: None)
    link.start()
    link._thread.join(5.0)
    assert node.twists == [(0, (0.0, 0.0))] * 5
    assert link.fault.key == "ros_gone"
    link.close()
    assert len(node.twists) == 5


def test_a_joystick_drives_the_seat_it_names_or_the_first_person():
    session = RosSession()
    session._take_stick("robot_2", (1.0, 0.5), (0, 1))
    assert session.stick(1, False) == (0.5, -1.0, False, True)
    assert session.stick(0, True) is None
    session._take_stick("", (float("nan"),), (1,))
    assert session.stick(0, True) == (0.0, 0.0, True, False)
    assert session.stick(2, False) is None


def test_keys_drive_the_seat_they_name_or_the_first_person_while_they_are_held():
    session = RosSession()
    session._take_keys("Up left robot_2 FIRE")
    assert session.stick(1, False) == (1.0, -1.0, True, False)
    assert session.stick(0, True) is None
    session._take_keys("down right turbo")
    assert session.stick(0, True) == (-1.0, 1.0, False, True)
    assert session.stick(2, False) is None
    session._take_keys("")
    assert session.stick(0, True) == (0.0, 0.0, False, False)
    session._take_keys("up robot_5 \N{SNOWMAN} down")
    assert session.stick(0, True) == (0.0, 0.0, False, False)


LOBBY = """
import time
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.start import opened
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.ui.input.events import Button, Device, InputEvent
lobby = lambda context: Lobby(context, "pitanks", ["level1"] * 3)
with opened(Options(first_scene=lobby, headless=True, ros_width=2112.0)) as app:
    def press(button):
        app.stack.apply(app.stack.top.handle(InputEvent(button, Device("keys", 0))))
    app.stack.top._swap(1)
    press(Button.START)
    while app.stack.scenes:
        app._frame(0.02)
        if isinstance(app.stack.top, MatchSetupPage):
            press(Button.START)
        time.sleep(0.02)
"""


@pytest.mark.long
@NEEDS_ROSCORE
def test_a_match_over_a_real_roscore_obeys_joystick_and_keys_and_stops_without_poses(tmp_path: Path) -> None:
    with network(tmp_path) as ros:
        mat = ros.start(*JOB, "ros", "--emulate")
        stick = "{header: {frame_id: robot_1}, axes: [0.0, 1.0], buttons: [0, 0]}"
        joystick = ros.start("rostopic", "pub", "-r", "10", "/joystick", "sensor_msgs/Joy", stick)
        speeds, states = ros.watch("/robot_1/cmd_vel"), ros.watch("/game/state")
        until(lambda: "/robot_1/pose" in ros.topics())
        rules = ("--seats", "human,level1", "--real", "1", "--width", "2126")
        match = ros.start(*JOB, "play", "pitanks", "--plant", "ros", *rules)

        def state():
            return json.loads(states.lines[-1][1].partition(",")[2]) if states.read() else {}

        until(lambda: state().get("seconds", 0.0) > 1.0)
        assert state()["robots"][0]["robot"] == 1
        until(lambda: speeds.read() and float(speeds.lines[-1][1].split(",")[1]) > 0.2, 20.0)
        joystick.terminate()
        ros.start("rostopic", "pub", "-r", "10", "/key_input", "std_msgs/String", "robot_1 down")
        until(lambda: speeds.read() and float(speeds.lines[-1][1].split(",")[1]) < -0.1, 20.0)
        mat.send_signal(signal.SIGSTOP)
        stopped = time.monotonic()
        until(lambda: (speeds.read(), time.monotonic() > stopped + 1.0)[1])
        late = [at - stopped for at, line in speeds.read() if any(float(number) for number in line.split(",")[1:])]
        assert late[-1] < 0.4, "the poses on their way, 200 ms, and a tick"
        assert until(lambda: state()["faults"])[0]["name"] == "poses"
        assert state()["waiting"]
        match.send_signal(signal.SIGINT)
        assert match.wait(10) == 0
        assert all(float(number) == 0.0 for _, line in speeds.read()[-5:] for number in line.split(",")[1:])


@pytest.mark.long
@NEEDS_ROSCORE
def test_the_lobby_offers_the_robots_of_the_network_and_drives_those_chosen(tmp_path: Path) -> None:
    """Robots 1 and 2 stand still and publish Pose2D and PoseStamped; seat 2 is simulated by choice."""
    with network(tmp_path) as ros:
        ros.start(
            "rostopic", "pub", "-r", "30", "/robot_1/pose", "geometry_msgs/Pose2D", "{x: 1.0, y: 0.5, theta: 1.0}"
        )
        pose = "{pose: {position: {x: 1.5, y: 0.8}, orientation: {w: 1.0}}}"
        ros.start("rostopic", "pub", "-r", "30", "/robot_2/pose", "geometry_msgs/PoseStamped", pose)
        first, second = ros.watch("/robot_1/cmd_vel"), ros.watch("/robot_2/cmd_vel")
        arcade = ros.start(sys.executable, "-X", "pigaming", "-c", LOBBY)
        until(lambda: any(float(number) for _, line in first.read() for number in line.split(",")[1:]))
        arcade.send_signal(signal.SIGINT)
        arcade.wait(20)
        assert all(float(number) == 0.0 for _, line in first.read()[-5:] for number in line.split(",")[1:])
        assert not second.read()
