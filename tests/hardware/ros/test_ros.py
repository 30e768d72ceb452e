"""Robots of a ROS network: units, the same safety, and a whole match over a real roscore with rostopic beside it."""

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from math import pi
from pathlib import Path

import pytest

from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.control.rig import UNMEASURED, Rig
from pigaming_app.hardware.ros.robots import RosLink, RosPoses
from pigaming_app.hardware.ros.units import ArenaFrame
from pigaming_app.hardware.session.ros import RosSession
from pigaming_app.sim.world import DT, ROBOTS, World

ROOT = Path(__file__).resolve().parents[3]
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


def test_units_are_those_of_rep_103_and_come_back():
    frame = ArenaFrame.of_width(2000.0)
    assert frame.to_ros((0.0, 900.0, 0.0)) == (0.0, 0.0, 0.0)  # the lower left corner
    assert frame.to_ros((800.0, 0.0, -0.5 * pi)) == (1.0, 1.125, 0.5 * pi)  # upwards is a left turn
    pose = (123.0, 456.0, 5.0)
    assert frame.from_ros(frame.to_ros(pose)) == pytest.approx(pose)
    assert frame.twist_to_ros((400.0, 1.0)) == (0.5, -1.0)
    assert frame.twist_from_ros((0.5, -1.0)) == (400.0, 1.0)


def test_without_poses_the_speeds_become_zero_and_at_the_end_they_are_zero_five_times():
    node, now = Node(), [100.0]
    frame = ArenaFrame.of_width(2112.0)
    poses = RosPoses(node, frame, lambda: now[0], TRAINS)
    rig = Rig(poses, poses, RosLink(node, poses, TRAINS), lambda: now[0], TRAINS)
    world = World()
    world.robots[0].present = 1
    plant = RealPlant(world, rig, [0])
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
    assert plant.faults[0].name == "camera"
    node.twists.clear()
    rig.close()
    assert node.twists == [(0, (0.0, 0.0))] * 5
    assert node.closed


def test_a_joystick_drives_the_seat_it_names_or_the_first_person():
    session = RosSession()
    session._take_stick("robot_2", (1.0, 0.5), (0, 1))
    assert session.stick(1, False) == (0.5, -1.0, False, True)
    assert session.stick(0, True) is None
    session._take_stick("", (float("nan"),), (1,))
    assert session.stick(0, True) == (0.0, 0.0, True, False)
    assert session.stick(2, False) is None


class Watched:
    """`rostopic echo -p` of a topic, line by line with the time of its arrival."""

    def __init__(self, topic, environment):
        command = ["rostopic", "echo", "-p", topic]
        self.process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        os.set_blocking(self.process.stdout.fileno(), False)
        self.lines, self._rest = [], b""

    def read(self):
        while chunk := self.process.stdout.read():
            *whole, self._rest = (self._rest + chunk).split(b"\n")
            self.lines += [(time.monotonic(), line.decode()) for line in whole if line[:1].isdigit()]
        return self.lines


def until(condition, timeout=90.0):
    end = time.monotonic() + timeout
    while not (found := condition()):
        assert time.monotonic() < end, "nothing came"
        time.sleep(0.01)
    return found


@pytest.mark.long
@pytest.mark.skipif(shutil.which("roscore") is None, reason="no roscore: apt-get install ros-core python3-rospy")
def test_a_match_over_a_real_roscore_obeys_a_joystick_and_stops_without_poses(tmp_path: Path) -> None:
    with socket.socket() as free:
        free.bind(("localhost", 0))
        port = free.getsockname()[1]
    environment = {
        **os.environ,
        "ROS_MASTER_URI": f"http://localhost:{port}",
        "ROS_HOME": str(tmp_path / "ros"),
        "PIGAMING_HOME": str(tmp_path / "home"),
        "SDL_VIDEODRIVER": "dummy",
        "SDL_AUDIODRIVER": "dummy",
        "PYTHONUNBUFFERED": "1",
        "PYTHONWARNINGS": "ignore",
    }
    running = []

    def start(*command):
        running.append(subprocess.Popen(command, env=environment, cwd=ROOT, stdout=subprocess.DEVNULL))
        return running[-1]

    job = (sys.executable, "-X", "pigaming", "main.py")
    try:
        start("roscore", "-p", str(port))
        until(lambda: subprocess.run(["rostopic", "list"], env=environment, capture_output=True).returncode == 0)
        mat = start(*job, "ros", "--emulate")
        stick = "{header: {frame_id: robot_1}, axes: [0.0, 1.0], buttons: [0, 0]}"
        start("rostopic", "pub", "-r", "10", "/joystick", "sensor_msgs/Joy", stick)
        speeds, states = (Watched(topic, environment) for topic in ("/robot_1/cmd_vel", "/game/state"))
        running += [speeds.process, states.process]
        listed = ("rostopic", "list")
        until(lambda: b"/robot_1/pose" in subprocess.run(listed, env=environment, capture_output=True).stdout)
        rules = ("--seats", "human,level1", "--real", "1", "--width", "2126")
        match = start(*job, "play", "pitanks", "--plant", "ros", *rules)

        def state():
            return json.loads(states.lines[-1][1].partition(",")[2]) if states.read() else {}

        until(lambda: state().get("seconds", 0.0) > 1.0)
        assert state()["robots"][0]["robot"] == 1
        until(lambda: speeds.read() and float(speeds.lines[-1][1].split(",")[1]) > 0.2, 20.0)
        mat.send_signal(signal.SIGSTOP)
        stopped = time.monotonic()
        until(lambda: (speeds.read(), time.monotonic() > stopped + 1.0)[1])
        late = [at - stopped for at, line in speeds.read() if any(float(number) for number in line.split(",")[1:])]
        assert late[-1] < 0.4, "the poses on their way, 200 ms, and a tick"
        assert until(lambda: state()["faults"])[0]["name"] == "camera"
        assert state()["waiting"]
        match.send_signal(signal.SIGINT)
        assert match.wait(10) == 0
        assert all(float(number) == 0.0 for _, line in speeds.read()[-5:] for number in line.split(",")[1:])
    finally:
        for process in reversed(running):
            process.send_signal(signal.SIGCONT)
            process.terminate()
        for process in running:
            process.wait(10)
            if process.stdout:
                process.stdout.close()
